"""Mistakes between the files of mobile robots of ROS 1 and ROS 2: each has one finding, at its line."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint


def wheel(side, y, prefix=""):
    return f"""  <link name="{side}_wheel"><collision><origin rpy="1.570796327 0 0"/><geometry>
    <cylinder radius="0.1" length="0.04"/></geometry></collision><inertial><mass value="1"/>
    <inertia ixx="0.003" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.003"/></inertial></link>
  <joint name="{side}_joint" type="continuous"><parent link="base_link"/><child link="{side}_wheel"/>
    <origin xyz="0 {y} 0.1"/><axis xyz="0 1 0"/><limit effort="5" velocity="10"/></joint>
{prefix}"""


LASER = """  <link name="laser"/>
  <joint name="laser_joint" type="fixed"><parent link="base_link"/><child link="laser"/><origin xyz="0 0 0.3"/></joint>
  <gazebo reference="laser"><sensor name="lidar" type="ray"><ray><scan><horizontal><samples>360</samples>
    <min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>8</max></range></ray>
    <plugin name="lidar" filename="libgazebo_ros_laser.so"><topicName>scan</topicName><frameName>laser</frameName>
    </plugin>
  </sensor></gazebo>
"""
CONTROL = """  <gazebo><plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so">
    <robotNamespace>/</robotNamespace></plugin></gazebo>
"""


def transmission(side):
    return f"""  <transmission name="{side}_transmission"><type>transmission_interface/SimpleTransmission</type>
    <joint name="{side}_joint"><hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint>
    <actuator name="{side}_motor"/></transmission>
"""


HEAD = """<robot name="cart">
  <link name="base"/>
  <joint name="base_joint" type="fixed"><parent link="base"/><child link="base_link"/></joint>
  <link name="base_link"><inertial><mass value="5"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
    </inertial></link>
"""
WHEELS = wheel("left", 0.2) + wheel("right", -0.2)
ROBOT1 = f"{HEAD}{WHEELS}{transmission('left')}{transmission('right')}{LASER}{CONTROL}</robot>\n"
ROBOT2 = f"{HEAD}{WHEELS}{LASER.partition('  <gazebo')[0]}</robot>\n"


def manifest(tool, *packages):
    needed = "".join(f"  <exec_depend>{each}</exec_depend>\n" for each in packages)
    kind = "<export><build_type>ament_cmake</build_type></export>" if tool == "ament_cmake" else ""
    return f"""<package format="3">
  <name>cart</name>
  <version>1.0.0</version>
  <description>A cart.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>{tool}</buildtool_depend>
{needed}{kind}
</package>
"""


NAVIGATION = """amcl controller_manager diff_drive_controller gmapping joy map_server move_base robot_localization
teleop_twist_joy twist_mux"""
ROS1 = {
    "cart.urdf": ROBOT1,
    "package.xml": manifest("catkin", *NAVIGATION.split()),
    "control.yaml": """drive:
  type: diff_drive_controller/DiffDriveController
  left_wheel: [left_joint]
  right_wheel: [right_joint]
  pose_covariance_diagonal: [0.1, 0.1, 0.1, 0.1, 0.1, 0.1]
  twist_covariance_diagonal: [0.1, 0.1, 0.1, 0.1, 0.1, 0.1]
  wheel_separation: 0.4
  wheel_radius: 0.1
  linear: {x: {has_velocity_limits: true, max_velocity: 0.9}}
""",
    "odom.yaml": """world_frame: odom
odom_frame: odom
map_frame: map
base_link_frame: base
odom0: drive/odom
""",
    "map.yaml": """world_frame: map
odom_frame: odom
map_frame: map
base_link_frame: base
odom0: drive/odom
""",
    "mux.yaml": """topics:
  - {name: joystick, topic: joystick/cmd_vel, timeout: 0.5, priority: 100}
  - {name: navigation, topic: move_base/cmd_vel, timeout: 0.5, priority: 10}
""",
    "costmap.yaml": """robot_base_frame: base_link
transform_tolerance: 0.3
obstacle_layer:
  observation_sources: laser
  laser:
    topic: scan
    data_type: LaserScan
    min_obstacle_height: 0.1
    obstacle_range: 4.0
    raytrace_range: 5.0
inflation_layer:
  inflation_radius: 0.5
""",
    "gmapping.yaml": "base_frame: base_link\nodom_frame: odom\nmap_frame: map\nmaxUrange: 7.0\ndelta: 0.05\n",
    "start.launch": """<launch>
  <rosparam command="load" file="$(find cart)/control.yaml"/>
  <node pkg="controller_manager" type="spawner" name="spawner" args="drive"/>
  <node pkg="twist_mux" type="twist_mux" name="twist_mux">
    <rosparam command="load" file="$(find cart)/mux.yaml"/>
    <remap from="cmd_vel_out" to="drive/cmd_vel"/>
  </node>
  <group ns="joystick">
    <node pkg="teleop_twist_joy" type="teleop_node" name="teleop"/>
  </group>
  <node pkg="robot_localization" type="ekf_localization_node" name="odom_filter">
    <rosparam command="load" file="$(find cart)/odom.yaml"/>
  </node>
  <node pkg="robot_localization" type="ekf_localization_node" name="map_filter">
    <rosparam command="load" file="$(find cart)/map.yaml"/>
    <remap from="odometry/filtered" to="odometry/map"/>
  </node>
  <include file="$(find cart)/navigate.launch">
    <arg name="mode" value="slam"/>
  </include>
</launch>
""",
    "navigate.launch": """<launch>
  <arg name="mode" default="amcl"/>
  <node pkg="map_server" type="map_server" name="map_server" args="hall.yaml" if="$(eval arg('mode') == 'amcl')"/>
  <node pkg="gmapping" type="slam_gmapping" name="slam_gmapping" if="$(eval arg('mode') == 'slam')">
    <rosparam command="load" file="$(find cart)/gmapping.yaml"/>
  </node>
  <node pkg="move_base" type="move_base" name="move_base">
    <rosparam command="load" file="$(find cart)/costmap.yaml" ns="local_costmap"/>
    <remap from="cmd_vel" to="move_base/cmd_vel"/>
  </node>
</launch>
""",
}

RELEASED = """nav2_controller nav2_amcl nav2_costmap_2d nav2_map_server robot_localization rplidar_ros ros_gz_bridge
ros_gz_sim slam_toolbox twist_mux"""
ROS2 = {
    "cart.urdf": ROBOT2,
    "package.xml": manifest("ament_cmake", *RELEASED.split()),
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.8)
project(cart)
find_package(ament_cmake REQUIRED)
install(DIRECTORY launch config worlds DESTINATION share/${PROJECT_NAME})
ament_package()
""",
    "config/ekf.yaml": """ekf_filter_node:
  ros__parameters:
    odom0: wheels/odom
    odom_frame: odom
""",
    "config/nav2.yaml": """controller_server:
  ros__parameters:
    controller_frequency: 20.0
    controller_plugins: ["FollowPath"]
    FollowPath:
      plugin: "nav2_mppi_controller::MPPIController"
      time_steps: 56
      model_dt: 0.05
amcl:
  ros__parameters:
    scan_topic: scan_front
global_costmap:
  global_costmap:
    ros__parameters:
      global_frame: map
      robot_base_frame: base
      plugins: [static_layer]
      static_layer:
        plugin: nav2_costmap_2d::StaticLayer
        map_subscribe_transient_local: true
""",
    "config/bridge.yaml": """- ros_topic_name: clock
  gz_topic_name: /world/hall/clock
  ros_type_name: rosgraph_msgs/msg/Clock
  gz_type_name: gz.msgs.Clock
  direction: GZ_TO_ROS
- ros_topic_name: wheels/odom
  gz_topic_name: /model/cart/odometry
  ros_type_name: nav_msgs/msg/Odometry
  gz_type_name: gz.msgs.Odometry
  direction: GZ_TO_ROS
""",
    "worlds/hall.sdf": '<sdf version="1.9"><world name="hall"/></sdf>\n',
    "launch/other.launch.xml": '<launch><node pkg="twist_mux" exec="twist_mux" name="twist_mux"/></launch>\n',
    "launch/start.launch.py": """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def lidar(name):
    return Node(
        package="rplidar_ros",
        executable="rplidar_node",
        name=f"lidar_{name}",
        parameters=[{"frame_id": "laser"}],
        remappings=[("scan", f"scan_{name}")],
    )


def setup(context):
    has_rear = LaunchConfiguration("rear").perform(context).lower() == "true"
    return [lidar("rear")] if has_rear else []


def generate_launch_description():
    share = FindPackageShare("cart")
    return LaunchDescription([
        DeclareLaunchArgument("rear", default_value="false"),
        OpaqueFunction(function=setup),
        lidar("front"),
        IncludeLaunchDescription(AnyLaunchDescriptionSource(PathJoinSubstitution([share, "launch/other.launch.xml"]))),
        Node(
            package="nav2_amcl",
            executable="amcl",
            name="amcl",
            parameters=[PathJoinSubstitution([share, "config", "nav2.yaml"])],
        ),
        Node(
            package="robot_localization",
            executable="ekf_node",
            name="ekf_filter_node",
            parameters=[PathJoinSubstitution([share, "config", "ekf.yaml"])],
            remappings=[("odometry/filtered", "odom")],
        ),
        Node(
            package="nav2_map_server",
            executable="map_server",
            name="map_server",
            parameters=[{"yaml_filename": "hall.yaml"}],
        ),
        Node(
            package="ros_gz_sim",
            executable="create",
            arguments=["-world", "hall", "-name", "cart", "-topic", "robot_description"],
        ),
    ])
""",
}
FILTER = 'type="ekf_localization_node" name="map_filter">\n    <rosparam command="load" file="$(find cart)/map.yaml"/>'
START = "launch/start.launch.py"
MISTAKES = [
    (
        ROS1,
        "control.yaml",
        "left_wheel:",
        "left_wheel_names:",
        "K971",
        3,
        "no parameter `left_wheel_names`; did you me",
    ),
    (
        ROS1,
        "control.yaml",
        "velocity: 0.9",
        "velocity: 1.5",
        "K982",
        9,
        "velocity limit of joint `left_joint` allows 1 m/",
    ),
    (
        ROS1,
        "map.yaml",
        "world_frame: map",
        "world_frame: odom",
        "K983",
        1,
        "publish the same transform; set `world_frame` of one of them to `map`",
    ),
    (ROS1, "start.launch", "cart)/map.yaml", "cart)/odom.yaml", "K983", 14, "load the same parameters"),
    (
        ROS1,
        "start.launch",
        'odometry/filtered" to="odometry/map',
        'odom" to="odom',
        "K980",
        14,
        "two nodes of this file",
    ),
    (
        ROS1,
        "start.launch",
        'ns="joystick"',
        'ns="joy"',
        "K980",
        8,
        "on `joy/cmd_vel`; did you mean `joystick/cmd_vel`?",
    ),
    (
        ROS1,
        "navigate.launch",
        'to="move_base/cmd_vel"',
        'to="nav/cmd_vel"',
        "K980",
        9,
        "no node subscribes to the velocity commands on `nav/cmd_vel`",
    ),
    (
        ROS1,
        "start.launch",
        'value="slam"',
        'value="mapping"',
        "L125",
        19,
        "no condition is true for the value `mapping`",
    ),
    (
        ROS1,
        "navigate.launch",
        ' args="hall.yaml"',
        "",
        "L126",
        3,
        "`map_server` has no arguments; write the file of the",
    ),
    (
        ROS1,
        "navigate.launch",
        ' ns="local_costmap"',
        "",
        "L110",
        8,
        "costmap.yaml has parameters of costmaps, which costmaps",
    ),
    (
        ROS1,
        "navigate.launch",
        ' ns="local_costmap"',
        ' ns="local_map"',
        "L110",
        8,
        "which move_base does not read from `local_map`; did yo",
    ),
    (ROS1, "costmap.yaml", "obstacle_range", "obstacle_max_range", "K971", 9, "did you mean `obstacle_range`?"),
    (
        ROS1,
        "costmap.yaml",
        "height: 0.1",
        "height: 0.4",
        "K979",
        8,
        "above the scanner `laser` at 0.3 m, so no point is used",
    ),
    (ROS1, "gmapping.yaml", "odom_frame: odom", "odom_frame: drive/odom", "K984", 2, "is a topic, not a frame"),
    (ROS1, "gmapping.yaml", "Urange: 7.0", "Urange: 70.0", "K979", 4, "the scanner measures up to 8 m"),
    (ROS1, "cart.urdf", "<robotNamespace>/<", "<robotNamespace>/cart<", "K960", 0, "start.launch:3 is in no namespace"),
    (
        ROS2,
        "config/ekf.yaml",
        "wheels/odom",
        "odom",
        "K980",
        3,
        "publishes `odom`, so `odom0` makes it read its own output",
    ),
    (
        ROS2,
        "config/nav2.yaml",
        "nav2_mppi_controller::MPPIController",
        "dwb_core::DWBLocalPlanner",
        "K982",
        6,
        "of `MPPI",
    ),
    (
        ROS2,
        "config/nav2.yaml",
        "frequency: 20.0",
        "frequency: 10.0",
        "K982",
        3,
        "`model_dt` is 0.05 s, shorter than the period of `controller_server`, 0.1 s",
    ),
    (ROS2, "config/nav2.yaml", "_dt: 0.05", "_dt: 0.02", "K982", 8, "shorter than the period of `controller_server`"),
    (ROS2, "config/nav2.yaml", "scan_front", "scan", "K977", 11, "no other file names the topic `scan`"),
    (
        ROS2,
        "config/bridge.yaml",
        "/hall/",
        "/default/",
        "K969",
        2,
        "no world file of these packages has a world `default`",
    ),
    (ROS2, "config/bridge.yaml", "/cart/odo", "/cart_1/odo", "K969", 7, "no launch file spawns a model `cart_1`"),
    (ROS2, "config/nav2.yaml", "local: true", "local: false", "K982", 20, "`map_server` publishes the map before this"),
    (
        ROS2,
        START,
        '("scan", f"scan_{name}")',
        '(f"scan_{name}", "scan")',
        "K980",
        15,
        "not `scan_rear`; swap the names",
    ),
    (
        ROS2,
        START,
        '"frame_id": "laser"',
        '"frame_id": "lidar_link"',
        "K961",
        14,
        "robot `cart` has no link `lidar_link`, the frame of this node",
    ),
    (ROS2, START, '.lower() == "true"', ".lower() == 'True'", "L106", 20, "a lower-case string is never `True`"),
    (
        ROS2,
        START,
        'LaunchConfiguration("rear").perform(context).lower() == "true"',
        'bool(LaunchConfiguration("rear").perform(context))',
        "L106",
        20,
        "this string is always true, even if it is `false`",
    ),
    (
        ROS2,
        START,
        'perform(context).lower() == "true"',
        "perform(context) == True",
        "L106",
        20,
        "compares a string with True",
    ),
    (
        ROS2,
        START,
        "AnyLaunchDescriptionSource(P",
        "PythonLaunchDescriptionSource(P",
        "L106",
        30,
        "cannot load `other.lau",
    ),
]
"""Files, file, text, its replacement, code, line (0 for any) and a part of the message."""


def findings(folder, files, name="", old="", new=""):
    for file, text in files.items():
        assert file != name or old in text, old
        (folder / file).parent.mkdir(exist_ok=True)
        text = text.replace(old, new, 1) if file == name else text
        if "PythonLaunchDescriptionSource(P" in text:
            text = text.replace("import AnyLaunch", "import PythonLaunch")
        (folder / file).write_text(text)
    return [f"{one.code} {one.file}:{one.line} {one.message}".replace(f"{folder}/", "") for one in lint(folder)]


@pytest.mark.parametrize("files", [ROS1, ROS2], ids=["ROS 1", "ROS 2"])
def test_correct_workspaces_are_silent(tmp_path, files):
    assert findings(tmp_path, files) == []


@pytest.mark.parametrize(("files", "name", "old", "new", "code", "line", "message"), MISTAKES)
def test_each_mistake_has_one_finding(tmp_path, files, name, old, new, code, line, message):
    [found] = findings(tmp_path, files, name, old, new)
    assert found.startswith(f"{code} {name}:{line or ''}")
    assert message in found
