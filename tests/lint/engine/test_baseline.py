"""Findings that are known."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.xml.source import Span
from urdfkit.errors import ResourceError
from urdfkit.lint.engine.baseline import read, unknown, write
from urdfkit.lint.finding import Finding


def finding(code: str, line: int, severity: str = "error", message: str = "m") -> Finding:
    return Finding(code, "x", severity, message, Span("a.urdf", line, 1, line, 2))  # type: ignore[arg-type]


def test_what_is_known_is_left_out_wherever_it_has_moved(tmp_path):
    file = tmp_path / "known.json"
    before = [finding("E008", 3), finding("E008", 9), finding("T203", 4), finding("J413", 5, "note")]
    assert write(file, before) == 3
    after = [finding("E008", 13), finding("E008", 19), finding("E008", 20), finding("N302", 1)]
    new, known, gone = unknown(after, read(file))
    assert [(f.code, f.line) for f in new] == [("E008", 20), ("N302", 1)]
    assert (known, gone) == (2, 1)
    assert unknown(before, read(file))[0] == [before[3]]


def test_an_empty_one(tmp_path):
    assert write(tmp_path / "known.json", []) == 0
    assert read(tmp_path / "known.json") == {}


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"baseline": 1}', '{"baseline": 1, "findings": [{"file": "a"}]}', "3"]
)
def test_what_is_no_baseline(tmp_path, text):
    file = Path(tmp_path / "known.json")
    file.write_text(text)
    with pytest.raises(ResourceError, match="is not a baseline"):
        read(file)


def test_one_that_is_not_there_or_too_new(tmp_path):
    with pytest.raises(ResourceError, match="create one with --write-baseline"):
        read(tmp_path / "none.json")
    (tmp_path / "new.json").write_text('{"baseline": 2, "findings": []}')
    with pytest.raises(ResourceError, match="later version of urdfkit"):
        read(tmp_path / "new.json")
