"""Mistakes between an SRDF, the YAML files of MoveIt and the robot: each has one finding, at its line."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license>
  <export><build_type>ament_cmake</build_type></export></package>"""
JOINT = """<joint name="{name}" type="{type}"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="5" velocity="1"/>{more}</joint><link name="{child}"/>
"""
JOINTS = [
    *(("j1", "revolute", "base", "l1", ""), ("j2", "revolute", "l1", "l2", ""), ("j3", "revolute", "l2", "tip", "")),
    ("left_finger", "prismatic", "tip", "left", ""),
    ("right_finger", "prismatic", "tip", "right", '<mimic joint="left_finger" multiplier="-1"/>'),
    *(("left_wheel_joint", "continuous", "base", "w1", ""), ("right_wheel_joint", "continuous", "base", "w2", "")),
]
PARTS = ("name", "type", "parent", "child", "more")
ROBOT = "".join(JOINT.format(**dict(zip(PARTS, joint, strict=True))) for joint in JOINTS)
SRDF = """<robot name="arm">
  <group name="arm"><chain base_link="base" tip_link="tip"/></group>
  <group name="hand"><joint name="left_finger"/><joint name="right_finger"/></group>
  <group name="all"><group name="arm"/><group name="hand"/></group>
  <group_state name="home" group="arm">
    <joint name="j1" value="0"/><joint name="j2" value="0"/><joint name="j3" value="0"/>
  </group_state>
  <group_state name="open" group="hand">
    <joint name="left_finger" value="0.5"/>
    <joint name="right_finger" value="-0.5"/>
  </group_state>
  <end_effector name="tool" parent_link="tip" group="hand" parent_group="arm"/>
  <passive_joint name="left_wheel_joint"/>
  <passive_joint name="right_wheel_joint"/>
  <virtual_joint name="floor" type="planar" parent_frame="odom" child_link="base"/>
</robot>"""
CONTROLLERS = """controller_manager:
  ros__parameters:
    mover: {type: joint_trajectory_controller/JointTrajectoryController}
    gripper: {type: parallel_gripper_action_controller/GripperActionController}
mover:
  ros__parameters:
    joints: [j1, j2, j3]
    command_interfaces: [position]
    state_interfaces: [position]
gripper:
  ros__parameters: {joint: left_finger}
"""
MOVEIT = """moveit_simple_controller_manager:
  controller_names: [mover, gripper]
  mover:
    type: FollowJointTrajectory
    action_ns: follow_joint_trajectory
    joints: [j1, j2, j3]
  gripper:
    type: ParallelGripperCommand
    action_ns: gripper_cmd
    joints: [left_finger]
moveit_controller_manager: moveit_simple_controller_manager/MoveItSimpleControllerManager
"""
LIMIT = "  {}: {{has_acceleration_limits: true, max_acceleration: 2.0}}\n"
LIMITS = "joint_limits:\n" + "".join(map(LIMIT.format, ("j1", "j2", "j3")))
FIRST = "initial_positions:\n  j1: 0.0\n  j2: 0.5\n  j3: -1.0\n"
FILES = {
    "package.xml": MANIFEST,
    "arm.urdf": f'<robot name="arm"><link name="base"/>{ROBOT}</robot>',
    "config/arm.srdf": SRDF,
    "config/controllers.yaml": CONTROLLERS,
    "config/moveit_controllers.yaml": MOVEIT,
    "config/joint_limits.yaml": LIMITS,
    "config/initial_positions.yaml": FIRST,
    "config/kinematics.yaml": (
        "arm:\n  kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin\n  position_only_ik: true\n"
    ),
    "config/pilz_planning.yaml": (
        "planning_plugins: [pilz_industrial_motion_planner/CommandPlanner]\ndefault_planner_config: PTP\n"
    ),
    "config/sensors_3d.yaml": (
        "sensors: [eye]\neye:\n  sensor_plugin: occupancy_map_monitor/PointCloudOctomapUpdater\n"
        "  point_cloud_topic: points\n"
    ),
}
MISTAKES = [
    ("arm.srdf", 'group="hand" parent_group', 'group="all" parent_group', "M105", 12, "contains its parent group"),
    ("arm.srdf", 'value="-0.5"', 'value="0.5"', "M107", 10, "mimics `left_finger`, so its value is -0.5, not 0.5"),
    ("arm.srdf", '<group name="all">', '<group name="arm">', "M106", 4, "duplicate group `arm`"),
    (
        "arm.srdf",
        '  <passive_joint name="left_wheel_joint"/>\n',
        "",
        "M105",
        13,
        "joint `left_wheel_joint`, which is in",
    ),
    ("moveit_controllers.yaml", "j1, j2, j3]", "j1]", "M112", 6, "`joints` lacks `j2`, `j3` of controller `mover`"),
    ("moveit_controllers.yaml", "[mover, gripper]", "[gripper]", "M108", 2, "`mover` is not in `controller_names`"),
    ("moveit_controllers.yaml", "ParallelG", "G", "M112", 8, "has the action ParallelGripperCommand"),
    (
        "joint_limits.yaml",
        "j3: {has_acceleration_limits: true",
        "j3: {has_acceleration_limits: false",
        "M109",
        4,
        "is not",
    ),
    (
        "kinematics.yaml",
        "arm:",
        "all:",
        "M109",
        1,
        "not a chain: `left_finger` and `right_finger` are on different branches",
    ),
    (
        "kinematics.yaml",
        "  position_only_ik: true\n",
        "",
        "M109",
        2,
        "has 3 joints, too few for the orientation of a pose",
    ),
    ("arm.srdf", '"odom"', '"odomm"', "M105", 15, "unknown parent frame `odomm`"),
    ("arm.srdf", 'joint name="floor"', 'joint name="j1"', "M105", 15, "has the name of a joint of the robot"),
    ("arm.srdf", 'name="j2" value', 'name="j1" value', "M106", 6, "duplicate joint `j1` in `home`"),
    ("pilz_planning.yaml", "PTP", "LINE", "M109", 2, "did you mean `LIN`?"),
    ("sensors_3d.yaml", "PointC", "Pointc", "M109", 3, "did you mean `occupancy_map_monitor/PointCloudOctomapUpdater`"),
    ("initial_positions.yaml", "j2: 0.5", "j2: 1.5", "K971", 3, "`initial_positions` has 1.5 for joint `j2`, whose"),
    ("initial_positions.yaml", "j2: 0.5", "j2: 45", "K971", 3, "write radians, if the values are degrees"),
]
RIGHT = [
    ("controllers.yaml", "joints: [j1, j2, j3]", "joints: [j1, j2, j3]"),
    ("joint_limits.yaml", "true", "false"),
    ("arm.srdf", 'right_finger" value="-0.5"', 'right_finger" value="-0.49"'),
]


def findings(folder, name, old, new, count=-1):
    (folder / "config").mkdir()
    for file, text in FILES.items():
        is_changed = file.endswith(f"/{name}")
        assert not is_changed or old in text, old
        (folder / file).write_text(text.replace(old, new, count) if is_changed else text)
    found = lint(folder, target="ros2")
    return [one for one in found if one.code in ("M104", "M105", "M106", "M107", "M108", "M109", "M112", "K971")]


@pytest.mark.parametrize(("name", "old", "new"), RIGHT)
def test_correct_files_are_silent(tmp_path, name, old, new):
    assert findings(tmp_path, name, old, new) == []


@pytest.mark.parametrize(("name", "old", "new", "code", "line", "message"), MISTAKES)
def test_each_mistake_has_one_finding(tmp_path, name, old, new, code, line, message):
    [found] = findings(tmp_path, name, old, new, 1)
    assert (found.code, found.line) == (code, line)
    assert message in found.message


def test_partial_goals_may_be_allowed(tmp_path):
    allowed = "joints: [j1, j2, j3, j4]\n    allow_partial_joints_goal: true"
    assert findings(tmp_path, "controllers.yaml", "joints: [j1, j2, j3]", allowed) == []
