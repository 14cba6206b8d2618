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


def test_a_state_of_a_group_that_repeats_another_one_is_not_reported_too(tmp_path):
    srdf = SRDF.replace('base_link="l0"', 'base_link="l1"').replace(
        'name="home" group="arm"', 'name="h" group="arm_lift"'
    )
    findings = found(tmp_path, srdf.replace('<joint name="j2" value="0"/>', '<joint name="j1" value="0"/>'))
    assert [code for code, _, _ in findings] == ["M105"]


def test_a_reason_and_a_group_that_contradict_a_parent_are_one_finding_there(tmp_path):
    pair = '<disable_collisions link1="l0" link2="l2" reason="Never"/></robot>'
    group = '<chain base_link="l0" tip_link="l3"/>'
    state = '<joint name="j1" value="0"/>'
    srdf = (
        SRDF.replace("</robot>", pair)
        .replace('group="arm">', 'group="arm_lift">')
        .replace('<joint name="j2"', state + '<joint name="j2"')
    )
    assert group in srdf
    (tmp_path / "config").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "arm.urdf").write_text(ROBOT.replace('parent link="l1"', 'parent link="l0"'))
    (tmp_path / "config" / "arm.srdf").write_text(srdf)
    [found] = lint(tmp_path, select=("M102", "M107"))
    line = next(n for n, text in enumerate(ROBOT.splitlines(), 1) if 'parent link="l1"' in text)
    assert (found.file.rpartition("/")[2], found.line, len(found.related)) == ("arm.urdf", line, 2)


def test_a_projection_over_joints_of_another_group(tmp_path):
    message = "joint `j1` of `projection_evaluator` is not in group `arm`"
    assert found(tmp_path, ompl=OMPL.replace("j2", "j1")) == [("M109", 3, message)]


@pytest.mark.parametrize("group", ["lift"])
def test_a_state_of_another_group_is_one_finding(tmp_path, group):
    findings = found(tmp_path, SRDF.replace('name="home" group="arm"', f'name="home" group="{group}"'))
    assert {code for code, _, _ in findings} == {"M107"}
    assert all("not in group `lift`" in message for _, _, message in findings)


FINGERS = ROBOT.replace("</robot>", "{}</robot>").format(
    "".join(
        JOINT.replace("lN", f"{side}_finger").replace("jN", f"{side}_joint").replace("lM", "l3")
        for side in ("left", "right")
    )
)
GRIPPER = """<robot name="arm">
  <group name="arm"><chain base_link="l0" tip_link="l3"/></group>
  <group name="gripper">
    <joint name="left_joint"/>
  </group>
  <group_state name="open" group="gripper"><joint name="left_joint" value="0.5"/></group_state>
  <group_state name="closed" group="gripper"><joint name="left_joint" value="0"/></group_state>
  <passive_joint name="right_joint"/>
</robot>"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("", "", None),
        (
            'group name="gripper"',
            'group name="hand"',
            "M104 group `hand` is not used; did you mean `gripper`, which is used but undefined?",
        ),
        (
            '<joint name="left_joint"/>\n',
            '<link name="left_joint"/>\n',
            "M104 link `left_joint` of <link> does not exist in robot `arm`; it is a joint: write <joint>",
        ),
    ],
)
def test_a_mistake_in_a_group_has_one_finding(tmp_path, old, new, message):
    (tmp_path / "config").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "arm.urdf").write_text(FINGERS)
    (tmp_path / "config" / "arm.srdf").write_text(GRIPPER.replace(old, new))
    (tmp_path / "config" / "ompl_planning.yaml").write_text("gripper:\n  planner_configs: [RRT]\n")
    found = lint(tmp_path, select=("M104", "M105", "M107", "M108", "M109"))
    assert [f"{one.code} {one.message}" for one in found] == ([message] if message else [])


ARM = """<robot name="arm">
  <link name="base"/>
  <link name="hand"/>
  <joint name="wrist" type="fixed"><parent link="base"/><child link="hand"/></joint>
</robot>
"""
CHAIN = """<robot name="arm">
  <group name="arm"><chain base_link="base" tip_link="hand"/></group>
  <passive_joint name="wrsit"/>
</robot>
"""


def test_srdf_of_a_package_with_included_files_and_of_a_folder_without_a_package_is_read(tmp_path):
    for name in ("cell", "arm_description"):
        (tmp_path / name / "srdf").mkdir(parents=True)
        manifest = f"<package format='3'><name>{name}</name><depend>arm_description</depend></package>"
        (tmp_path / name / "package.xml").write_text(manifest)
    (tmp_path / "arm_description" / "arm.xacro").write_text(ARM)
    (tmp_path / "arm_description" / "srdf" / "arm.srdf").write_text(CHAIN)
    xacro = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="{}"/></robot>'
    (tmp_path / "cell" / "arm.urdf.xacro").write_text(xacro.format("$(find arm_description)/arm.xacro"))
    assert [f.code for f in lint(tmp_path / "cell", select=("M104",))] == ["M104"]
    (tmp_path / "plain" / "urdf").mkdir(parents=True)
    (tmp_path / "plain" / "srdf").mkdir()
    (tmp_path / "plain" / "urdf" / "arm.urdf").write_text(ARM)
    (tmp_path / "plain" / "srdf" / "arm.srdf").write_text(CHAIN)
    assert [f.code for f in lint(tmp_path / "plain" / "urdf" / "arm.urdf", select=("M104",))] == ["M104"]
