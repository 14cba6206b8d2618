"""Places of faults that occur in another file or element than the one that causes them."""

from pathlib import Path

import pytest

from urdfkit import expand
from urdfkit.errors import XacroError

ROBOT = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n{}\n</robot>'


def fault(folder: Path, body: str) -> XacroError:
    path = folder / "r.urdf.xacro"
    path.write_text(ROBOT.format(body))
    with pytest.raises(XacroError) as caught:
        expand(path)
    return caught.value


def test_a_missing_forwarded_parameter_is_a_fault_of_the_call(tmp_path: Path) -> None:
    error = fault(tmp_path, '<xacro:macro name="m" params="a:=^"><link name="${a}"/></xacro:macro>\n<xacro:m/>')
    assert "macro `m` needs `a` or a property of that name" in str(error)
    assert error.position is not None
    assert error.position.line == 3


def test_invalid_yaml_is_reported_with_its_file_and_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.yaml").write_text("a: 1\nb: [2, &x *y]")
    error = fault(tmp_path, "<link name=\"${xacro.load_yaml('bad.yaml')}\"/>")
    assert "`: bad.yaml:2:11: " in str(error)
