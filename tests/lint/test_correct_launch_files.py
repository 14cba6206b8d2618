"""Launch files that are correct and close to a mistake: actions, values, conditions, remappings and bridges."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import package, write
from urdfkit.lint import lint

HEAD = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


"""
NODE = 'Node(package="joy", executable="joy_node")'
OPAQUE = """{}


def generate_launch_description():
    actions = []
    return LaunchDescription([OpaqueFunction(function=start, args=[actions]), *actions])
"""
FUNCTIONS = [
    f"def start(context, actions):\n    yield {NODE}",
    f"def start(context, actions):\n    actions.append({NODE})",
    f"def start(context, actions):\n    node = {NODE}\n    actions.extend([node])",
    f"def start(context, actions):\n    node = {NODE}\n    node.visit(context)",
    f"def start(context, actions):\n    {NODE}.execute(context)",
    f"def start(context, actions):\n    for action in [{NODE}]:\n        action.visit(context)",
    f"TABLE = {{}}\n\n\ndef start(context, actions):\n    TABLE['joy'] = {NODE}",
]
DROPPED = [
    f"def start(context, actions):\n    {NODE}",
    f"def start(context, actions):\n    node = {NODE}\n    nodes = [node]",
    f"def start(context, actions):\n    node = {NODE}\n    [node]",
]


@pytest.mark.parametrize(("function", "count"), [*((each, 0) for each in FUNCTIONS), *((each, 1) for each in DROPPED)])
def test_actions_that_a_function_passes_on_are_not_dropped(tmp_path, function, count):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "joy")
    write(cart / "launch/cart.launch.py", HEAD + OPAQUE.format(function))
    assert len([each for each in lint(cart) if each.code == "L105"]) == count


@pytest.mark.parametrize(
    ("kind", "value", "count"),
    [
        *(("double", value, 0) for value in ("NaN", "Infinity", "-Inf", "+nan", "1e3", " 2. ")),
        *(("int", value, 0) for value in (" 3 ", "-4")),
        *(("Boolean", value, 0) for value in ("1", "False")),
        *(("int", "0x1F", 1), ("double", "infinite", 1), ("boolean", "no", 1)),
    ],
)
def test_roslaunch_converts_values_as_python_does(tmp_path, kind, value, count):
    cart = package(tmp_path / "cart", "catkin", "joy")
    parameter = f'<param name="a" type="{kind}" value="{value}"/>'
    write(
        cart / "launch/cart.launch", f'<launch><node pkg="joy" type="joy_node" name="joy">{parameter}</node></launch>'
    )
    assert len([each for each in lint(cart) if each.code == "L110"]) == count


LIST = "def generate_launch_description():\n    return LaunchDescription([{}])\n"
SLIDERS = """DeclareLaunchArgument("{0}"),
        Node(package="joint_state_publisher", executable="joint_state_publisher", {1}
             condition=IfCondition(LaunchConfiguration("{0}"))),
        Node(package="joint_state_publisher_gui", executable="joint_state_publisher_gui", {2}
             condition=IfCondition(LaunchConfiguration("{0}")))"""
EKF = """Node(package="robot_localization", executable="ekf_node", parameters=[{"odom0": "wheel/odometry"}],
             remappings=[("wheel/odometry", "base/odom")])"""
AMCL = """Node(package="nav2_amcl", executable="amcl", parameters=[{"scan_topic": "base_scan"}],
             remappings=[("base_scan", "scan")])"""


@pytest.mark.parametrize(
    ("actions", "count"),
    [
        (SLIDERS.format("gui", "", ""), 1),
        (SLIDERS.format("use_jsp", "", ""), 0),
        (SLIDERS.format("gui", 'namespace="left",', ""), 0),
        (SLIDERS.format("gui", "", 'remappings=[("joint_states", "gui_joint_states")],'), 0),
        (EKF, 0),
        (EKF.replace('"odom0"', '"odom0_config"').replace('"wheel/odometry"}', '"wheel"}'), 1),
        (AMCL, 0),
        (AMCL.replace('"scan_topic": "base_scan"', '"scan_topic": "scan"'), 1),
    ],
)
def test_separate_publishers_and_topics_of_parameters_are_correct(tmp_path, actions, count):
    needed = ("joint_state_publisher", "joint_state_publisher_gui", "robot_localization", "nav2_amcl", "launch_ros")
    cart = package(tmp_path / "cart", "ament_cmake", *needed)
    write(cart / "launch/cart.launch.py", HEAD + LIST.format(actions))
    assert len([each for each in lint(cart) if each.code in ("L127", "K980")]) == count


BRIDGE = 'Node(package="ros_gz_bridge", executable="parameter_bridge", {}),\n        '
SCANS = BRIDGE.format(
    'arguments=["/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan", "/imu@sensor_msgs/msg/Imu[gz.msgs.IMU"]'
)
CLOCK = BRIDGE.format('arguments=["/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock"]')
COMPUTED = BRIDGE.format(
    'parameters=[{"config_file": PathJoinSubstitution([FindPackageShare("cart"), "config",'
    ' [LaunchConfiguration("robot"), "_bridge.yaml"]])}]'
)
STATES = (
    'Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[{"use_sim_time": True}])'
)
GAZEBO = (
    'IncludeLaunchDescription(PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])),'
)
SPAWNER = 'Node(package="ros_gz_sim", executable="create", arguments=["-topic", "robot_description"]),'


@pytest.mark.parametrize(
    ("robot", "world", "count"),
    [
        (GAZEBO + SCANS + STATES, "", 1),
        (GAZEBO + SCANS + 'DeclareLaunchArgument("robot"), ' + COMPUTED + STATES, "", 0),
        (SPAWNER + SCANS + STATES, "", 0),
        (GAZEBO + SCANS + STATES, CLOCK, 0),
    ],
)
def test_a_clock_that_another_bridge_can_have_is_not_missing(tmp_path, robot, world, count):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "ros_gz_sim", "ros_gz_bridge")
    write(cart / "launch/robot.launch.py", HEAD + LIST.format(robot))
    write(cart / "launch/world.launch.py", HEAD + LIST.format(world))
    assert len([each for each in lint(cart) if each.code == "K969" and "`clock`" in each.text]) == count


def test_the_manager_of_a_nodelet_with_a_computed_class_is_the_last_word(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "nodelet")
    node = '<node pkg="nodelet" type="nodelet" name="{}" args="{}"/>'
    text = '<launch><arg name="class" default="a/b"/>' + node.format("mgr", "manager")
    for words, count in (("load $(arg class) mgr", 0), ("load a/b mgrr", 1)):
        write(cart / "launch/cart.launch", text + node.format("first", words) + "</launch>")
        assert len([each for each in lint(cart) if each.code == "L117"]) == count


CHILD = 'Node(package="joy", executable="joy_node", namespace=LaunchConfiguration("prefix"))'
PARENT = 'DeclareLaunchArgument("prefix"), '
INCLUDE = 'IncludeLaunchDescription(PathJoinSubstitution([FindPackageShare("cart"), "launch", "child.launch.py"]))'


@pytest.mark.parametrize(
    ("child", "parent", "count"),
    [
        (CHILD, "", 0),  # a launch file of another package can include it
        (CHILD, PARENT + INCLUDE, 0),
        (CHILD, PARENT, 1),
        ('DeclareLaunchArgument("name"), ' + CHILD, "", 1),
    ],
)
def test_a_launch_file_without_arguments_inherits_those_of_its_parent(tmp_path, child, parent, count):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "joy")
    write(cart / "launch/child.launch.py", HEAD + LIST.format(child))
    write(cart / "launch/parent.launch.py", HEAD + LIST.format(parent))
    assert len([each for each in lint(cart) if each.code == "L101"]) == count
