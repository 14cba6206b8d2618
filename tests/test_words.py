"""Names and sentences use the words of the field: see `words`."""

from __future__ import annotations

import pytest

from tests.words import ROOT, files_below, uses

PLACES = (
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "docs",
    "robots",
    "templates",
    *sorted(
        f"urdfkit/{path.name}"
        for path in (ROOT / "urdfkit").iterdir()
        if path.suffix == ".py" or (path / "__init__.py").exists()
    ),
)
"""All files that users and contributors read."""


@pytest.mark.slow
@pytest.mark.parametrize("place", PLACES)
def test_names_and_sentences_use_the_words_of_the_field(place):
    files = files_below(ROOT / place)
    assert files
    found = [use for file in files for use in uses(file)]
    assert found == []


def test_words_that_are_not_used_are_found_in_names_comments_and_strings(tmp_path):
    module = tmp_path / "stage.py"
    module.write_text('''"""Mend what is told."""\n\n\ndef tell(thing):\n    return thing  # nobody asks\n''')
    assert {(use.line, use.kind, use.word) for use in uses(module)} >= {
        (1, "prose", "mend"),
        (1, "prose", "told"),
        (4, "name", "tell"),
        (4, "name", "thing"),
        (5, "prose", "nobody"),
        (5, "prose", "asks"),
    }


def test_a_template_of_python_with_placeholders_is_read_as_text(tmp_path):
    module = tmp_path / "robot.launch.py"
    module.write_text("SPAWNED = (@names@)  # nobody asks\n")
    assert [use.word for use in uses(module)] == ["asks", "nobody"]


def test_code_in_backticks_is_not_prose(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("Call `page.tell` to report the pose.\n")
    assert list(uses(page)) == []
