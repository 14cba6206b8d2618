"""Figures of the linter's precision in README and docs are those of the reviewed findings."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_numbers_of_findings_are_those_of_the_reviewed_ones() -> None:
    rows = (ROOT / "tests/lint/corpus.tsv").read_text("utf-8").splitlines()[1:]
    found = Counter(row.split("\t", 1)[0] for row in rows)
    page = (ROOT / "docs/linting.md").read_text("utf-8")
    assert f"| errors | {found['error']} |" in page
    assert f"| warnings | {found['warning']} |" in page
    assert f"| {len(rows)} errors and warnings on 174" in (ROOT / "README.md").read_text("utf-8")


def test_the_drawn_findings_are_as_the_page_says() -> None:
    rows = (ROOT / "tests/bench/corpus_verdicts.tsv").read_text("utf-8").splitlines()[1:]
    verdicts = Counter("right" if "\tright\t" in row else "wrong" for row in rows)
    page = (ROOT / "docs/linting.md").read_text("utf-8")
    assert f"A sample of {len(rows)} findings" in page
    assert f"\n{verdicts['right']} are right" in page
