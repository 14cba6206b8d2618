from __future__ import annotations

import difflib
from pathlib import Path
from typing import Any

import pytest

from urdfkit.app.viewer.findings_panel import FindingsPanel
from urdfkit.resources import find_model


def rows(path: Path, links: int) -> list[dict[str, Any]]:
    """Lint a robot whose links have an attribute with a fix; return the findings with one."""
    link = (
        '  <link name="l{0}"/>\n  <joint name="j{0}" type=" fixed">\n'
        '    <parent link="b"/><child link="l{0}"/>\n  </joint>\n'
    )
    path.write_text(f'<robot name="r">\n  <link name="b"/>\n{"".join(map(link.format, range(links)))}</robot>\n')
    found = FindingsPanel(find_model([str(path)])).lint()["findings"]
    return [row for row in found if "fix" in row]


def test_the_diff_of_a_fix_has_the_lines_of_the_file(tmp_path: Path) -> None:
    found = rows(tmp_path / "r.urdf", 3)
    removed = [f'-  <joint name="j{i}" type=" fixed">' for i in range(3)]
    added = [f'+  <joint name="j{i}" type="fixed">' for i in range(3)]
    assert [row["fix"]["diff"] for row in found] == [
        [f"@@ -{4 * i + 4} +{4 * i + 4} @@", removed[i], added[i]] for i in range(3)
    ]


def test_the_compared_lines_grow_with_the_number_of_findings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compared = []
    original = difflib.unified_diff

    def counted(a: list[str], b: list[str], **options: Any) -> Any:
        compared.append(len(a) + len(b))
        return original(a, b, **options)

    monkeypatch.setattr(difflib, "unified_diff", counted)
    for links in (5, 20):
        compared.clear()
        assert len(rows(tmp_path / "r.urdf", links)) == links
        assert compared == [2] * links


@pytest.mark.parametrize("may_write", [True, False])
def test_only_safe_fixes_may_be_applied_where_files_may_be_written(tmp_path: Path, *, may_write: bool) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        '<robot name="r">\n  <link name="base"/>\n  <link name="wheel"/>\n'
        '  <joint name="j" type=" fixed"><parent link="bsae"/><child link="wheel"/></joint>\n</robot>\n'
    )
    found = FindingsPanel(find_model([str(path)]), may_write=may_write).lint()["findings"]
    may = {row["fix"]["safety"]: row["fix"]["may"] for row in found if "fix" in row}
    assert may == {"safe": may_write, "unsafe": False}
