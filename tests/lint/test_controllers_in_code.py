"""Own nodes that send commands to controllers, and nodes that read a topic of others under a private name."""

from __future__ import annotations

import pytest

from tests.lint.test_build_files import MANIFEST, write
from urdfkit.lint import lint

ROBOT = """<robot name="cart">
  <link name="base"/>
  <link name="lift"/>
  <joint name="lift_joint" type="prismatic">
    <parent link="base"/><child link="lift"/><axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
  <link name="jaw"/>
  <joint name="jaw_joint" type="prismatic">
    <parent link="lift"/><child link="jaw"/><axis xyz="0 1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
"""
YAML = """controller_manager:
  ros__parameters:
    lift_controller:
      type: joint_trajectory_controller/JointTrajectoryController
    jaw_controller:
      type: position_controllers/GripperActionController
    brush_controller:
      type: velocity_controllers/JointGroupVelocityController
lift_controller:
  ros__parameters:
    joints: [lift_joint, jaw_joint]
    command_interfaces: [position]
    state_interfaces: [position]
jaw_controller:
  ros__parameters:
    joint: jaw_joint
brush_controller:
  ros__parameters:
    joints: [jaw_joint]
"""
PYTHON = """import rclpy
from control_msgs.action import GripperCommand
from rclpy.action import ActionClient
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint


class Drive(Node):
    def __init__(self):
        super().__init__("drive")
        self.brush = self.create_publisher(Float64MultiArray, "/brush_controller/commands", 1)
        self.lift = self.create_publisher(JointTrajectory, "lift_controller/joint_trajectory", 1)
        self.jaws = [ActionClient(self, GripperCommand, f"/{side}jaw_controller/gripper_cmd") for side in [""]]

    def move(self, height, width):
        message = JointTrajectory()
        message.joint_names = ["lift_joint", "jaw_joint"]
        point = JointTrajectoryPoint()
        point.positions = [height, width]
        message.points = [point]
        self.lift.publish(message)
"""
FILES = {
    "package.xml": MANIFEST,
    "urdf/cart.urdf": ROBOT,
    "config/controllers.yaml": YAML,
    "cart/drive.py": PYTHON,
}


def found(folder, code=("K980",), target=None):
    return [(one.file, one.line, one.message) for one in lint(folder, target=target) if one.code in code]


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("/commands", "/command", 12, "`brush_controller` has no topic or action `command`; did you mean `commands`?"),
        (
            "/joint_trajectory",
            "/commands",
            13,
            "`lift_controller` has no topic or action `commands`; use `follow_joint_trajectory` or `joint_trajectory`",
        ),
        (
            "/gripper_cmd",
            "/follow_joint_trajectory",
            14,
            "`jaw_controller` has no topic or action `follow_joint_trajectory`; did you mean `gripper_cmd`?",
        ),
        ("/brush_controller/commands", "/other_controller/command", 0, ""),
        ("/brush_controller/commands", "/brush_controller/transition_event", 0, ""),
    ],
)
def test_topics_of_controllers_in_code(tmp_path, monkeypatch, old, new, line, message):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, FILES)
    assert found(tmp_path) == []
    assert PYTHON.count(old) == 1
    write(tmp_path, {"cart/drive.py": PYTHON.replace(old, new)})
    assert found(tmp_path) == ([("cart/drive.py", line, f"controller {message}")] if line else [])


CPP = """#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
int main(int argc, char** argv) {
  ros::init(argc, argv, "watch");
  ros::NodeHandle global;
  ros::NodeHandle own("~");
  ros::Subscriber joints = global.subscribe("joint_states", 1, read);
  ros::Subscriber limits = own.subscribe("limits", 1, read);
}
"""
LAUNCH = '<launch>\n  <node name="watch" pkg="cart" type="watch"/>\n</launch>\n'
REMAPPED = (
    '<launch>\n  <node name="watch" pkg="cart" type="watch"><remap from="~joint_states" to="/joint_states"/></node>\n'
)


@pytest.mark.parametrize(
    ("old", "new", "launch", "expected"),
    [
        ("", "", LAUNCH, False),
        ('global.subscribe("joint_states"', 'own.subscribe("joint_states"', LAUNCH, True),
        ('global.subscribe("joint_states"', 'own.subscribe("/joint_states"', LAUNCH, False),
        ('global.subscribe("joint_states"', 'own.subscribe("joint_states"', f"{REMAPPED}</launch>\n", False),
    ],
)
def test_a_private_node_handle_does_not_read_global_topics(tmp_path, monkeypatch, old, new, launch, expected):
    monkeypatch.chdir(tmp_path)
    manifest = MANIFEST.replace("ament_cmake</buildtool", "catkin</buildtool")
    write(tmp_path, {"package.xml": manifest, "urdf/cart.urdf": ROBOT, "src/watch.cpp": CPP.replace(old, new, 1)})
    write(tmp_path, {"launch/watch.launch": launch})
    message = "no node publishes `joint_states` in the private namespace of this node; read it without `~`"
    assert found(tmp_path, target="gazebo-classic") == ([("src/watch.cpp", 7, message)] if expected else [])


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("[height, width]", "[height]", 20, "the length of `positions` is 1, but that of the joint names is 2"),
        ("[height, width]", "[*height, width]", 0, ""),
        ("[height, width]", "height", 0, ""),
        ("[height, width]", "[lift, jaw]", 0, ""),
        ("[height, width]", "[lift.height, other]", 0, ""),
        (
            "[height, width]",
            "[jaw_width, lift]",
            18,
            "joint `lift_joint` gets `jaw_width`, which is named after `jaw_joint`; check the order",
        ),
        ("[height, width]", "[height]\n        point.positions.append(width)", 0, ""),
        (
            '["lift_joint", "jaw_joint"]',
            'self.names\n        self.names = ["lift_joint"]',
            21,
            "the length of `positions` is 2, but that of the joint names is 1",
        ),
    ],
)
def test_values_of_joints_in_messages(tmp_path, monkeypatch, old, new, line, message):
    monkeypatch.chdir(tmp_path)
    assert PYTHON.count(old) == 1
    write(tmp_path, {**FILES, "cart/drive.py": PYTHON.replace(old, new)})
    assert found(tmp_path, ("K976",)) == ([("cart/drive.py", line, message)] if line else [])


@pytest.mark.parametrize(
    ("publisher", "data", "message"),
    [
        ("brush", "[width]", ""),
        ("brush", "[height, width]", "the length of `data` is 2; controller `brush_controller` needs 1"),
        ("brush", "[*height, width]", ""),
        ("brush", "values", ""),
        ("lift", "[height, width]", ""),
    ],
)
def test_values_of_commands_of_a_group(tmp_path, monkeypatch, publisher, data, message):
    monkeypatch.chdir(tmp_path)
    code = f"{PYTHON}        self.{publisher}.publish(Float64MultiArray(data={data}))\n"
    write(tmp_path, {**FILES, "cart/drive.py": code})
    assert found(tmp_path, ("K976",)) == ([("cart/drive.py", 23, message)] if message else [])


SERVER = """import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from cart_interfaces.action import Tip


class Tipper(Node):
    def __init__(self):
        super().__init__("tipper")
        self.server = ActionServer(self, Tip, "tip", self.execute)

    def execute(self, goal_handle):
        result = Tip.Result()
        if goal_handle.request.angle > 1:
            goal_handle.abort()
            return result
        goal_handle.succeed()
        result.success = True
        return result
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("        goal_handle.succeed()\n", "", True),
        ("        goal_handle.succeed()\n", "        self.finish(goal_handle)\n", False),
        ("        result.success = True\n        return result\n", "        raise ValueError\n", False),
        ("self.execute)", "self.other)", False),
    ],
)
def test_an_action_server_that_never_succeeds(tmp_path, monkeypatch, old, new, expected):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, {**FILES, "cart/tipper.py": SERVER})
    assert found(tmp_path) == []
    assert SERVER.count(old) == 1
    write(tmp_path, {"cart/tipper.py": SERVER.replace(old, new)})
    message = "`execute` does not call succeed() of its goal, so the goal is aborted"
    assert found(tmp_path) == ([("cart/tipper.py", 17, message)] if expected else [])
