"""Parameters of nodes that launch files and YAML files set, in a package with its own node, and correct ones next."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3">
  <name>cart</name>
  <version>1.0.0</version>
  <description>A cart.</description>
  <maintainer email="cart@example.com">The maintainers</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <exec_depend>controller_manager</exec_depend>
  <exec_depend>diff_drive_controller</exec_depend>
  <exec_depend>imu_filter_madgwick</exec_depend>
  <exec_depend>joint_trajectory_controller</exec_depend>
  <exec_depend>launch</exec_depend>
  <exec_depend>launch_ros</exec_depend>
  <exec_depend>nav2_bringup</exec_depend>
  <exec_depend>robot_localization</exec_depend>
  <exec_depend>robot_state_publisher</exec_depend>
  <exec_depend>ros_gz_sim</exec_depend>
  <exec_depend>teleop_twist_joy</exec_depend>
  <exec_depend>twist_mux</exec_depend>
  <exec_depend>xacro</exec_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
BUILD = """cmake_minimum_required(VERSION 3.8)
project(cart)
find_package(ament_cmake REQUIRED)
install(PROGRAMS scripts/lifter.py DESTINATION lib/${PROJECT_NAME})
install(DIRECTORY config launch urdf worlds DESTINATION share/${PROJECT_NAME})
ament_package()
"""
ROBOT = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="base_link"/>
</robot>
"""
NODE = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node


class Lifter(Node):
    def __init__(self):
        super().__init__('lifter')
        self.declare_parameter('height', 0.1)
        self.declare_parameter('count', 3)
        self.declare_parameter('points', [0.1, 0.2])


rclpy.init()
rclpy.spin(Lifter())
"""
PYTHON = """import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = get_package_share_directory('cart')
    params = os.path.join(share, 'config', 'navigation.yaml')
    model = os.path.join(share, 'urdf', 'cart.urdf.xacro')
    world = PathJoinSubstitution([FindPackageShare('cart'), 'worlds', 'hall.sdf'])
    description = ParameterValue(Command(['xacro ', model]), value_type=str)
    return LaunchDescription([
        DeclareLaunchArgument('gui', default_value='true'),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(
                PathJoinSubstitution([FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py'])
            ),
            launch_arguments={'gz_args': ['-r -s ', world]}.items(),
        ),
        Node(
            package='robot_state_publisher', executable='robot_state_publisher',
            parameters=[{'robot_description': description}],
        ),
        Node(package='cart', executable='lifter.py', parameters=[{'count': 2, 'points': [0.3, 0.4]}]),
        Node(package='nav2_planner', executable='planner_server', parameters=[params]),
        Node(package='nav2_map_server', executable='map_server', name='map_server', parameters=[params]),
        Node(
            package='nav2_lifecycle_manager', executable='lifecycle_manager', name='manager',
            parameters=[{'autostart': True, 'node_names': ['planner_server', 'map_server']}],
        ),
    ])
"""
XML = """<launch>
  <arg name="gui" default="true"/>
  <node pkg="cart" exec="lifter.py" name="lifter" if="$(var gui)">
    <param name="height" value="0.5"/>
  </node>
  <node pkg="imu_filter_madgwick" exec="imu_filter_madgwick_node" name="imu_filter"/>
</launch>
"""
YAML = """launch:
  - node:
      pkg: twist_mux
      exec: twist_mux
      name: twist_mux
      param:
        - from: $(find-pkg-share cart)/config/mux.yaml
      remap:
        - from: cmd_vel_out
          to: drive/cmd_vel_unstamped
"""
NAVIGATION = """planner_server:
  ros__parameters:
    expected_planner_frequency: 5.0
    planner_plugins: [GridBased]
    GridBased:
      plugin: nav2_navfn_planner::NavfnPlanner
map_server:
  ros__parameters:
    yaml_filename: hall.yaml
controller_server:
  ros__parameters:
    progress_checker_plugin: progress
    controller_plugins: [FollowPath]
    progress:
      plugin: nav2_controller::SimpleProgressChecker
    FollowPath:
      plugin: nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController
      use_rotate_to_heading: true
      allow_reversing: false
      rotate_to_heading_min_angle: 0.8
velocity_smoother:
  ros__parameters:
    smoothing_frequency: 20.0
    max_velocity: [1.0, 0.0, 1.0]
    deadband_velocity: [0.0, 0.0, 0.0]
    velocity_timeout: 1.0
bt_navigator:
  ros__parameters:
    plugin_lib_names: [nav2_follow_path_action_bt_node, nav2_path_expiring_timer_condition]
local_costmap:
  local_costmap:
    ros__parameters:
      rolling_window: true
      width: 4
      height: 4
      footprint: "[[0.5, 0.3], [0.5, -0.3], [-0.5, -0.3], [-0.5, 0.3]]"
mppi_server:
  ros__parameters:
    yaw: 0.0
amcl:
  ros__parameters:
    set_initial_pose: true
    initial_pose: {x: 0.0, y: 0.0, z: 0.0, yaw: 1.5}
"""
MUX = """twist_mux:
  ros__parameters:
    topics:
      navigation: {topic: nav_vel, timeout: 0.5, priority: 10}
      joystick: {topic: joy_vel, timeout: 0.5, priority: 100}
    locks:
      pause: {topic: pause, timeout: 0.0, priority: 50}
"""
CONTROLLERS = """controller_manager:
  ros__parameters:
    update_rate: 100
    drive:
      type: diff_drive_controller/DiffDriveController
drive:
  ros__parameters:
    left_wheel_names: [front_left, rear_left]
    right_wheel_names: [front_right, rear_right]
    wheels_per_side: 2
    wheel_separation: 0.5
    wheel_radius: 0.1
    use_stamped_vel: false
    open_loop: false
    linear.x.has_acceleration_limits: true
    linear.x.max_acceleration: 1.0
    linear.x.min_acceleration: -1.0
"""
FILTER = """ekf_filter_node:
  ros__parameters:
    map_frame: map
    odom_frame: odom
    base_link_frame: base_link
    world_frame: odom
    odom0: drive/odom
    odom0_config: [true, true, false,
                   false, false, true,
                   true, false, false,
                   false, false, true,
                   false, false, false]
    odom0_differential: true
    odom0_relative: false
navsat_transform:
  ros__parameters:
    zero_altitude: true
"""
TELEOP = """teleop_twist_joy_node:
  ros__parameters:
    axis_linear: {x: 1}
    axis_angular: {yaw: 0}
    scale_linear: {x: 0.5}
    scale_linear_turbo: {x: 1.0}
    enable_button: 4
"""
FILES = {
    "package.xml": MANIFEST,
    "CMakeLists.txt": BUILD,
    "urdf/cart.urdf.xacro": ROBOT,
    "scripts/lifter.py": NODE,
    "launch/cart.launch.py": PYTHON,
    "launch/lift.launch.xml": XML,
    "launch/mux.launch.yaml": YAML,
    "config/navigation.yaml": NAVIGATION,
    "config/mux.yaml": MUX,
    "config/controllers.yaml": CONTROLLERS,
    "config/filter.yaml": FILTER,
    "config/teleop.yaml": TELEOP,
    "worlds/hall.sdf": '<sdf version="1.9"><world name="hall"/></sdf>\n',
}
MODEL = "plugin: nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController"
UNDECLARED = "the code of the node does not declare the parameter `counts`"
MISTAKES = [
    ("launch/cart.launch.py", ", value_type=str)", ")", "L106", "add `value_type=str`"),
    ("launch/cart.launch.py", "value_type=str", "value_type=int", "L106", "write `str`"),
    ("launch/cart.launch.py", "Command(['xacro ', model])", "Command('xacro', model)", "L106", "one argument"),
    ("launch/cart.launch.py", "(Command(['xacro ', model]), value", "(model, value", "L106", "is the path of"),
    ("launch/cart.launch.py", "default_value='true'", "'true'", "L106", "write `default_value=`"),
    ("launch/cart.launch.py", "'cart'), 'worlds'", "'cart'), '/worlds'", "L106", "starts with a slash"),
    ("launch/cart.launch.py", "'-r -s '", "'-s '", "L126", "add `-r`"),
    (
        "launch/cart.launch.py",
        "executable='map_server', name='map_server'",
        "executable='map_server', name='halls'",
        "L117",
        "node `halls` has no section in navigation.yaml, which has `map_server`",
    ),
    ("launch/cart.launch.py", "'autostart': True", "'autostart': False", "L126", "`autostart` is false"),
    ("launch/cart.launch.py", "'count': 2", "'count': 2.5", "K974", "declares an integer"),
    ("launch/cart.launch.py", "[0.3, 0.4]", "[3, 4]", "K974", "list of numbers with decimal points"),
    (
        "launch/cart.launch.py",
        "'count': 2",
        "'counts': 2",
        "L104",
        "the code of the node does not declare the parameter `counts`",
    ),
    ("launch/cart.launch.py", "'planner_server', parameters=[params]", "'planner_server'", "L117", "does not load"),
    ("launch/lift.launch.xml", 'value="0.5"', 'value="5"', "K974", "write 5.0"),
    ("launch/lift.launch.xml", '"height"', '"heigth_of_lift"', "L104", "did you mean `height`?"),
    ("launch/lift.launch.xml", "$(var gui)", "$(var not gui)", "L101", "`not` is not declared"),
    (
        "launch/lift.launch.xml",
        "imu_filter_madgwick_node",
        "imu_filter_node",
        "L103",
        "no executable `imu_filter_node`",
    ),
    ("launch/mux.launch.yaml", "- from: cmd", "  from: cmd", "L109", "`remap` is not a list"),
    ("config/navigation.yaml", "yaml_filename: hall.yaml", 'yaml_filename: ""', "L126", "`yaml_filename`"),
    ("config/navigation.yaml", "plugin: progress", "plugin: checker", "K971", "did you mean `progress`?"),
    ("config/navigation.yaml", "reversing: false", "reversing: true", "K982", "never reverses"),
    ("config/navigation.yaml", "min_angle: 0.8", "min_angle: 45.0", "K981", "check the unit"),
    ("config/navigation.yaml", "yaw: 1.5", "yaw: 90.0", "K981", "degrees"),
    ("config/navigation.yaml", "[0.0, 0.0, 0.0]", "[1.0, 0.0, 0.0]", "K971", "never moves"),
    ("config/navigation.yaml", "timeout: 1.0", "timeout: 0.01", "K971", "shorter than the period"),
    ("config/navigation.yaml", "action_bt_node", "action_node", "K971", "nav2_follow_path_action_bt_node"),
    ("config/navigation.yaml", "width: 4", "width: 1", "K982", "the robot extends"),
    (
        "config/navigation.yaml",
        MODEL,
        "plugin: nav2_mppi_controller::MPPIController\n      motion_model: Omnidirectional",
        "K971",
        "did you mean `Omni`?",
    ),
    ("config/mux.yaml", "joy_vel, timeout: 0.5", "joy_vel, timeout: 0.0", "K971", "forever"),
    ("config/mux.yaml", "priority: 50", "priority: 5", "K971", "no input has a lower priority"),
    ("config/controllers.yaml", "[front_left, rear_left]", "[front_left]", "K971", "has 1 wheels"),
    ("config/controllers.yaml", "per_side: 2", "per_side: 4", "K971", "`left_wheel_names` has 2"),
    ("config/controllers.yaml", "open_loop: false", 'open_loop: "no"', "K971", "write false"),
    ("config/controllers.yaml", "min_acceleration: -1.0", "min_acceleration: 1.0", "K971", "slow down"),
    ("config/filter.yaml", "relative: false", "relative: true", "K971", "has no effect"),
    ("config/filter.yaml", "zero_altitude: true", "zero_altitude: 1", "K971", "neither true nor false"),
    ("config/teleop.yaml", "turbo: {x: 1.0}", "turbo: {x: 0.2}", "K971", "less than `scale_linear.x`"),
]
RIGHT = [
    ("launch/cart.launch.py", "'-r -s '", "'-s -r -v4 '"),
    ("launch/cart.launch.py", "'cart'), 'worlds'", "'cart'), 'worlds/'"),
    ("launch/lift.launch.xml", "$(var gui)", "$(not $(var gui))"),
    ("launch/lift.launch.xml", "$(var gui)", "$(var gui true)"),
    ("config/mux.yaml", "nav_vel, timeout: 0.5", "nav_vel, timeout: 0.0"),
    ("config/navigation.yaml", "yaw: 1.5", "yaw: -3.1"),
    ("config/controllers.yaml", "open_loop: false", "open_loop: true"),
    ("scripts/lifter.py", "'count', 3)", "'count', 3, ParameterDescriptor(dynamic_typing=True))"),
]


def findings(folder: Path, name: str = "", old: str = "", new: str = "") -> set[tuple[str, str, str]]:
    for file, text in FILES.items():
        assert file != name or old in text
        path = folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.replace(old, new, 1) if file == name else text)
    return {(one.code, Path(one.file).name, one.message) for one in lint(folder)}


DRIVEN = """<robot name="cart">
  <link name="base_link"/>
  <link name="lift"/>
  <link name="wheel"/>
  <joint name="lift_joint" type="prismatic">
    <parent link="base_link"/>
    <child link="lift"/>
    <limit lower="0" upper="1" effort="9" velocity="1"/>
  </joint>
  <joint name="wheel_joint" type="continuous">
    <parent link="base_link"/>
    <child link="wheel"/>
  </joint>
  <ros2_control name="cart" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="lift_joint"><command_interface name="position"/><state_interface name="position"/></joint>
    <joint name="wheel_joint"><command_interface name="velocity"/><state_interface name="velocity"/></joint>
  </ros2_control>
  <gazebo>
    <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
      <parameters>config/controllers.yaml</parameters>
    </plugin>
  </gazebo>
</robot>
"""
TWO = """controller_manager:
  ros__parameters:
    update_rate: {rate}
    lift:
      type: forward_command_controller/ForwardCommandController
    wheel:
      type: forward_command_controller/ForwardCommandController
lift:
  ros__parameters:
    joints: [lift_joint]
    interface_name: position
wheel:
  ros__parameters:
    joints: [wheel_joint]
    interface_name: velocity
"""
SPAWNERS = '<launch><node pkg="controller_manager" exec="spawner" args="{}"/></launch>\n'
UNSPAWNED = "no launch file spawns controller `wheel`, unlike the other controllers of its file"
MISSPELT = "unknown controller `wheels`; did you mean `wheel`?"
TOO_FAST = "`update_rate` is 2000 Hz, but the physics of Gazebo has 1000 steps per second"
OCTOMAP = "no other file names the frame `mapp` of the octomap"


@pytest.mark.parametrize(
    ("rate", "names", "frame", "message"),
    [
        (100, "lift wheel", "base_link", ""),
        (100, "lift", "base_link", UNSPAWNED),
        (100, "lift wheels", "base_link", MISSPELT),
        (2000, "lift wheel", "base_link", TOO_FAST),
        (100, "lift wheel", "mapp", OCTOMAP),
    ],
)
def test_controllers_and_the_octomap_of_a_robot(tmp_path, rate, names, frame, message):
    (tmp_path / "config").mkdir()
    (tmp_path / "launch").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "cart.urdf").write_text(DRIVEN)
    (tmp_path / "config/controllers.yaml").write_text(TWO.format(rate=rate))
    (tmp_path / "config/octomap.yaml").write_text(f"octomap_frame: {frame}\noctomap_resolution: 0.05\n")
    (tmp_path / "launch/cart.launch.xml").write_text(SPAWNERS.format(names))
    found = {one.message for one in lint(tmp_path)} & {UNSPAWNED, MISSPELT, TOO_FAST, OCTOMAP}
    assert found == ({message} if message else set())


@pytest.mark.parametrize(("name", "is_reported"), [("-z 0.1", True), ("-entity cart", False)])
def test_the_spawner_of_gazebo_classic_needs_a_name(tmp_path, name, is_reported):
    (tmp_path / "launch").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "cart.urdf").write_text(DRIVEN)
    node = f'<node pkg="gazebo_ros" exec="spawn_entity.py" args="-topic robot_description {name}"/>'
    (tmp_path / "launch/cart.launch.xml").write_text(f"<launch>{node}</launch>\n")
    found = [one.message for one in lint(tmp_path) if one.code == "K968"]
    assert found == (["`spawn_entity.py` needs the name of the model, `-entity`"] if is_reported else [])


@pytest.fixture(scope="module")
def usual(tmp_path_factory: pytest.TempPathFactory) -> set[tuple[str, str, str]]:
    return findings(tmp_path_factory.mktemp("usual"))


@pytest.mark.parametrize(("name", "old", "new", "code", "message"), MISTAKES)
def test_each_mistake_has_one_finding(tmp_path, usual, name, old, new, code, message):
    [(found, file, text)] = findings(tmp_path, name, old, new) - usual
    assert (found, message in text) == (code, True), (found, text)
    assert file == Path(name).name or code == "L126"


@pytest.mark.parametrize(("name", "old", "new"), RIGHT)
def test_correct_values_have_no_finding(tmp_path, usual, name, old, new):
    assert findings(tmp_path, name, old, new) - usual == set()


def test_the_package_itself_has_no_finding_of_these_rules(usual):
    codes = {code for _, _, _, code, _ in MISTAKES}
    assert [each for each in usual if each[0] in codes - {"K971"}] == []
