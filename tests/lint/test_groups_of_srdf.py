"""Groups of an SRDF: their names, the projections of planners, and the mistakes that have one finding."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license></package>"""
JOINT = """  <link name="lN"/>
  <joint name="jN" type="revolute"><parent link="lM"/><child link="lN"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="5" velocity="1"/></joint>
"""
ROBOT = f"""<robot name="arm"><link name="l0"/>
{"".join(JOINT.replace("N", str(n)).replace("M", str(n - 1)) for n in (1, 2, 3))}</robot>"""
SRDF = """<robot name="arm">
  <group name="lift"><joint name="j1"/></group>
  <group name="arm"><chain base_link="l1" tip_link="l3"/></group>
  <group name="arm_lift">
    <chain base_link="l0" tip_link="l3"/>
  </group>
  <group_state name="home" group="arm">
    <joint name="j2" value="0"/>
    <joint name="j3" value="0"/>
  </group_state>
</robot>"""
OMPL = "arm:\n  planner_configs: [RRT]\n  projection_evaluator: joints(j2,j3)\n"


def found(folder, srdf=SRDF, ompl=OMPL):
    (folder / "config").mkdir()
    for name, text in {
        "package.xml": MANIFEST,
        "arm.urdf": ROBOT,
        "config/arm.srdf": srdf,
        "config/ompl_planning.yaml": ompl,
    }.items():
        (folder / name).write_text(text)
    return [(one.code, one.line, one.message) for one in lint(folder, select=("M105", "M107", "M109"))]


def test_groups_that_contain_what_their_names_say_have_no_finding(tmp_path):
    assert found(tmp_path) == []


def test_a_group_without_the_joints_of_the_group_in_its_name(tmp_path):
    message = "group `arm_lift` has the joints of `arm` only, and none of group `lift`"
    assert found(tmp_path, SRDF.replace('base_link="l0"', 'base_link="l1"')) == [("M105", 5, message)]


def test_a_projection_over_joints_of_another_group(tmp_path):
    message = "joint `j1` of `projection_evaluator` is not in group `arm`"
    assert found(tmp_path, ompl=OMPL.replace("j2", "j1")) == [("M109", 3, message)]


@pytest.mark.parametrize("group", ["lift"])
def test_a_state_of_another_group_is_one_finding(tmp_path, group):
    findings = found(tmp_path, SRDF.replace('name="home" group="arm"', f'name="home" group="{group}"'))
    assert {code for code, _, _ in findings} == {"M107"}
    assert all("not in group `lift`" in message for _, _, message in findings)
