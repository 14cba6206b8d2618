"""Precision on real robots and recall on the tutorials' models, where ``../shared`` lies next to the checkout."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import pytest

from urdfkit.lint import Finding, lint
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

SHARED = Path(__file__).parents[2].parent / "shared"

SNAPSHOT = Path(__file__).with_name("corpus.tsv")
"""Every distinct error and warning on robots that load, each looked at: whether it is true, and why."""


def adjudicated() -> dict[tuple[str, str, str, int, str], tuple[str, str]]:
    """Severity, code, file, line and message of each finding → verdict and reason."""
    rows = [line.split("\t") for line in SNAPSHOT.read_text("utf-8").splitlines()[1:]]
    return {(row[0], row[1], row[2], int(row[3]), row[4]): (row[5], row[6]) for row in rows}


def test_every_finding_has_a_verdict_and_the_page_says_how_many_are_false():
    known = adjudicated()
    assert all(verdict in ("true", "false") and reason for verdict, reason in known.values())
    page = (Path(__file__).parents[2] / "docs" / "linting.md").read_text("utf-8")
    for severity in ("error", "warning"):
        verdicts = [verdict for key, (verdict, _) in known.items() if key[0] == severity]
        false = verdicts.count("false")
        assert f"| {severity}s | {len(verdicts)} | {false} | {1 - false / len(verdicts):.1%} |" in page
    assert not [key for key, (verdict, _) in known.items() if key[0] == "error" and verdict == "false"]


@pytest.mark.slow
@pytest.mark.skipif(not SHARED.is_dir(), reason="no ../shared")
def test_robots_that_load_have_the_findings_that_were_looked_at(monkeypatch):
    corpus = SHARED / "corpus"
    monkeypatch.chdir(corpus)
    found = set()
    for model in json.loads((corpus / "expected.json").read_text())["models"]:
        if not model["loads"]:
            continue
        outcome = run([Entry(Path(model["entry"]))], Options(arguments=model.get("args") or {}))
        serious = [f for f in outcome.findings if f.severity != "note" and not is_known(f)]
        # The places of one cause with one message, such as the meshes of a missing package, have one verdict.
        first = {(f.code, f.file, f.message, "" if f.cause else f.line): f for f in reversed(serious)}
        found.update((f.severity, f.code, f.file, f.line, f.message) for f in first.values())
    known = adjudicated().keys()
    assert sorted(found - known) == []
    assert sorted(known - found) == []


def is_known(finding: Finding) -> bool:
    return finding.code == "G601" and is_upstream(finding.message)


@cache
def upstream() -> dict[str, list[str]]:
    """The meshes that exist upstream and were left out of the corpus: file name → paths."""
    found: dict[str, list[str]] = {}
    for mesh in json.loads((SHARED / "corpus" / "meshes.json").read_text())["meshes"]:
        found.setdefault(mesh["path"].rpartition("/")[2], []).append(mesh["path"])
    return found


def is_upstream(message: str) -> bool:
    uri = message.split("`")[1]
    inside = uri.partition("://")[2].partition("/")[2] if "://" in uri else uri.replace("../", "")
    return any(path.endswith(f"/{inside}") for path in upstream().get(inside.rpartition("/")[2], []))


def cases() -> list:
    return [pytest.param(path, id=path.parent.name) for path in sorted(SHARED.glob("seed_cases/*/expected.json"))]


@pytest.mark.parametrize("path", cases())
def test_defects_of_the_tutorials_are_found(path, monkeypatch):
    expected = json.loads(path.read_text())
    monkeypatch.chdir(path.parent)
    findings = lint(expected["entry"], target=expected["target"])

    def found(code: str, places: list, severities: tuple[str, ...], away: int = 1) -> bool:
        return any(
            (finding.code, finding.file) == (code, place["file"])
            and abs(finding.line - place["line"]) <= away
            and finding.severity in severities
            for finding in findings
            for place in places
        )

    for row in expected["must"]:
        wanted = ("error", "warning", "note") if row.get("level") == "info" else ("error", "warning")
        codes = [row["code"], *row.get("or", [])]
        assert any(found(code, [row, *row.get("also", [])], wanted) for code in codes), row
    for row in expected["must_not"]:
        assert not found(row["code"], [row], ("error", "warning"), away=0), row
