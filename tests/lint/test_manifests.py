"""A package.xml that cannot be read is a finding, and the robots of its package are linted."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

GOOD = "<package><name>p</name><version>0.0.1</version></package>"


@pytest.mark.parametrize(
    ("text", "line"),
    [("<package>\n<name>p</name>\n<version>0.0.1\n</package>\n", 4), ("", 1), ("  \n", 1), ("nothing", 1)],
)
def test_a_manifest_that_is_no_xml_is_told_in_its_place(tmp_path, monkeypatch, text, line):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "package.xml").write_text(text)
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf" / "r.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    (found,) = lint(tmp_path)
    assert (found.code, found.severity, found.file, found.line) == ("K964", "error", "package.xml", line)
    (tmp_path / "package.xml").write_text(GOOD)
    assert lint(tmp_path) == []
