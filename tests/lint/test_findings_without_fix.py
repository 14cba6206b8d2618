"""A finding has a fix only where the text to change stands in the file as it is."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

CONTROL = '<ros2_control name="arm" type="system"/>'
DEGREES = """<xacro:property name="a" value="90"/><link name="base"/>
<joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/>
<limit lower="0" upper="%s" effort="1" velocity="1"/></joint><link name="arm"/>
"""


@pytest.mark.parametrize(
    ("code", "body", "has_fix"),
    [
        ("C708", f"<gazebo>{CONTROL}</gazebo>", True),
        ("C708", f"<gazebo>{CONTROL}<static/></gazebo>", False),
        ("C708", f'<xacro:element xacro:name="gazebo">{CONTROL}</xacro:element>', False),
        ("J407", DEGREES % "90", True),
        ("J407", DEGREES % "${a}", False),
        ("J408", '<link name="a"><visual><origin rpy="0 0 90"/></visual></link>', True),
        ("J408", '<link name="a"><visual><origin rpy="0 0 ${45*2}"/></visual></link>', False),
    ],
)
def test_only_literal_text_is_changed(code: str, body: str, has_fix: bool, write) -> None:
    (finding,) = lint(write("r.urdf.xacro", body), select=(code,))
    assert (finding.fix is not None) is has_fix
