"""Values in YAML that contradict the robot, the SRDF, a limit or the release of Gazebo: each has one finding."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

JOINTS = ("j1", "j2", "j3", "j4", "j5")


def joint(number):
    name, parent = JOINTS[number], f"l{number}"
    return f"""<link name="l{number + 1}"/><joint name="{name}" type="revolute"><parent link="{parent}"/>
    <child link="l{number + 1}"/><axis xyz="0 1 0"/><limit lower="-2" upper="1" effort="5" velocity="1"/></joint>"""


ROBOT = f"""<robot name="arm"><link name="l0"/>{"".join(map(joint, range(5)))}
  <gazebo><plugin filename="gz-sim-joint-state-publisher-system" name="gz::sim::systems::JointStatePublisher"/></gazebo>
</robot>"""
MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license>
  <exec_depend>nav2_controller</exec_depend><export><build_type>ament_python</build_type></export></package>"""
SRDF = """<robot name="arm">
  <group name="arm"><chain base_link="l0" tip_link="l5"/></group>
  <group_state name="home" group="arm"><joint name="j1" value="0"/></group_state>
</robot>"""
NODE = """import rclpy
from rclpy.node import Node

class Mover(Node):
    def __init__(self):
        super().__init__("mover")
"""
LAUNCH = """<launch>
  <node pkg="arm" exec="mover" name="mover"><param from="$(find-pkg-share arm)/mover.yaml"/></node>
</launch>
"""
MOVER = """mover:
  ros__parameters:
    joints: [j1, j2, j3, j4, j5]
    low: [0.0, -1.5, 0.5, -1.5, 0.5]
    high: [0.1, -0.5, 0.5, -0.5, 0.5]
    max_torques: [50.0, 50.0, 50.0, 50.0, 50.0]
"""
FOLDER = """folder:
  ros__parameters:
    joints: [j1, j2, j3]
    folded: [0.0, -1.5, 0.5]
    unfolded: [0.1, -0.5, 0.5]
    ratio_between: [0.2, 0.4]
"""
DRIVE = """controller_manager:
  ros__parameters:
    drive: {type: diff_drive_controller/DiffDriveController}
drive:
  ros__parameters:
    linear.x.has_velocity_limits: true
    linear.x.max_velocity: 0.5
    linear.x.min_velocity: -0.2
"""
NAVIGATION = """controller_server:
  ros__parameters:
    FollowPath:
      desired_linear_vel: 0.3
velocity_smoother:
  ros__parameters:
    max_velocity: [0.3, 0.0, 1.0]
    min_velocity: [-0.3, 0.0, -1.0]
"""
BRIDGE = """- ros_topic_name: joint_states
  gz_topic_name: joint_states
  ros_type_name: sensor_msgs/msg/JointState
  gz_type_name: gz.msgs.Model
  direction: GZ_TO_ROS
"""
FAKE = "initial:\n  - group: arm\n    pose: home\n"
FILES = {"mover.yaml": MOVER, "folder.yaml": FOLDER, "drive.yaml": DRIVE, "nav2.yaml": NAVIGATION}
FILES |= {"bridge.yaml": BRIDGE, "fake_controllers.yaml": FAKE}

MISTAKES = [
    ("mover.yaml", "low: [0.0, ", "low: [", "K971", 4, "`low` has 4 values for 5 joints"),
    ("mover.yaml", "high: [0.1, -0.5", "high: [0.1, -2.5", "K971", 5, "`high` has -2.5 for joint `j2`"),
    ("folder.yaml", " folded: [0.0, ", " folded: [", "K971", 4, "`folded` has 2 values for 3 joints"),
    ("mover.yaml", "mover:", "movers:", "L117", 1, "no node is called `movers`; did you mean `mover`?"),
    ("mover.yaml", "mover:", "arm_moves:", "L117", 1, "no node is called `arm_moves`; did you mean `mover`?"),
    ("drive.yaml", "min_velocity: -0.2", "min_velocity: 0.2", "K971", 8, "the robot cannot stop"),
    ("nav2.yaml", "_vel: 0.3", "_vel: 3.0", "K982", 4, "`max_velocity` of velocity_smoother is 0.3 m/s"),
    (
        "bridge.yaml",
        "gz.msgs",
        "ignition.msgs",
        "K969",
        4,
        "is a type of Gazebo Fortress; did you mean `gz.msgs.Model`?",
    ),
    ("fake_controllers.yaml", "home", "ready", "M108", 3, "the SRDF has no state `ready` of group `arm`"),
]
RIGHT = [
    ("mover.yaml", "low: [0.0, ", "steps: [1.0, 2.0]\n    low: [0.0, "),
    ("mover.yaml", "high: [0.1, -0.5, 0.5, -0.5, 0.5]", "masses: [9.0, 8.0, 7.0, 6.0, 5.0]"),
    ("nav2.yaml", "_vel: 0.3", "_vel: 0.5"),
    ("drive.yaml", "min_velocity: -0.2", "min_velocity: 0.0"),
]


def findings(folder, name="", old="", new=""):
    texts = {"arm.urdf": ROBOT, "package.xml": MANIFEST, "arm.srdf": SRDF, "mover.py": NODE, "arm.launch.xml": LAUNCH}
    for file, text in (texts | FILES).items():
        assert file != name or old in text
        (folder / file).write_text(text.replace(old, new, 1) if file == name else text)
    return [one for one in lint(folder, target="ros2") if one.file.endswith((".yaml", ".xml"))]


@pytest.mark.parametrize(("name", "old", "new", "code", "line", "message"), MISTAKES)
def test_a_wrong_value_has_one_more_finding(tmp_path, name, old, new, code, line, message):
    (tmp_path / "right").mkdir()
    (tmp_path / "wrong").mkdir()
    before = {(one.code, one.message) for one in findings(tmp_path / "right")}
    [found] = [one for one in findings(tmp_path / "wrong", name, old, new) if (one.code, one.message) not in before]
    assert (found.code, found.line) == (code, line)
    assert message in found.message


@pytest.mark.parametrize(("name", "old", "new"), RIGHT)
def test_right_values_have_no_finding(tmp_path, name, old, new):
    (tmp_path / "right").mkdir()
    (tmp_path / "other").mkdir()
    before = [one.code for one in findings(tmp_path / "right")]
    assert [one.code for one in findings(tmp_path / "other", name, old, new)] == before
    assert "K971" not in before


def test_a_second_node_in_the_code_may_have_the_section(tmp_path):
    for file, text in {"arm.urdf": ROBOT, "package.xml": MANIFEST, "arm.launch.xml": LAUNCH}.items():
        (tmp_path / file).write_text(text)
    (tmp_path / "mover.py").write_text(f"{NODE}\nhelper = Node('arm_moves')\n")
    (tmp_path / "mover.yaml").write_text(MOVER.replace("mover:", "arm_moves:"))
    assert "L117" not in [one.code for one in lint(tmp_path, target="ros2")]


@pytest.mark.parametrize("number", [".nan", ".inf", "rad(1.0)", "$(arg speed)"])
def test_numbers_of_yaml_and_of_launch_files_are_read(tmp_path, number):
    limits = f"""default_velocity_scaling_factor: {number}
joint_limits:
  j1: {{has_velocity_limits: true, max_velocity: {number}}}
"""
    (tmp_path / "arm.urdf").write_text(ROBOT)
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "arm.srdf").write_text(SRDF)
    (tmp_path / "joint_limits.yaml").write_text(limits)
    assert [one for one in lint(tmp_path, target="ros2") if one.file.endswith("limits.yaml")] == []
