"""Controllers in YAML and the packages that they need, and SRDF files of several robots."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import Finding, lint

MANIFEST = """<package format="3">
  <name>arm_description</name>
  <version>1.0.0</version>
  <description>A package for tests.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  {depends}
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
ROBOT = """<robot name="arm">
  <link name="base"/>
  <link name="hand"/>
  <joint name="elbow" type="revolute">
    <parent link="base"/><child link="hand"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <ros2_control name="system" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <joint name="elbow"><command_interface name="position"/><state_interface name="position"/></joint>
  </ros2_control>
</robot>
"""
YAML = """controller_manager:
  ros__parameters:
    arm_controller: {{type: joint_trajectory_controller/JointTrajectoryController}}
    hand_controller: {{type: position_controllers/GripperActionController}}
arm_controller:
  ros__parameters:
    joints: [elbow]
    command_interfaces: [{interface}]
    state_interfaces: [position]
"""


def findings(folder: Path, code: str, *depends: str, interface: str = "position") -> list[Finding]:
    package = folder / "arm_description"
    package.mkdir()
    lines = "\n  ".join(f"<exec_depend>{name}</exec_depend>" for name in depends)
    (package / "package.xml").write_text(MANIFEST.format(depends=lines))
    (package / "arm.urdf").write_text(ROBOT)
    (package / "controllers.yaml").write_text(YAML.format(interface=interface))
    return [one for one in lint(package) if one.code == code]


@pytest.mark.parametrize(
    ("depends", "is_missing"),
    [
        (["controller_manager", "gripper_controllers"], True),
        (["controller_manager", "gripper_controllers", "joint_trajectory_controller"], False),
        (["ros2_control", "ros2_controllers"], False),
        (["rviz2"], False),
    ],
)
def test_packages_of_controllers_are_dependencies(tmp_path, depends, is_missing):
    found = [(each.line, one.message) for one in findings(tmp_path, "K956", *depends) for each in one.related]
    message = "missing dependency on `joint_trajectory_controller`, which provides controller `arm_controller`"
    assert found == ([(3, message)] if is_missing else [])


@pytest.mark.parametrize(("interface", "near"), [("positiion", "position"), ("velocity", None)])
def test_a_misspelt_interface_is_answered_with_its_name(tmp_path, interface, near):
    (found,) = findings(tmp_path, "K965", interface=interface)
    assert found.message.endswith("; did you mean `position`?") is (near is not None)
    assert found.help == (
        f"write `{near}`"
        if near
        else f'add <command_interface name="{interface}"/> to the hardware, or change the controller'
    )


@pytest.mark.parametrize("has_package", [False, True])
@pytest.mark.parametrize(("name", "is_reported"), [("leg", False), ("arm", True), ("foot", True)])
def test_the_broken_srdf_of_another_robot_is_reported_with_that_robot(tmp_path, has_package, name, is_reported):
    if has_package:
        (tmp_path / "package.xml").write_text(MANIFEST.format(depends=""))
    for robot in ("arm", "leg"):
        (tmp_path / f"{robot}.urdf").write_text(f'<robot name="{robot}">\n  <link name="base"/>\n</robot>\n')
    (tmp_path / "any.srdf").write_text(f'<robot name="{name}">\n  <group name="all">\n</robot>\n')
    assert ("M101" in {one.code for one in lint(tmp_path / "arm.urdf")}) is is_reported
    assert "M101" in {one.code for one in lint(tmp_path)}


LIMB = """<robot name="limb">
  {links}
  {joints}
</robot>
"""
SEMANTICS = """<robot name="{robot}">
  <group name="limb"><chain base_link="{base}" tip_link="c"/></group>
  <group_state name="home" group="{group}"><joint name="a_b" value="0"/><joint name="{valued}" value="0"/></group_state>
  <end_effector name="tip" parent_link="{parent}" group="limb"/>
  <disable_collisions link1="a" link2="{link}" reason="{reason}"/>
</robot>
"""
SHAPE = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'


def test_an_srdf_belongs_to_the_robot_that_its_file_is_named_after(tmp_path: Path) -> None:
    links, joints = '<link name="a"/><link name="b"/>', '<joint name="a_b" type="fixed">{}</joint>'
    body = links + joints.format('<parent link="a"/><child link="b"/>')
    (tmp_path / "package.xml").write_text("<package><name>robots</name></package>")
    for robot in ("bolt", "solo"):
        (tmp_path / f"{robot}.urdf").write_text(f'<robot name="{robot}">{body}</robot>')
    (tmp_path / "bolt.srdf").write_text('<robot name="finger"><group name="leg"><joint name="a_b"/></group></robot>')
    found = [finding.message for finding in lint(tmp_path, select=["M103"])]
    assert found == ["the SRDF is for robot `finger`, but the URDF is robot `bolt`"]


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, []),
        ({"reason": "Adjcent"}, ["M102 unknown reason `Adjcent`; did you mean `Adjacent`?"]),
        ({"link": "c"}, ["M102 the reason is `Adjacent`, but several joints separate links `a` and `c`"]),
        ({"link": "c", "reason": "Never"}, []),
        ({"parent": "c"}, ["M105 parent link `c` of end effector `tip` is in group `limb`"]),
        (
            {"valued": "b_cc"},
            ["M104 joint `b_cc` of <joint> does not exist in robot `limb`; did you mean `b_c`?"],
        ),
        ({"group": "limp"}, ["M104 group `limp` of <group_state> does not exist in this SRDF; did you mean `limb`?"]),
        (
            {"robot": "lmb", "base": "c"},
            [
                "M103 the SRDF is for robot `lmb`, but the URDF is robot `limb`",
                "M105 the chain from `c` to `c` has no joint",
            ],
        ),
    ],
)
def test_mistakes_in_an_srdf(changes: dict[str, str], expected: list[str], tmp_path: Path) -> None:
    words = {"robot": "limb", "base": "a", "group": "limb", "link": "b", "reason": "Adjacent", **changes}
    words = {"parent": "a", "valued": "b_c", **words}
    links = "".join(f'<link name="{name}">{SHAPE}</link>' for name in "abc")
    joints = "".join(
        f'<joint name="{a}_{b}" type="revolute"><parent link="{a}"/><child link="{b}"/><axis xyz="0 0 1"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for a, b in ("ab", "bc")
    )
    (tmp_path / "limb.urdf").write_text(LIMB.format(links=links, joints=joints))
    (tmp_path / "limb.srdf").write_text(SEMANTICS.format(**words))
    found = [f"{one.code} {one.message}" for one in lint(tmp_path / "limb.urdf") if one.code.startswith("M")]
    assert sorted(found) == sorted(expected)


@pytest.mark.parametrize(
    ("pairs", "expected"),
    [
        ("ab bc cd de", []),
        ("ab bc cd", ["M110 links `d` and `e` are adjacent, but their collisions are not disabled"]),
        ("ab bc cd dd", ["M106 link `d` cannot collide with itself"]),
        ("ab bc", []),
    ],
)
def test_the_only_missing_pair_of_adjacent_links_is_reported(pairs: str, expected: list[str], tmp_path: Path) -> None:
    links = "".join(f'<link name="{name}">{SHAPE}</link>' for name in "abcde")
    joints = "".join(
        f'<joint name="{a}_{b}" type="fixed"><parent link="{a}"/><child link="{b}"/><origin xyz="0.2 0 0"/></joint>'
        for a, b in ("ab", "bc", "cd", "de")
    )
    (tmp_path / "limb.urdf").write_text(LIMB.format(links=links, joints=joints))
    disabled = "".join(f'<disable_collisions link1="{a}" link2="{b}" reason="Adjacent"/>' for a, b in pairs.split())
    group = '<group name="limb"><chain base_link="a" tip_link="e"/></group>'
    (tmp_path / "limb.srdf").write_text(f'<robot name="limb">{group}{disabled}</robot>')
    found = [f"{one.code} {one.message}" for one in lint(tmp_path / "limb.urdf") if one.code.startswith("M")]
    assert found == expected


@pytest.mark.parametrize(
    ("left_out", "more", "expected"),
    [
        ("", "", []),
        ("", "left_arm right_hand", []),
        ("left_arm left_tip", "left_arm right_hand", []),
        ("outer inner", "", ["M110 links `outer` and `inner` overlap with every joint at zero, but "]),
        (
            "left_arm left_tip",
            "",
            ["M110 links `left_arm` and `left_tip` are the counterparts of a pair that the SRDF "],
        ),
        ("left_arm left_hand", "", ["M110 links `left_arm` and `left_hand` are adjacent, but "]),
    ],
)
def test_pairs_of_links_that_are_not_adjacent_are_compared(
    left_out: str, more: str, expected: list[str], tmp_path: Path
) -> None:
    limbs = [(side, sign) for side, sign in (("left", 1), ("right", -1))]
    sizes = {"outer": 0.2, "middle": 0.16, "inner": 0.12}
    sizes |= {f"{side}_{part}": 0.02 for side, _ in limbs for part in ("arm", "hand", "tip")}
    links = "".join(
        f'<link name="{name}"><collision><geometry><box size="{size} {size} 0.6"/></geometry></collision></link>'
        for name, size in sizes.items()
    )
    joints = [("outer", "middle", "prismatic", "0 0 0"), ("middle", "inner", "prismatic", "0 0 0")]
    for side, sign in limbs:
        joints.append(("inner", f"{side}_arm", "revolute", f"0 {sign * 0.2} 0"))
        joints.append((f"{side}_arm", f"{side}_hand", "revolute", f"0 {sign * 0.1} 0"))
        joints.append((f"{side}_hand", f"{side}_tip", "revolute", f"0 {sign * 0.1} 0"))
    written = "".join(
        f'<joint name="{child}_joint" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}"/><axis xyz="0 0 1"/><limit lower="0" upper="0.3" effort="9" velocity="1"/></joint>'
        for parent, child, kind, xyz in joints
    )
    (tmp_path / "limb.urdf").write_text(LIMB.format(links=links, joints=written))
    pairs = [f"{parent} {child}" for parent, child, _, _ in joints] + ["outer inner"]
    pairs += [f"{side}_arm {side}_tip" for side, _ in limbs] + [more] * bool(more)
    names = [pair.split() for pair in pairs if pair != left_out]
    disabled = "".join(f'<disable_collisions link1="{a}" link2="{b}" reason="Default"/>' for a, b in names)
    group = '<group name="limb"><chain base_link="outer" tip_link="inner"/></group>'
    (tmp_path / "limb.srdf").write_text(f'<robot name="limb">{group}{disabled}</robot>')
    found = [f"{one.code} {one.message}" for one in lint(tmp_path / "limb.urdf") if one.code == "M110"]
    assert len(found) == len(expected)
    assert all(one.startswith(start) for one, start in zip(found, expected, strict=True))


def test_the_missing_pair_is_written_in_the_help(tmp_path: Path) -> None:
    boxes = '<link name="{0}"><collision><geometry><box size="{1} {1} 0.5"/></geometry></collision></link>'
    links = "".join(boxes.format(name, size) for name, size in (("a", 0.3), ("b", 0.2), ("c", 0.1)))
    joint = '<joint name="{0}_{1}" type="fixed"><parent link="{0}"/><child link="{1}"/></joint>'
    (tmp_path / "limb.urdf").write_text(LIMB.format(links=links, joints=joint.format(*"ab") + joint.format(*"bc")))
    disabled = "".join(f'<disable_collisions link1="{a}" link2="{b}" reason="Adjacent"/>' for a, b in ("ab", "bc"))
    group = '<group name="limb"><chain base_link="a" tip_link="c"/></group>'
    (tmp_path / "limb.srdf").write_text(f'<robot name="limb">{group}{disabled}</robot>')
    [found] = lint(tmp_path / "limb.urdf", select=["M110"])
    assert found.help == 'add <disable_collisions link1="a" link2="c" reason="Default"/>'


TWO = ROBOT.replace(
    "<ros2_control",
    """<link name="tip"/>
  <joint name="wrist" type="revolute">
    <parent link="hand"/><child link="tip"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>{mimic}
  </joint>
  <ros2_control""",
).replace(
    "</ros2_control>",
    """<joint name="wrist">{command}<state_interface name="position"/></joint>
  </ros2_control>""",
)
SRDF = """<robot name="arm">
  <group name="arm"><joint name="elbow"/></group>
</robot>
"""
MOVEIT = """moveit_simple_controller_manager:
  controller_names: [arm_controller]
  arm_controller:
    type: FollowJointTrajectory
    action_ns: follow_joint_trajectory
    joints: {}
"""


@pytest.mark.parametrize(
    ("mimic", "joints", "moved", "constraints", "code", "line"),
    [
        ("", "[elbow, wrist]", "[elbow, wrist]", "{wrist: {goal: 0.1}}", None, 0),
        ("", "[elbow]", "[elbow, wrist]", "{wrist: {goal: 0.1}}", "K976", 7),
        ("", "\n      - elbow", "[elbow, wrist]", "{elbow: {goal: 0.1}, wrist: {goal: 0.1}}", "K976", 8),
        ("", "[elbow]", "[elbow]", "{wrist: {goal: 0.1}}", "K976", 10),
        ("elbow", "[elbow]", "[elbow]", "{elbow: {goal: 0.1}}", None, 0),
        ("elbow", "[elbow, wrist]", "[elbow]", "{elbow: {goal: 0.1}}", "K965", 7),
    ],
    ids=["right", "left out", "left out after another", "too much", "mimic", "mimic listed"],
)
def test_a_list_of_joints_that_the_other_files_contradict_has_one_finding(
    tmp_path, mimic, joints, moved, constraints, code, line
):
    package = tmp_path / "arm_description"
    (package / "config").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST.format(depends=""))
    command = "" if mimic else '<command_interface name="position"/>'
    element = f'<mimic joint="{mimic}"/>' if mimic else ""
    (package / "arm.urdf").write_text(TWO.format(mimic=element, command=command))
    text = YAML.format(interface="position").replace("[elbow]", joints) + f"    constraints: {constraints}\n"
    (package / "config" / "controllers.yaml").write_text(text)
    (package / "config" / "arm.srdf").write_text(SRDF)
    (package / "config" / "moveit_controllers.yaml").write_text(MOVEIT.format(moved))
    found = [(one.code, one.line) for one in lint(package) if one.code in ("K965", "K976", "M112")]
    assert found == ([(code, line)] if code else [])


def test_the_texts_on_a_list_of_joints(tmp_path):
    package = tmp_path / "arm_description"
    (package / "config").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST.format(depends=""))
    (package / "config" / "arm.srdf").write_text(SRDF)
    (package / "config" / "moveit_controllers.yaml").write_text(MOVEIT.format("[elbow, wrist]"))
    text = YAML.format(interface="position")
    (package / "arm.urdf").write_text(TWO.format(mimic="", command='<command_interface name="position"/>'))
    (package / "config" / "controllers.yaml").write_text(text + "    constraints: {wrist: {goal: 0.1}}\n")
    [found] = lint(package, select=("K976", "M112"))
    assert found.message == "`joints` of `arm_controller` lacks `wrist`, which its other settings and MoveIt have"
    (package / "arm.urdf").write_text(TWO.format(mimic='<mimic joint="elbow"/>', command=""))
    (package / "config" / "controllers.yaml").write_text(text.replace("[elbow]", "[elbow, wrist]"))
    [found] = lint(package, select=("K965",))
    assert found.help == "remove `wrist`, which follows another joint"
