"""Precision on real robots and recall on the tutorials' models, where ``../shared`` lies beside the checkout."""

from __future__ import annotations

import json
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from urdfkit.lint import Finding, lint
from urdfkit.lint.engine import Options, run
from urdfkit.lint.entries import Entry

SHARED = Path(__file__).parents[2].parent / "shared"

TRUE_FINDINGS = {
    # file: {code: how many}, each looked at by hand
    "anymal-kinova.urdf": {"I502": 1},  # base: a foot of hyq's tensor, 0 0 3e-06
    "anymal_b_simple_description/robots/anymal.urdf": {"I502": 1},  # the same base
    "anymal_c_simple_description/urdf/anymal.urdf": {"I502": 1, "I503": 4},  # hatch 0 0 0.003; four depth cameras
    "finger_edu.urdf": {"I502": 1},  # a rod without thickness
    "hyq_no_sensors.urdf": {"I502": 5},  # trunk and feet: 0 0 3e-06
    "romeo.urdf": {"I503": 2},  # right arm: 0.00066 + 0.00068 < 0.0066, the left arm is right
    "romeo_small.urdf": {"I503": 2},
    "romeo_laas_small.urdf": {"I502": 3, "I503": 2},
    "fer.urdf.xacro": {"I503": 1},  # link 4, known to the maker
    "parser_urdf_atlas.urdf": {"I503": 10},
    "panda-gazebo.urdf": {"G611": 2},  # cylinders without length
    "cfm_damping_implicit_spring_damper.urdf": {"E014": 4},  # masses without tensor: urdfdom drops both
}


TRUE_WHEREVER = (("Z801", "`stick_link`"), ("Z801", "`depthCamera_link_left`"))
"""True in every file that has it, by code and what the message says: unitree's robots lack the links."""


WARNINGS = Counter(
    C706=29,
    E004=17,
    E007=9,
    E008=6,
    E013=78,
    G602=2,
    G603=20,
    G606=20,
    G612=46,
    I501=33,
    I507=24,
    I508=2,
    I509=5,
    I513=15,
    I514=8,
    J406=42,
    J407=2,
    J412=8,
    J420=1,
    K956=2,
    N301=44,
    S906=6,
    X123=3,
    Z804=2,
    Z805=20,
    Z806=10,
    Z816=30,
    Z819=1,
    Z822=2,
)
"""How many distinct warnings there are by rule; a sample of each was looked at by hand."""


def is_known(finding: Finding) -> bool:
    if finding.code == "G601":
        return is_upstream(finding.message)
    return any(finding.code == code and part in finding.message for code, part in TRUE_WHEREVER)


@pytest.mark.skipif(not SHARED.is_dir(), reason="no ../shared")
def test_robots_that_load_have_no_error_but_true_ones(monkeypatch):
    corpus = SHARED / "corpus"
    monkeypatch.chdir(corpus)
    unexplained = {}
    used = set()
    warnings: Counter[tuple[str, str, int, str]] = Counter()
    for model in json.loads((corpus / "expected.json").read_text())["models"]:
        if not model["loads"]:
            continue
        outcome = run([Entry(Path(model["entry"]))], Options(arguments=model.get("args") or {}))
        errors = Counter(
            finding.code for finding in outcome.findings if finding.severity == "error" and not is_known(finding)
        )
        warnings.update({(f.code, f.file, f.line, f.message) for f in outcome.findings if f.severity == "warning"})
        known = next((name for name in TRUE_FINDINGS if model["entry"].endswith(f"/{name}")), None)
        used.add(known)
        if errors != TRUE_FINDINGS.get(known or "", {}):
            unexplained[model["entry"]] = errors
    assert not unexplained
    assert set(TRUE_FINDINGS) <= used
    assert Counter(code for code, *_ in warnings) == WARNINGS


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
        wanted = ("error", "warning", "info") if row.get("level") == "info" else ("error", "warning")
        codes = [row["code"], *row.get("or", [])]
        assert any(found(code, [row, *row.get("also", [])], wanted) for code in codes), row
    for row in expected["must_not"]:
        assert not found(row["code"], [row], ("error", "warning"), away=0), row
