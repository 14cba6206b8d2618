"""Legs of one macro: a sign that is missing in it, and sides and ends that are exchanged, have one finding."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

ROBOT = """<robot name="dog" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="trunk"><visual><geometry><box size="0.4 0.1 0.1"/></geometry></visual></link>
  <xacro:macro name="leg" params="name fore side">
    <link name="${name}_hip">
      <visual><origin xyz="0 ${side * 0.02} 0"/><geometry><box size="0.04 0.04 0.04"/></geometry></visual>
    </link>
    <link name="${name}_thigh">
      <visual><origin xyz="0 0 -0.1"/><geometry><box size="0.03 0.03 0.2"/></geometry></visual>
    </link>
    <joint name="${name}_hip_joint" type="revolute">
      <parent link="trunk"/><child link="${name}_hip"/>
      <origin xyz="${fore * 0.2} ${side * 0.09} 0"/>
      <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="5" velocity="1"/>
    </joint>
    <joint name="${name}_thigh_joint" type="revolute">
      <parent link="${name}_hip"/><child link="${name}_thigh"/>
      <origin xyz="0 ${side * 0.06} 0"/>
      <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="5" velocity="1"/>
    </joint>
  </xacro:macro>
  <xacro:leg name="lf" fore="1" side="1"/>
  <xacro:leg name="rf" fore="1" side="-1"/>
  <xacro:leg name="lh" fore="-1" side="1"/>
  <xacro:leg name="rh" fore="-1" side="-1"/>
</robot>"""


def found(folder, old, new):
    assert old in ROBOT
    file = folder / "dog.urdf.xacro"
    file.write_text(ROBOT.replace(old, new))
    return [(one.line, one.message) for one in lint(file) if one.code == "S909"]


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        (
            "${side * 0.06}",
            "0.06",
            17,
            (
                "joints `lf_thigh_joint` and `rf_thigh_joint` are not mirrored, unlike the shapes of their parents: "
                "y is 0.06 m for both"
            ),
        ),
        (
            "${fore * 0.2} ${side * 0.09}",
            "${side * 0.2} ${fore * 0.09}",
            12,
            "joints `lf_hip_joint`, `rf_hip_joint` and `lh_hip_joint`: left and right are swapped with front and rear",
        ),
    ],
)
def test_a_mistake_in_the_macro_of_the_legs_has_one_finding(tmp_path, old, new, line, message):
    [(at, text)] = found(tmp_path, old, new)
    assert at == line
    assert text == message


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("${fore * 0.2}", "${fore * 0.2}"),
        ("${fore * 0.2} ${side * 0.09}", "${-side * 0.09} ${fore * 0.2}"),  # y points forward
        ("0 ${side * 0.06} 0", "0.06 0 0"),
        ('xyz="0 ${side * 0.02} 0"', 'xyz="0 0 0"'),
    ],
)
def test_right_legs_have_no_finding(tmp_path, old, new):
    assert found(tmp_path, old, new) == []
