"""Findings on parts compared with their counterparts, and at the place where the wrong value was written."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

INERTIAL = """<inertial><mass value="1"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>"""
ARMS = f"""<robot name="arms" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="torso"><visual><geometry><box size="0.2 0.2 0.6"/></geometry></visual>{INERTIAL}</link>
  <xacro:macro name="arm" params="side reflect">
    <joint name="${{side}}_shoulder" type="revolute"><parent link="torso"/><child link="${{side}}_upper"/>
      <origin xyz="0 ${{reflect*0.1}} 0.2"/>
      <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="9" velocity="1"/></joint>
    <link name="${{side}}_upper">
      <visual>
        <origin xyz="0 ${{reflect*0.1}} 0"/>
        <geometry><box size="0.05 0.2 0.05"/></geometry>
      </visual>{INERTIAL}
    </link>
    <joint name="${{side}}_elbow" type="revolute"><parent link="${{side}}_upper"/><child link="${{side}}_lower"/>
      <origin xyz="0 ${{reflect*0.2}} 0"/>
      <axis xyz="0 1 0"/><limit lower="-2" upper="0" effort="9" velocity="1"/></joint>
    <link name="${{side}}_lower">{INERTIAL}</link>
  </xacro:macro>
  <xacro:arm side="left" reflect="1"/>
  <xacro:arm side="right" reflect="-1"/>
</robot>
"""
SRDF = """<robot name="arms">
  <group name="left"><joint name="left_elbow"/></group>
  <group name="right"><joint name="right_elbow"/></group>
  <group_state name="home" group="left"><joint name="left_elbow" value="-1.2"/></group_state>
  <group_state name="home" group="right"><joint name="right_elbow" value="-1.2"/></group_state>
</robot>
"""


def found(folder, old, new, srdf=""):
    """Return code, line, message and help of each finding."""
    assert old in ARMS
    (folder / "arms.urdf.xacro").write_text(ARMS.replace(old, new))
    if srdf:
        (folder / "arms.srdf").write_text(srdf)
    return {
        (one.code, one.line, one.message, one.help) for one in lint(folder / "arms.urdf.xacro", select=("S909", "M107"))
    }


def line_of(text):
    return next(n for n, line in enumerate(ARMS.splitlines(), 1) if text in line)


def test_mirrored_arms_have_no_finding(tmp_path):
    assert found(tmp_path, "torso", "torso", SRDF) == set()


def test_a_side_that_the_call_repeats_is_reported_at_the_call(tmp_path):
    ((code, line, message, _),) = found(tmp_path, 'reflect="-1"', 'reflect="1"')
    assert (code, line) == ("S909", line_of('side="right"'))
    assert "`left_shoulder` and `right_shoulder` have the same origin" in message


def test_a_shape_that_is_not_mirrored_is_reported_in_the_macro(tmp_path):
    ((code, line, message, help),) = found(tmp_path, '<origin xyz="0 ${reflect*0.1} 0"/>', '<origin xyz="0 0.1 0"/>')
    assert (code, line) == ("S909", line_of('<origin xyz="0 ${reflect*0.1} 0"/>'))
    assert help == "check the sign of the offset"
    assert message == (
        "shapes of links `left_upper` and `right_upper` are not mirrored, unlike the joints below: y is 0.1 m for both"
    )


@pytest.mark.parametrize("limits", ['lower="0" upper="2"'])
def test_limits_with_the_wrong_sign_are_reported_once_and_not_in_the_states(tmp_path, limits):
    ((code, line, message, help),) = found(tmp_path, 'lower="-2" upper="0"', limits, SRDF)
    assert (code, line) == ("M107", line_of('lower="-2"'))
    assert help == "check the signs of the limits"
    assert message == "the limits of joint `left_elbow` exclude all states of the SRDF (-1.2)"


CHAIN = """<robot name="arms" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="torso"/>
  <xacro:macro name="part" params="name parent child xyz">
    <link name="${child}"/>
    <joint name="${name}" type="revolute"><parent link="${parent}"/><child link="${child}"/>
      <origin xyz="${xyz}"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="9" velocity="1"/></joint>
  </xacro:macro>
  <xacro:macro name="arm" params="side k elbow hand">
    <xacro:part name="${side}_shoulder" parent="torso" child="${side}_upper" xyz="0 ${k*0.2} 0.4"/>
    <xacro:part name="${side}_twist" parent="${side}_upper" child="${side}_middle" xyz="0 ${k*0.05} 0"/>
    <xacro:part name="${side}_elbow" parent="${side}_middle" child="${side}_lower" xyz="${elbow} ${k*0.02} -0.3"/>
    <xacro:part name="${side}_wrist" parent="${side}_lower" child="${side}_palm" xyz="0 ${k*0.01} -0.25"/>
    <xacro:part name="${side}_hand" parent="${side}_palm" child="${side}_tool" xyz="${hand} 0 -0.1"/>
  </xacro:macro>
  <xacro:arm side="left" k="1" elbow="0.05" hand="0.03"/>
  <xacro:arm side="right" k="-1" elbow="ELBOW" hand="HAND"/>
</robot>
"""


@pytest.mark.parametrize(
    ("elbow", "hand", "expected"),
    [
        ("0.05", "0.03", []),
        ("0.05", "0", []),
        ("0.05", "-0.03", ["hand"]),
        ("0.15", "0.03", ["elbow"]),
    ],
)
def test_only_the_tools_of_two_arms_may_differ(tmp_path, elbow, hand, expected):
    (tmp_path / "arms.urdf.xacro").write_text(CHAIN.replace("ELBOW", elbow).replace("HAND", hand))
    reported = [one.message for one in lint(tmp_path / "arms.urdf.xacro", select=("S909",))]
    assert len(reported) == len(expected)
    assert all(f"_{joint}` are not mirrored" in one for joint, one in zip(expected, reported, strict=True)), reported
