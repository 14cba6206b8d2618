"""Figures in README and docs are those of the reviewed findings, and those that the benchmarks wrote into the pages."""

from __future__ import annotations

import re
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
    page = " ".join((ROOT / "docs/linting.md").read_text("utf-8").split())
    assert f"judged a sample of {len(rows)} findings" in page
    assert f"{verdicts['right']} findings are right and worth reporting" in page


def test_the_figures_of_the_readme_are_those_of_the_pages() -> None:
    readme = " ".join((ROOT / "README.md").read_text("utf-8").split())
    linting, performance, fidelity = (
        (ROOT / name).read_text("utf-8") for name in ("docs/linting.md", "docs/performance.md", "docs/fidelity.md")
    )
    [(ours, theirs)] = re.findall(r"^\| 100 \| (\d+ ms) \| \d+ ms \| (\d+ ms) \|", linting, re.MULTILINE)
    assert f"{ours} of CPU for 100 links, compared with {theirs}" in readme
    section = performance.partition("\n## With plugins and topics\n")[2].partition("\n## ")[0]
    ratios = [float(ratio) for ratio in re.findall(r"\| ([\d.]+), [\d.]+ \|$", section, re.MULTILINE)]
    assert len(ratios) == 6
    assert f"six robots without plugins, one step per call: {min(ratios)} to {max(ratios)} times" in readme
    runs = [float(ratio) for ratio in re.findall(r"\| ([\d.]+) \| ≥ [\d.]+ \|$", section, re.MULTILINE)]
    assert len(runs) == 5
    assert f"five runs with plugins and topics: {min(runs)} to {max(runs)} times the speed of MuJoCo" in readme
    [heap] = re.findall(
        r"^\| 200 boxes falling into a heap \|.*\| \**([\d.]+)\** \| [^|]*\|$", performance, re.MULTILINE
    )
    assert f"in a heap of 200 boxes it has {heap} times the speed of MuJoCo" in readme
    pattern = r"urdfkit is better in (\d+) of (\d+) rows, equal in (\d+) and worse in (\d+)"
    [(better, rows, equal, worse)] = re.findall(pattern, fidelity)
    assert worse == "0"
    verdicts = f"smaller than that of the most accurate other simulator in {better} cases, equal in {equal}"
    assert f"{rows} closed-form solutions: the error is {verdicts} and larger in none" in readme
