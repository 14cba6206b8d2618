"""Names and sentences use the words of the field: see `words`."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.words import ROOT, uses

REVISED = (
    "README.md",
    "CONTRIBUTING.md",
    "docs/architecture.md",
    "docs/conventions.md",
    "urdfkit/app",
    "urdfkit/bridges",
    "urdfkit/cli",
    "urdfkit/kinematics",
    "urdfkit/messages",
    "urdfkit/compilation",
    "urdfkit/scaffold",
    "urdfkit/sim/construction",
    "urdfkit/sim/engine",
    "urdfkit/sim/scene_view.py",
    "urdfkit/sim/world",
    "urdfkit/scene",
    "urdfkit/view",
)
"""Where every name and sentence has been revised; the rest follows."""


def files_in(place: str) -> list[Path]:
    path = ROOT / place
    return [path] if path.is_file() else sorted(path.rglob("*.py"))


@pytest.mark.parametrize("place", REVISED)
def test_names_and_sentences_use_the_words_of_the_field(place):
    files = files_in(place)
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


def test_code_in_backticks_is_not_prose(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("Call `page.tell` to report the pose.\n")
    assert list(uses(page)) == []
