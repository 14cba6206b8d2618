"""Each page with files of its own works as its reader enters it in an empty folder: files, commands, outputs."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.docs.course import PAGES, ROOT, agrees, minutes, run, unnamed_files

pytest.importorskip("numba")


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_reader_in_an_empty_folder_sees_the_outputs_of_the_page(page: Path, tmp_path: Path) -> None:
    steps = list(run(page.read_text("utf-8"), tmp_path.resolve()))
    assert steps
    for step in steps:
        if step.shown.strip() and "urdfkit sim teleop" not in step.command and "urdfkit view" not in step.command:
            assert agrees(step.shown, step.printed), f"$ {step.command}\n{step.printed}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_text_names_each_file_before_its_block(page: Path) -> None:
    assert unnamed_files(page.read_text("utf-8")) == []
    assert unnamed_files('Save `a.txt`:\n\n```text title="a.txt"\n```\n```text title="b.txt"\n```\n') == ["b.txt"]


def test_a_page_with_a_wrong_output_is_found(tmp_path: Path) -> None:
    page = '```text title="a.txt"\none\ntwo\n```\n```diff title="a.txt"\n one\n-two\n+three\n```\n'
    page += "```console\n$ cat a.txt\none\ntwo\n$ cat a.txt\none\n…\n$ cat a.txt a.txt\none\n…\nthree\n```\n"
    assert [agrees(step.shown, step.printed) for step in run(page, tmp_path)] == [False, True, True]


def test_a_change_that_matches_nothing_is_an_error(tmp_path: Path) -> None:
    page = '```text title="a.txt"\none\n```\n```diff title="a.txt"\n-two\n+three\n```\n'
    with pytest.raises(AssertionError, match="0 times"):
        list(run(page, tmp_path))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_with_changes_explains_their_signs(page: Path) -> None:
    before, diff, _ = page.read_text("utf-8").partition("```diff")
    assert not diff or re.search(r"lines?\s+(?:that\s+starts?\s+)?with\s+`-`", before)


TIMED = [page for folder in ("tutorials", "guides") for page in sorted((ROOT / "docs" / folder).glob("*.md"))]


@pytest.mark.parametrize("page", TIMED, ids=lambda page: page.name)
def test_a_tutorial_or_guide_states_how_long_it_takes(page: Path) -> None:
    text = page.read_text("utf-8")
    stated = re.search(r"^Time: about (\d+) minutes(?: if you copy the files, (\d+) if you type them)?[.,]", text, re.M)
    assert stated
    copied, typed = minutes(text)
    assert int(stated[1]) == pytest.approx(copied, abs=1.0)
    assert int(stated[2] or stated[1]) == pytest.approx(typed, abs=3.0)


def test_a_file_in_a_folder_that_the_page_does_not_mention_is_an_error(tmp_path: Path) -> None:
    page = '```text title="new/a.txt"\none\n```\n'
    with pytest.raises(AssertionError, match=r"new/a\.txt"):
        list(run(page, tmp_path))
    assert list(run(f"Create the folder `new`.\n{page}", tmp_path)) == []
