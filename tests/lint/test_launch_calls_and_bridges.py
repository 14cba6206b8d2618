"""Nodelets, parameter types, handlers in a circle, commands of ros2 control, and bridges that a loop composes."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write
from urdfkit.lint import lint

NODELETS = """<launch>
  <node pkg="nodelet" type="nodelet" name="manager" args="manager"/>
  <node pkg="nodelet" type="nodelet" name="cloud" args="load depth_image_proc/point_cloud_xyz manager"/>
  <param name="rate" type="int" value="20"/>
  <param name="gain" type="double" value="1.5e-1"/>
  <param name="verbose" type="bool" value="False"/>
</launch>
"""


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("cloud_xyz ", "cloud_xyzz ", 3, "package `depth_image_proc` has no nodelet `point_cloud_xyzz`"),
        ('"load depth_image_proc/point_cloud_xyz manager"', '"load"', 3, "`load` needs the class of the nodelet"),
        ('"nodelet" name="cloud"', '"nodelets" name="cloud"', 3, "package `nodelet` has no executable `nodelets`"),
        ('value="20"', 'value="20.0"', 4, "`20.0` is not a value of type `int`, so roslaunch stops"),
        ('value="1.5e-1"', 'value="1.5 m"', 5, "`1.5 m` is not a value of type `double`, so roslaunch stops"),
        ('value="False"', 'value="no"', 6, "`no` is not a value of type `bool`, so roslaunch stops"),
    ],
)
def test_a_wrong_nodelet_or_parameter_is_reported(tmp_path, old, new, line, message):
    cart = package(tmp_path / "cart", "catkin", "nodelet", "depth_image_proc")
    for text, expected in ((NODELETS.replace(old, new), [(line, message)]), (NODELETS, [])):
        write(cart / "launch/cart.launch", text)
        assert [(at, words.partition(";")[0]) for _, at, words in found(cart, "L103", "L110")] == expected


def test_an_executable_of_another_package_is_reported(tmp_path):
    cart = package(tmp_path / "cart", "ament_cmake", "nav2_map_server", "nav2_amcl")
    message = "package `nav2_map_server` has no executable `amcl`; did you mean `nav2_amcl`?"
    for name, expected in (("nav2_map_server", [("cart.launch.xml", 2, message)]), ("nav2_amcl", [])):
        write(cart / "launch/cart.launch.xml", f'<launch>\n  <node pkg="{name}" exec="amcl"/>\n</launch>\n')
        assert found(cart, "L103") == expected


CONTROL = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node


def load(name):
    return ExecuteProcess(cmd=["ros2", "control", "load_controller", "--set-state", "active", name])


def generate_launch_description():
    spawn = Node(package="ros_gz_sim", executable="create", arguments=["-topic", "robot_description"])
    states = load("joint_state_broadcaster")
    drive = load("drive_controller")
    return LaunchDescription([
        spawn,
        RegisterEventHandler(OnProcessExit(target_action=spawn, on_exit=[states])),
        RegisterEventHandler(OnProcessExit(target_action=states, on_exit=[drive])),
    ])
"""
CONTROLLERS = """controller_manager:
  ros__parameters:
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    drive_controller: {type: diff_drive_controller/DiffDriveController}
"""


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ('"drive_controller"', '"drive_controler"', 15, "unknown controller `drive_controler`"),
        ('"load_controller"', '"load_controllers"', 9, "`ros2 control` has no command `load_controllers`"),
        ('"--set-state"', '"--state"', 9, "`load_controller` has no option `--state`"),
        ('"active"', '"activ"', 9, "unknown state `activ` of a controller"),
        (
            "target_action=spawn",
            "target_action=drive",
            18,
            "`drive` starts after `states`, which waits for `drive`: neither of them starts",
        ),
    ],
)
def test_a_wrong_command_of_ros2_control_is_reported(tmp_path, old, new, line, message):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "ros_gz_sim", "ros2controlcli")
    write(cart / "config/controllers.yaml", CONTROLLERS)
    for text, expected in ((CONTROL.replace(old, new), [(line, message)]), (CONTROL, [])):
        write(cart / "launch/cart.launch.py", text)
        listed = found(cart, "L106", "L122", "K960")
        assert [(at, words.partition(";")[0]) for _, at, words in listed] == expected


@pytest.mark.parametrize(
    "command",
    [
        ["load_controller", "--set-state=active"],
        [
            "load_controller",
            "--controller-manager=/manager",
            "--set",
            "active",
            "NAME",
            "--ros-args",
            "--remap",
            "a:=b",
        ],
        ["load_controller", "NAME", "--no-daemon"],
        *([f"{name}_controller"] for name in ("configure", "load_start", "load_configure", "configure_start")),
        ["view_hardware_status"],
        ["load_controller", "active", "--set-state"],
    ],
)
def test_a_right_command_of_ros2_control_is_not_reported(tmp_path, command):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "ros_gz_sim", "ros2controlcli")
    text = CONTROL.replace('"load_controller", "--set-state", "active"', ", ".join(f'"{word}"' for word in command))
    assert text != CONTROL
    write(cart / "launch/cart.launch.py", text)
    assert not found(cart, "L106")


BRIDGES = """
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

TOPICS = {
    "clock": ("rosgraph_msgs/msg/Clock", "[", "gz.msgs.Clock"),
    "scan": ("sensor_msgs/msg/LaserScan", "[", "gz.msgs.LaserScan"),
    "joint_states": ("sensor_msgs/msg/JointState", "[", "gz.msgs.Model"),
}


def generate_launch_description():
    arguments = []
    for topic, (ros, way, gazebo) in TOPICS.items():
        arguments.append(f"/{topic}@{ros}{way}{gazebo}")
    arguments.append("/cmd_vel@geometry_msgs/msg/Twist]gz.msgs.Twist")
    return LaunchDescription([
        IncludeLaunchDescription(
            PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])),
        Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[{"use_sim_time": True}]),
        Node(package="ros_gz_bridge", executable="parameter_bridge", arguments=arguments),
    ])
"""
JOINTS = '<robot name="cart"><link name="base"/><gazebo>\n<plugin filename="gz-sim-joint-state-publisher-system"'
JOINTS += ' name="gz::sim::systems::JointStatePublisher">\n<topic>joint_states</topic></plugin></gazebo></robot>\n'


def _without(name: str) -> str:
    return "".join(line for line in BRIDGES.splitlines(keepends=True) if f'    "{name}": (' not in line)


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        (BRIDGES, 0, ""),
        (BRIDGES.replace("gz.msgs.LaserScan", "gz.msgs.LaserScann"), 10, "unknown Gazebo type `gz.msgs.LaserScann`"),
        (BRIDGES.replace('Scan", "["', 'Scan", "]"'), 10, "Gazebo publishes `LaserScan` and does not read it"),
        (BRIDGES.replace("msg/Twist]", "msg/Twits]"), 19, "unknown ROS type `geometry_msgs/msg/Twits`"),
        (_without("clock"), 9, "no bridge has the topic `clock`, so the time of nodes with `use_sim_time` stays at"),
        (_without("joint_states"), 9, "no bridge has the joint states of the robot"),
    ],
)
def test_bridges_that_a_loop_composes_are_checked(tmp_path, text, line, message):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "ros_gz_sim", "ros_gz_bridge")
    write(cart / "cart.urdf", JOINTS)
    write(cart / "launch/cart.launch.py", text)
    listed = [(at, words[: len(message)]) for _, at, words in found(cart, "K969")]
    assert listed == ([(line, message)] if message else [])


def test_alternatives_under_opposite_conditions_are_no_separated_nodes(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "robot_state_publisher", "joint_state_publisher")
    state = '<node name="state" pkg="robot_state_publisher" type="robot_state_publisher">{}</node>'
    remap = '<remap from="joint_states" to="/cart/joint_states"/>'
    joints = '<node name="joints" pkg="joint_state_publisher" type="joint_state_publisher"/>'
    own = '<launch><arg name="sim" default="true"/>\n<group if="$(arg sim)">{}</group>\n<group unless="$(arg sim)">{}'
    for inner, count in (("", 1), (state.format(""), 0)):
        write(cart / "launch/a.launch", own.format(state.format(remap), joints + inner) + "</group></launch>\n")
        assert len(found(cart, "K980")) == count


def test_a_map_that_rewritten_parameters_name_is_found(tmp_path):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "nav2_map_server", "nav2_common")
    write(cart / "config/map.yaml", 'map_server:\n  ros__parameters:\n    yaml_filename: ""\n')
    text = """
from launch import LaunchDescription
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare
from nav2_common.launch import RewrittenYaml


def generate_launch_description():
    file = PathJoinSubstitution([FindPackageShare("cart"), "config", "map.yaml"])
    params = RewrittenYaml(source_file=file, param_rewrites={"NAME": LaunchConfiguration("map", default="m.yaml")})
    server = Node(package="nav2_map_server", executable="map_server", name="map_server", parameters=[params])
    return LaunchDescription([server])
"""
    for name, count in (("topic_name", 1), ("yaml_filename", 0)):
        write(cart / "launch/m.launch.py", text.replace("NAME", name))
        assert len(found(cart, "L126")) == count


CONDITIONS = """<launch>
  <arg name="gui" default="true"/>
  <arg name="simulate" default="true"/>
  <group unless="$(arg simulate)">
    <node name="lidar" pkg="rplidar_ros" type="rplidarNode"/>
  </group>
  <node if="$(arg gui)" name="sliders" pkg="joint_state_publisher_gui" type="joint_state_publisher_gui"/>
  <node unless="$(arg gui)" name="joints" pkg="joint_state_publisher" type="joint_state_publisher"/>
</launch>
"""


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ('unless="$(arg gui)"', 'if="$(arg gui)"', 8, "both publishers of joint states start if `gui` is true"),
        (
            '<node if="$(arg gui)"',
            '<node unless="$(arg gui)"',
            7,
            "this starts `joint_state_publisher_gui` if `gui` is false",
        ),
        ('unless="$(arg simulate)"', 'if="$(arg simulate)"', 4, "this starts a driver of the hardware if `simulate`"),
    ],
)
def test_a_condition_that_starts_both_alternatives_is_reported(tmp_path, old, new, line, message):
    cart = package(tmp_path / "cart", "catkin", "joint_state_publisher", "joint_state_publisher_gui", "rplidar_ros")
    for text, expected in ((CONDITIONS.replace(old, new), [(line, message)]), (CONDITIONS, [])):
        write(cart / "launch/cart.launch", text)
        assert [(at, words[: len(message)]) for _, at, words in found(cart, "L127")] == expected


def test_gazebo_under_two_opposite_conditions_always_starts(tmp_path):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "ros_gz_sim", "rviz2")
    include = """IncludeLaunchDescription(
        PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"]), condition={})"""
    text = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    headless = LaunchConfiguration("headless")
    return LaunchDescription([DeclareLaunchArgument("headless", default_value="false"), GroupAction([{}])])
"""
    node = '<node pkg="rviz2" exec="rviz2"><param name="use_sim_time" value="false"/></node>'
    file = '<include file="$(find-pkg-share cart)/launch/sim.launch.py"/>'
    write(cart / "launch/all.launch.xml", f"<launch>\n{file}\n{node}\n</launch>\n")
    with_user, without = include.format("UnlessCondition(headless)"), include.format("IfCondition(headless)")
    for listed, expected in ((f"{with_user}, {without}", [3]), (with_user, [])):
        write(cart / "launch/sim.launch.py", text.replace("[{}]", f"[{listed}]"))
        assert [line for _, line, _ in found(cart, "L121")] == expected


INCLUDES = """<launch>
<include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py"/>
<include file="$(find-pkg-share cart)/launch/moves.launch.py">
<arg name="use_sim_time" value="true"/>
</include>
<include file="$(find-pkg-share cart)/launch/sees.launch.py">
<arg name="use_sim_time" value="true"/>
</include>
</launch>
"""
INCLUDED = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    times = {"use_sim_time": LaunchConfiguration("use_sim_time")}
    return LaunchDescription([
        DeclareLaunchArgument("use_sim_time", default_value="DEFAULT"),
        Node(package="joy", executable="joy_node", parameters=[times]),
    ])
"""


@pytest.mark.parametrize(
    ("place", "default", "expected"), [(1, "false", [3]), (2, "false", []), (1, "true", []), (0, "false", [])]
)
def test_an_include_without_the_clock_next_to_gazebo(tmp_path, place, default, expected):
    """A value that an earlier include passes holds for later ones, so only an include before it has the default."""
    cart = package(tmp_path / "cart", "ament_cmake", "joy", "launch_ros", "ros_gz_sim")
    parts = INCLUDES.split('<arg name="use_sim_time" value="true"/>\n')
    texts = ['<arg name="use_sim_time" value="true"/>\n'] * 2
    if place:
        texts[place - 1] = ""
    write(cart / "launch/all.launch.xml", parts[0] + texts[0] + parts[1] + texts[1] + parts[2])
    for name in ("moves", "sees"):
        write(cart / f"launch/{name}.launch.py", INCLUDED.replace("DEFAULT", default))
    assert [line for _, line, _ in found(cart, "L121")] == expected


@pytest.mark.parametrize(
    ("plugin", "ros", "type", "message"),
    [
        (
            "ignition-gazebo-imu",
            "Imu",
            "ignition.msgs.Imu",
            "unknown Gazebo type `ignition.msgs.Imu`; did you mean `ignition.msgs.IMU`?",
        ),
        (
            "ignition-gazebo-imu",
            "Imu",
            "ignition.msgs.Image",
            "cannot convert between `sensor_msgs/msg/Imu` and `ignition.msgs.Image`; use `ignition.msgs.IMU`",
        ),
        (
            "gz-sim-imu",
            "Imu",
            "ignition.msgs.Imu",
            "unknown Gazebo type `ignition.msgs.Imu`; did you mean `gz.msgs.IMU`?",
        ),
        (
            "gz-sim-imu",
            "Imu",
            "ignition.msgs.IMU",
            "`ignition.msgs.IMU` is a type of Gazebo Fortress; did you mean `gz.msgs.IMU`?",
        ),
        ("ignition-gazebo-imu", "Imu", "ignition.msgs.IMU", None),
    ],
)
def test_a_type_of_the_messages_has_the_namespace_of_the_release(tmp_path, plugin, ros, type, message):
    cart = package(tmp_path / "cart", "ament_cmake", "ros_gz_bridge")
    sensor = '<gazebo reference="base"><sensor name="imu" type="imu"><topic>imu</topic></sensor></gazebo>'
    system = f'<gazebo><plugin name="ignition::gazebo::systems::Imu" filename="{plugin}-system"/></gazebo>'
    write(cart / "cart.urdf", f'<robot name="cart"><link name="base"/>{sensor}{system}</robot>\n')
    bridge = (
        f"- topic_name: imu\n  ros_type_name: sensor_msgs/msg/{ros}\n  gz_type_name: {type}\n  direction: GZ_TO_ROS\n"
    )
    write(cart / "config/bridge.yaml", bridge)
    assert [each.message for each in lint(cart, select=["K969"])] == ([message] if message else [])
