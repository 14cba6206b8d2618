"""Mistakes in launch files of one or two packages, with the findings that name them."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="{format}">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>A package for tests.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>{tool}</buildtool_depend>
{needed}</package>
"""


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def package(folder: Path, tool: str, *needed: str) -> Path:
    """Write a package with the robot `cart` into a folder."""
    lines = "".join(f"  <exec_depend>{each}</exec_depend>\n" for each in needed)
    write(folder / "package.xml", MANIFEST.format(format=2, name=folder.name, tool=tool, needed=lines))
    write(folder / "cart.urdf", '<robot name="cart">\n  <link name="base"/>\n</robot>\n')
    return folder


def found(folder: Path, *codes: str) -> list[tuple[str, int, str]]:
    """Return the file name, line and message of the findings with these codes."""
    findings = [finding for finding in lint(folder) if finding.code in codes]
    return [(Path(finding.file).name, finding.line, finding.message) for finding in findings]


USES = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("{declared}", default_value="false"),
        Node(package="rviz2", executable="rviz2", parameters=[{"use_sim_time": LaunchConfiguration("use_sim_time")}]),
    ])
"""
INCLUDES = """<launch>
  <include file="$(find-pkg-share cart)/launch/view.launch.py">
    <arg name="use_sim_time" value="true"/>
  </include>
</launch>
"""


@pytest.mark.parametrize("declared", ["log", "use_sim_time"])
def test_an_argument_that_only_an_including_file_has_is_a_warning(tmp_path, declared):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "rviz2")
    write(cart / "launch/view.launch.py", USES.replace("{declared}", declared))
    write(cart / "launch/all.launch.xml", INCLUDES)
    message = "launch argument `log` is declared but not used, and `use_sim_time` is not declared"
    assert found(cart, "L101") == ([("view.launch.py", 10, message)] if declared == "log" else [])
    both = '"log", default_value="1"), DeclareLaunchArgument("{declared}"'
    write(cart / "launch/view.launch.py", USES.replace('"{declared}"', both).replace("{declared}", declared + "s"))
    message = "launch argument `use_sim_time` is not declared; the file fails unless an including file declares it"
    assert (declared == "log") is (("view.launch.py", 11, message) in found(cart, "L101"))


@pytest.mark.parametrize(("needed", "is_reported"), [("nav2_behaviors", True), ("nav2_recoveries", False)])
def test_packages_of_navigation_date_the_release_that_has_no_spawner_py(tmp_path, needed, is_reported):
    cart = package(tmp_path / "cart", "ament_cmake", "controller_manager", needed)
    write(
        cart / "launch/spawn.launch.xml",
        '<launch>\n  <node pkg="controller_manager" exec="spawner.py" args="drive"/>\n</launch>\n',
    )
    message = "package `controller_manager` has no executable `spawner.py` in this ROS 2 release; did you mean"
    reported = found(cart, "L103")
    assert len(reported) == is_reported
    assert all(text.startswith(message) for _, _, text in reported)


WORLD = """
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo, OpaqueFunction
from launch.substitutions import LaunchConfiguration


def setup(context):
    world = LaunchConfiguration("world").perform(context)
    return [LogInfo(msg=os.path.join(get_package_share_directory("cart"), "worlds", world + ".sdf"))]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("world", default_value="{default}", choices=["hall", "{choice}"]),
        OpaqueFunction(function=setup),
    ])
"""


@pytest.mark.parametrize(
    ("default", "choice", "missing"), [("hall", "yard", "yard"), ("hall", "hall", ""), ("", "hall", "")]
)
def test_each_default_and_choice_of_an_argument_names_a_file_that_exists(tmp_path, default, choice, missing):
    cart = package(tmp_path / "cart", "ament_cmake")
    write(cart / "worlds/hall.sdf", '<sdf version="1.9"><world name="hall"/></sdf>\n')
    write(cart / "launch/world.launch.py", WORLD.replace("{default}", default).replace("{choice}", choice))
    message = f"`worlds/{missing}.sdf` does not exist in package `cart`"
    assert found(cart, "K958") == ([("world.launch.py", 11, message)] if missing else [])


INNER = (
    '<launch>\n  <arg name="mode"{}/>\n  <include file="$(find cart)/launch/$(arg mode)_drive.launch"/>\n</launch>\n'
)
MIDDLE = """<launch>
  <arg name="drive" default="fake"/>
  <include file="$(find cart)/launch/inner.launch">
    <arg name="mode" value="$(arg drive)"/>
  </include>
</launch>
"""
OUTER = """<launch>
  <include file="$(find cart)/launch/middle.launch">
    <arg name="drive" value="{}"/>
  </include>
</launch>
"""


@pytest.mark.parametrize(
    ("default", "value", "place"),
    [
        ("", "real", None),
        (' default="fake"', "reel", ("outer.launch", 3, "reel")),
        (' default="feke"', "real", ("inner.launch", 3, "feke")),
    ],
)
def test_values_that_including_files_pass_on_name_a_file_that_exists(tmp_path, default, value, place):
    cart = package(tmp_path / "cart", "catkin")
    for name in ("real_drive", "fake_drive"):
        write(cart / f"launch/{name}.launch", "<launch/>\n")
    write(cart / "launch/inner.launch", INNER.format(default))
    write(cart / "launch/middle.launch", MIDDLE)
    write(cart / "launch/outer.launch", OUTER.format(value))
    expected = [(*place[:2], f"`launch/{place[2]}_drive.launch` does not exist in package `cart`")] if place else []
    assert found(cart, "K958") == expected


LOADS = """<launch>
  <arg name="speed" default="1"/>
  <arg name="paused" default="{paused}"/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="paused" value="$(arg paused)"/>
  </include>
  <rosparam file="$(find cart)/config/speeds.yaml"{subst_value}/>
  <group ns="robot_description_{names}">
    <rosparam command="load" file="$(find cart)/config/{solver}.yaml"/>
  </group>
  <group ns="move_group/planning_pipelines/ompl">
    <param name="planning_plugin" value="ompl_interface/OMPLPlanner"/>
  </group>
  <node name="move_group" pkg="moveit_ros_move_group" type="move_group">
    <param name="default_planning_pipeline" value="{pipeline}"/>
  </node>
  <node name="s" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model cart{unpause}"/>
  <node name="c" pkg="controller_manager" type="spawner" args="drive"/>
</launch>
"""
CORRECT = {
    "paused": "true",
    "subst_value": ' subst_value="true"',
    "solver": "kinematics",
    "names": "kinematics",
    "pipeline": "ompl",
    "unpause": " -unpause",
}


@pytest.mark.parametrize(
    ("change", "line", "message"),
    [
        ({}, 0, ""),
        ({"paused": "false", "unpause": ""}, 0, ""),
        ({"unpause": ""}, 17, "Gazebo starts paused, and controllers wait until it runs; add `-unpause`"),
        ({"pipeline": "chomp"}, 15, "planning pipeline `chomp` is not loaded; loaded: ompl"),
        ({"subst_value": ""}, 7, '`$(arg speed)` in speeds.yaml is not replaced; add `subst_value="true"`'),
        (
            {"solver": "limits"},
            9,
            "limits.yaml has no `kinematics_solver`, which MoveIt reads from `robot_description_kinematics`",
        ),
        (
            {"names": "kinematic"},
            9,
            (
                "MoveIt reads the solvers of kinematics.yaml from `robot_description_kinematics`, "
                "not from `robot_description_kinematic`"
            ),
        ),
    ],
)
def test_parameters_that_a_launch_file_of_ros1_loads(tmp_path, change, line, message):
    cart = package(tmp_path / "cart", "catkin", "gazebo_ros", "controller_manager", "moveit_ros_move_group")
    write(cart / "config/speeds.yaml", "# $(arg height)\nspeeds:\n  drive: $(arg speed)\n")
    write(cart / "config/kinematics.yaml", "arm:\n  kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin\n")
    write(cart / "config/limits.yaml", "joint_limits:\n  joint:\n    max_velocity: 1.0\n")
    write(cart / "launch/all.launch", LOADS.format(**{**CORRECT, **change}))
    assert found(cart, "L110") == ([("all.launch", line, message)] if message else [])


PIPELINE = """<launch>
  <arg name="adapters"
       default="{adapters}"/>
  <param name="planning_plugin" value="{plugin}"/>
  <param name="request_adapters" value="{value}"/>
</launch>
"""
BOUNDS = [f"default_planner_request_adapters/{name}" for name in ("FixWorkspaceBounds", "FixStartStateBounds", "Empty")]
OMPL = "ompl_interface/OMPLPlanner"


@pytest.mark.parametrize(
    ("last", "plugin", "value", "line"),
    [
        ("", OMPL, "$(arg adapters)", 3),
        ("", OMPL, " ".join(BOUNDS), 5),
        ("default_planner_request_adapters/AddTimeParameterization", OMPL, "$(arg adapters)", 0),
        ("default_planner_request_adapters/AddIterativeSplineParameterization", OMPL, "$(arg adapters)", 0),
        ("cart_planning/Timing", OMPL, "$(arg adapters)", 0),
        ("", "pilz_industrial_motion_planner::CommandPlanner", "$(arg adapters)", 0),
        ("", OMPL, "$(arg others)", 0),
    ],
)
def test_a_pipeline_of_ros1_needs_an_adapter_that_adds_times(tmp_path, last, plugin, value, line):
    cart = package(tmp_path / "cart", "catkin", "moveit_ros_move_group")
    adapters = " ".join([*BOUNDS, last])
    write(cart / "launch/ompl.launch.xml", PIPELINE.format(adapters=adapters, plugin=plugin, value=value))
    assert [each[:2] for each in found(cart, "L110") if "no time parameterization" in each[2]] == (
        [("ompl.launch.xml", line)] if line else []
    )


SPAWNS = """
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, OpaqueFunction
from launch_ros.actions import Node


def include(name):
    path = os.path.join(get_package_share_directory("cart"), "launch", name)
    return IncludeLaunchDescription(path)


def setup(context):
    spawn = Node(package="ros_gz_sim", executable="create", arguments=["-topic", "{topic}", "-name", "cart"])
    return [include("state.launch.xml"), include("drive.launch.py"), spawn]


def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=setup)])
"""
MODEL = '><param name="path" value="$(find-pkg-share cart_model)"/></node'
STATE = '<launch>\n  <node pkg="robot_state_publisher" exec="robot_state_publisher"{}/>\n</launch>\n'
DRIVES = """
from launch import LaunchDescription
from launch_ros.actions import Node


def spawner(name):
    options = [name, "-c", "{namespace}/controller_manager"]
    return Node(package="controller_manager", executable="spawner", arguments=options)


def generate_launch_description():
    return LaunchDescription([spawner("drive"), spawner("arm")])
"""


@pytest.mark.parametrize(
    ("topic", "namespace", "node", "message"),
    [
        ("robot_description", "", "", None),
        ("robot_model", "", "", ("all.launch.py", 15, "no node publishes topic `robot_model`; did you mean")),
        ("robot_model", "", '><remap from="robot_description" to="robot_model"/></node', None),
        ("cart_model", "", MODEL, ("all.launch.py", 15, "no node publishes topic `cart_model`; did you mean")),
        (
            "robot_description",
            "/a",
            "",
            ("drive.launch.py", 7, "no node of these packages is in the namespace of `/a/"),
        ),
        ("robot_description", "/a", ' namespace="a"', None),
    ],
)
def test_spawners_of_an_included_file_use_the_names_of_the_started_nodes(tmp_path, topic, namespace, node, message):
    cart = package(tmp_path / "cart", "ament_cmake", "ros_gz_sim", "robot_state_publisher", "controller_manager")
    write(cart / "launch/all.launch.py", SPAWNS.replace("{topic}", topic))
    write(cart / "launch/state.launch.xml", STATE.format(node).replace("node/>", "node>"))
    write(cart / "launch/drive.launch.py", DRIVES.replace("{namespace}", namespace))
    reported = found(cart, "K968")
    assert len(reported) == (message is not None)
    assert message is None or (reported[0][:2] == message[:2] and reported[0][2].startswith(message[2]))


GAZEBO = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    world = LaunchConfiguration("world")
    path = PathJoinSubstitution([FindPackageShare("gazebo_ros"), "launch", "gazebo.launch.py"])
    return LaunchDescription([
        DeclareLaunchArgument("world", default_value="{world}"),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(path),
            launch_arguments={"world": world, "verbose": "true"}.items(),
        ),
    ])
"""


@pytest.mark.parametrize(("world", "is_reported"), [("hall", True), ("", False), ("worlds/empty.world", False)])
def test_gazebo_classic_needs_the_path_of_the_world(tmp_path, world, is_reported):
    cart = package(tmp_path / "cart", "ament_cmake", "gazebo_ros")
    write(cart / "launch/gazebo.launch.py", GAZEBO.replace("{world}", world))
    message = "Gazebo finds no world `hall`; write the path of its file"
    assert found(cart, "K958") == ([("gazebo.launch.py", 16, message)] if is_reported else [])


CONTROLLER = "{name}:\n  type: effort_controllers/JointTrajectoryController\n  joints: [{joint}]\n"
MOVEIT = (
    "  - name: {name}\n    action_ns: follow_joint_trajectory\n    type: FollowJointTrajectory\n    joints: [{joint}]\n"
)
STARTS = """<launch>
  <rosparam command="load" file="$(find cart)/config/control.yaml"/>
  <node name="c" pkg="controller_manager" type="spawner" args="{}"/>
</launch>
"""


@pytest.mark.parametrize(
    ("spawned", "joint", "is_reported"),
    [
        ("arm", "finger", True),
        ("arm hand", "finger", False),
        ("arm", "elbow", False),
        ("$(arg names)", "finger", False),
    ],
)
def test_a_controller_that_moveit_uses_is_spawned_if_others_are(tmp_path, spawned, joint, is_reported):
    cart = package(tmp_path / "cart", "catkin", "controller_manager")
    both = ({"name": "arm", "joint": "elbow"}, {"name": "hand", "joint": joint})
    write(cart / "config/control.yaml", "".join(CONTROLLER.format(**each) for each in both))
    write(cart / "config/moveit.yaml", "controller_list:\n" + "".join(MOVEIT.format(**each) for each in both))
    write(cart / "config/cart.srdf", '<robot name="cart">\n  <group name="all"><link name="base"/></group>\n</robot>\n')
    write(cart / "launch/start.launch", STARTS.format(spawned))
    message = "no launch file spawns controller `hand`, which MoveIt uses"
    assert found(cart, "M112") == ([("start.launch", 3, message)] if is_reported else [])


SIMULATORS = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def gazebo(flags, condition):
    path = PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(path), launch_arguments={"gz_args": flags}.items(), condition=condition
    )


def generate_launch_description():
    headless = LaunchConfiguration("headless")
    return LaunchDescription([
        DeclareLaunchArgument("headless", default_value="false"),
        gazebo("-r empty.sdf", {first}(headless)),
        gazebo("-r {flag} empty.sdf", IfCondition(headless)),
    ])
"""


@pytest.mark.parametrize(
    ("first", "flag", "is_reported"),
    [("UnlessCondition", "-s", False), ("IfCondition", "-s", True), ("IfCondition", "-g", False)],
)
def test_gazebo_starts_once_under_a_condition(tmp_path, first, flag, is_reported):
    cart = package(tmp_path / "cart", "ament_cmake", "ros_gz_sim")
    write(cart / "launch/gz.launch.py", SIMULATORS.replace("{first}", first).replace("{flag}", flag))
    message = "line 21 also starts Gazebo under this condition"
    assert found(cart, "L111") == ([("gz.launch.py", 22, message)] if is_reported else [])


def test_files_that_include_each_other_many_times_are_each_read_once(tmp_path):
    """80 includes on each side, read again for each include, would be 80⁴ readings: hours."""
    cart = package(tmp_path / "cart", "catkin", "amcl")
    for own, other in (("a", "b"), ("b", "a")):
        include = f'  <include file="$(find cart)/launch/{other}.launch"/>\n'
        node = '  <node pkg="amcl" type="amcl" name="amcl"/>\n'
        write(cart / f"launch/{own}.launch", f"<launch>\n{include * 80}{node}</launch>\n")
    message = "`amcl` and `amcl` both publish the transform from the map frame to the odometry frame"
    expected = {(f"{own}.launch", line, message) for own in "ab" for line in range(3, 83)}
    assert set(found(cart, "L124")) == expected


@pytest.mark.parametrize("needed", [(), ("ros_gz_bridge",)])
def test_the_package_of_a_node_in_yaml_is_a_dependency(tmp_path, needed):
    cart = package(tmp_path / "cart", "ament_cmake", *needed)
    node = "launch:\n  - node:\n      pkg: ros_gz_bridge\n      exec: parameter_bridge\n      name: bridge\n"
    write(cart / "launch/bridge.launch.yaml", node)
    places = [
        (one.file.rpartition("/")[2], one.line) for each in lint(cart) if each.code == "K956" for one in each.related
    ]
    assert places == ([] if needed else [("bridge.launch.yaml", 3)])


SERVERS = """<launch>
  <arg name="map"/>
  <arg name="names" default="map_server"/>
  <node pkg="nav2_map_server" exec="map_server" name="map_server">
    <param name="yaml_filename" value="$(var map)"/>
  </node>
  <node pkg="nav2_amcl" exec="amcl" name="amcl"/>
  <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
    <param name="autostart" value="true"/>
    {}
  </node>
{}</launch>
"""
SECOND = """  <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="second">
    <param name="node_names" value="{}"/>
  </node>
"""
UNLISTED = "no lifecycle manager of this file lists the node `amcl`, so it is never activated"


@pytest.mark.parametrize(
    ("names", "more", "message"),
    [
        ('<param name="node_names" value="map_server" value-sep=","/>', "", UNLISTED),
        ("""<param name="node_names" value="['map_server']"/>""", "", UNLISTED),
        ('<param name="node_names" value="map_server,amcl" value-sep=","/>', "", None),
        ("""<param name="node_names" value="['map_server', 'amcl']"/>""", "", None),
        ('<param name="node_names" value="$(var names)" value-sep=","/>', "", None),
        ("""<param name="node_names" value="['map_server']"/>""", SECOND.format("[amcl]"), None),
        ("""<param name="node_names" value="['map_server']"/>""", SECOND.format("[$(var names)]"), None),
        (
            '<param name="node_names" value="map_server,amlc" value-sep=","/>',
            "",
            "no node is called `amlc`; did you mean `amcl`?",
        ),
    ],
)
def test_names_of_managed_nodes_in_an_xml_launch_file(tmp_path, names, more, message):
    cart = package(tmp_path / "cart", "ament_cmake", "nav2_map_server", "nav2_amcl", "nav2_lifecycle_manager")
    write(cart / "launch/localization.launch.xml", SERVERS.format(names, more))
    assert found(cart, "L117") == ([("localization.launch.xml", 10, message)] if message else [])


@pytest.mark.parametrize("name", ["planner_server", "driver"])
def test_a_listed_server_that_nothing_starts_stands_for_the_only_unlisted_node(tmp_path, name):
    cart = package(tmp_path / "cart", "ament_cmake", "nav2_map_server", "nav2_amcl", "nav2_lifecycle_manager")
    names = f"""<param name="node_names" value="['map_server', '{name}']"/>"""
    write(cart / "launch/other.launch.xml", "<launch/>\n")
    more = '<include file="$(find-pkg-share cart)/launch/other.launch.xml"/>\n'
    write(cart / "launch/localization.launch.xml", SERVERS.format(names, more))
    missing = "no launch file of these packages starts the node `planner_server`; did you mean `amcl`?"
    assert found(cart, "L117") == [("localization.launch.xml", 10, UNLISTED if name == "driver" else missing)]


FILTERS = """ekf:
  ros__parameters:
    imu0: imu/data
navsat:
  ros__parameters:
    frequency: 30.0
"""
NAVSAT = """<launch>
  <node pkg="robot_localization" exec="ekf_node" name="ekf">
    <param from="$(find-pkg-share cart)/config/filters.yaml"/>
    <remap from="imu/data" to="imu"/>
  </node>
  <node pkg="robot_localization" exec="navsat_transform_node" name="{name}">
    <param from="$(find-pkg-share cart)/config/filters.yaml"/>
    <remap from="{old}" to="{new}"/>
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("name", "old", "new", "is_reported"),
    [
        ("navsat", "imu/data", "imu", True),
        ("navsat", "imu", "imu/data", False),
        ("other", "imu/data", "imu", False),
    ],
)
def test_the_topic_of_another_section_of_the_parameter_file_is_not_that_of_the_node(
    tmp_path, name, old, new, is_reported
):
    cart = package(tmp_path / "cart", "ament_cmake", "robot_localization")
    write(cart / "config/filters.yaml", FILTERS)
    write(cart / "launch/filters.launch.xml", NAVSAT.format(name=name, old=old, new=new))
    message = "`navsat_transform_node` has no topic `imu/data`; did you mean `imu`?"
    assert found(cart, "K980") == ([("filters.launch.xml", 8, message)] if is_reported else [])


POSITIONS = """<launch>
  <node name="a" pkg="gazebo_ros" type="spawn_model"
        args="-urdf -param robot_description -model cart {} -0.6"/>
</launch>
"""


@pytest.mark.parametrize(
    ("joints", "is_found"),
    [
        ("-J lift 0.1 -J shoulder_pan", True),
        ("-J lift 0.1 -J turn", False),
        ("-J shoulder_pan", False),  # no joint is one of this robot's
        ("-J lift 0.1 -J $(arg joint)", False),
    ],
)
def test_a_joint_with_a_first_position_exists_if_the_others_are_of_this_robot(
    tmp_path: Path, joints: str, is_found: bool
) -> None:
    folder = package(tmp_path / "cart", "catkin", "gazebo_ros")
    names = {"lift": "mast", "turn": "head"}
    parts = "".join(
        f'  <link name="{link}"/>\n  <joint name="{joint}" type="continuous">'
        f'<parent link="base"/><child link="{link}"/></joint>\n'
        for joint, link in names.items()
    )
    write(folder / "cart.urdf", f'<robot name="cart">\n  <link name="base"/>\n{parts}</robot>\n')
    write(folder / "launch" / "spawn.launch", POSITIONS.format(joints))
    rows = [row for row in found(folder, "K968") if "joint" in row[2]]
    assert rows == [("spawn.launch", 3, "unknown joint `shoulder_pan`")] * is_found


LAUNCH = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, GroupAction, IncludeLaunchDescription, OpaqueFunction
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.event_handlers import OnStateTransition


def more(context):
    {more}


def generate_launch_description():
    arguments = [DeclareLaunchArgument("sim", default_value="false"), DeclareLaunchArgument("slam")]
    settings = {{"use_sim_time": LaunchConfiguration("sim")}}
    common = [settings]
    left, right = Node(package="joy", executable="joy_node"), Node(package="tf2_ros", executable="buffer_server")
    handler = OnStateTransition(start_state="configuring", goal_state="{goal}")
    driver = Node(package="urg_node", executable="urg_node_driver", condition={driver}(LaunchConfiguration("sim")))
    localization = GroupAction(condition={amcl}(LaunchConfiguration("slam")), actions=[
        Node(package="nav2_amcl", executable="amcl", name="amcl"),
    ])
    mapping = Node(
        package="slam_toolbox",
        executable="async_slam_toolbox_node",
        name="slam_toolbox",
        condition=IfCondition(LaunchConfiguration("slam")),
    )
    filter = Node(package="twist_mux", executable="twist_mux", parameters=[{parameters}])
    nodes = [filter, left, {nodes}]
    {end}LaunchDescription([{arguments}*nodes, {driven}, mapping, localization, handler{opaque}])
"""
RIGHT = {
    "more": "return [Node(package='joy', executable='joy_node')]",
    "goal": "inactive",
    "driver": "UnlessCondition",
    "amcl": "UnlessCondition",
    "parameters": "*common, settings",
    "nodes": "right",
    "end": "return ",
    "arguments": "*arguments, ",
    "driven": "driver",
    "opaque": ", OpaqueFunction(function=more)",
}
NO_RETURN = "the function `more` of an OpaqueFunction does not return its actions; return the list of actions"
UNDECLARED = "list of arguments `arguments` is not added to the launch description: the arguments are not declared"
MISTAKES = [
    ("more", "[Node(package='joy', executable='joy_node')]", 10, NO_RETURN),
    ("goal", "active", 18, "`active` never follows the state `configuring`; `inactive` or `unconfigured` follows it"),
    ("goal", "inactiv", 18, "unknown state `inactiv` of a lifecycle node"),
    ("driver", "IfCondition", 19, "this starts a driver of the hardware if `sim` is true; the condition is inverted"),
    (
        "amcl",
        "IfCondition",
        20,
        "both publish the transform from the map frame to the odometry frame if `slam` is true",
    ),
    ("parameters", "'settings'", 29, "is the string `settings`; write the variable `settings` without quotes"),
    ("parameters", "*common, {'use_stampd': True}", 29, "unknown parameter `use_stampd`"),
    ("nodes", "filter", 17, "Node `right` is not added to the launch description"),
    ("end", "", 31, "does not return a LaunchDescription"),
    (
        "arguments",
        "",
        14,
        UNDECLARED,
    ),
    ("driven", "driver()", 31, "`driver` is an action, not a function; write it without parentheses"),
]


@pytest.mark.parametrize(("part", "wrong", "line", "words"), MISTAKES)
def test_a_mistake_in_a_python_launch_file_is_reported_at_its_line(tmp_path, part, wrong, line, words):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "joy", "nav2_amcl", "slam_toolbox", "twist_mux")
    right = {**RIGHT, "opaque": ""} if part == "amcl" else RIGHT
    for values, count in (({**right, part: wrong}, 1), (right, 0)):
        write(cart / "launch/cart.launch.py", LAUNCH.format(**values))
        assert [each.line for each in lint(cart) if words in each.text] == [line] * count


@pytest.mark.parametrize(("name", "count"), [("prot", 1), ("port", 0)])
def test_a_path_behind_a_variable_is_read(tmp_path, name, count):
    cart = package(tmp_path / "cart", "ament_cmake", "robot_state_publisher", "xacro")
    write(cart / "cart.urdf", f'<robot name="cart">\n  <!-- -->{ROBOT_WITH_ARGUMENT}</robot>\n')
    (cart / "cart.urdf").rename(cart / "cart.urdf.xacro")
    value = f"$(command 'xacro $(var share)/cart.urdf.xacro {name}:=/dev/tty')"
    node = '<node pkg="robot_state_publisher" exec="robot_state_publisher"><param name="robot_description"'
    node += f' value="{value}"'
    share = '<let name="share" value="$(find-pkg-share cart)"/>'
    write(cart / "launch/cart.launch.xml", f'<launch>\n{share}\n{node} type="str"/></node>\n</launch>\n')
    assert len(found(cart, "L102")) == count
    write(
        cart / "launch/cart.launch.xml", f'<launch>\n{share}\n<include file="$(var share)/launch/{name}.py"/></launch>'
    )
    write(cart / "launch/port.py", "")
    assert len(found(cart, "K958")) == count


ROBOT_WITH_ARGUMENT = (
    '<xacro:arg xmlns:xacro="http://www.ros.org/wiki/xacro" name="port" default="/dev/ttyACM0"/>'
    '<link name="base"/><ros2_control name="c" type="system"><hardware><plugin>a/B</plugin>'
    '<param name="port">$(arg port)</param></hardware></ros2_control>'
)


ARM = """<robot name="cart">
  <link name="base"/>
  <link name="hand"/>
  <joint name="wrist" type="continuous"><parent link="base"/><child link="hand"/><axis xyz="0 0 1"/></joint>
</robot>
"""
SEMANTICS = """<robot name="cart">
  <group name="arm"><joint name="wrist"/></group>
  <group_state name="ready" group="arm"><joint name="wrist" value="0"/></group_state>
</robot>
"""
PLANNING = """import moveit_commander

arm = moveit_commander.MoveGroupCommander("{group}")
arm.set_end_effector_link("{link}")
arm.remember_joint_values("here")
arm.set_named_target("here")
arm.set_named_target("{state}")
arm.go({{"{joint}": 0.2}}, wait=True)
"""
PLANNING_CPP = """#include <moveit/move_group_interface/move_group_interface.h>
void plan(rclcpp::Node::SharedPtr node) {{
  moveit::planning_interface::MoveGroupInterface arm(node, "{group}");
  arm.setNamedTarget("{state}");
}}
"""
NAMES = {"group": "arm", "link": "hand", "state": "ready", "joint": "wrist"}


@pytest.mark.parametrize(
    ("part", "wrong", "line", "message"),
    [
        ("group", "manipulator", 3, "group `manipulator` does not exist in the SRDF; it has `arm`"),
        ("link", "tool0", 4, "link `tool0` does not exist in robot `cart`; it has `base`, `hand`"),
        ("state", "home", 7, "state of a group `home` does not exist in the SRDF; it has `ready`"),
        ("joint", "wirst", 8, "joint `wirst` does not exist in robot `cart`; did you mean `wrist`?"),
    ],
)
def test_code_names_parts_of_the_moveit_configuration(tmp_path, part, wrong, line, message):
    cart = package(tmp_path / "cart", "ament_cmake")
    write(cart / "cart.urdf", ARM)
    write(cart / "config/cart.srdf", SEMANTICS)
    for values, count in (({**NAMES, part: wrong}, 1), (NAMES, 0)):
        write(cart / "scripts/plan.py", PLANNING.format(**values))
        assert found(cart, "M108") == [("plan.py", line, message)] * count
    write(cart / "src/plan.cpp", PLANNING_CPP.format(**{**NAMES, part: wrong}))
    expected = {"group": [("plan.cpp", 3, message)], "state": [("plan.cpp", 4, message)]}
    assert found(cart, "M108") == expected.get(part, [])


RIGHT_CODE = {
    "scripts/plan.py": """import moveit_commander

arm = moveit_commander.MoveGroupCommander("arm")
arm.remember_joint_values("pre-grasp")
arm.go("pre-grasp", True)
arm.plan("pre-grasp", 0.1)
arm.set_named_target("pre-grasp")
""",
    "src/plan.cpp": """#include <moveit/move_group_interface/move_group_interface.h>
using moveit::planning_interface::MoveGroupInterface;
/* MoveGroupInterface arm(node, "old");
   arm.setNamedTarget("old"); */
void go(MoveGroupInterface& arm, const std::string& state = "home");
MoveGroupInterface make(const rclcpp::Node::SharedPtr& node, const std::string& state = "home");
void plan(rclcpp::Node::SharedPtr node) {
  MoveGroupInterface arm(node, MoveGroupInterface::Options(PLANNING_GROUP, "robot_description", ns));
  MoveGroupInterface::Options options("arm", "robot_description");
  MoveGroupInterface left(node, "left_" + part);
  arm.rememberJointValues("pre-grasp");
  arm.setNamedTarget("pre-grasp");
}
""",
}
CALLS = [
    'MoveGroupInterface arm("arms");',
    'MoveGroupInterface arm{node, "arms"};',
    'MoveGroupInterface arm(shared_from_this(), "arms", buffer);',
    'auto arm = std::make_shared<moveit::planning_interface::MoveGroupInterface>(node, "arms");',
    'MoveGroupInterface arm(node, MoveGroupInterface::Options("arms", "robot_description"));',
    '/* a group */ MoveGroupInterface arm(node, /* its name */ "arms");  // "arm"',
    'log("https://moveit.ai"); MoveGroupInterface arm(node, "arms");',
]


def test_other_strings_of_code_that_plans_are_no_names(tmp_path):
    cart = package(tmp_path / "cart", "ament_cmake")
    for name, text in {"cart.urdf": ARM, "config/cart.srdf": SEMANTICS, **RIGHT_CODE}.items():
        write(cart / name, text)
    assert found(cart, "M108") == []


@pytest.mark.parametrize("call", CALLS)
def test_a_group_is_the_first_argument_or_follows_the_node(tmp_path, call):
    cart = package(tmp_path / "cart", "ament_cmake")
    code = {"src/plan.cpp": f"void plan() {{\n  {call}\n}}\n"}
    for name, text in {"cart.urdf": ARM, "config/cart.srdf": SEMANTICS, **code}.items():
        write(cart / name, text)
    assert found(cart, "M108") == [("plan.cpp", 2, "group `arms` does not exist in the SRDF; did you mean `arm`?")]


COMPONENT = """from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    node = ComposableNode(package="depth_image_proc", plugin="{}")
    return LaunchDescription([ComposableNodeContainer(
        name="c", namespace="", package="rclcpp_components", executable="component_container",
        composable_node_descriptions=[node],
    )])
"""


@pytest.mark.parametrize(
    ("plugin", "hint"),
    [
        ("depth_image_proc::PointCloudXYZNode", "; did you mean `depth_image_proc::PointCloudXyzNode`?"),
        ("depth_image_proc/point_cloud_xyzrgb", "; did you mean `depth_image_proc::PointCloudXyzrgbNode`?"),
        ("depth_image_proc::RegisterNode", None),
        ("depth_image_proc::LabelledCloudsNode", None),
    ],
)
def test_a_component_belongs_to_its_package(tmp_path, plugin, hint):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "depth_image_proc", "rclcpp_components")
    message = f"package `depth_image_proc` has no component `{plugin}`{hint}"
    write(cart / "launch/c.launch.py", COMPONENT.format(plugin))
    assert found(cart, "L103") == ([("c.launch.py", 7, message)] if hint else [])
    node = f'<composable_node pkg="depth_image_proc" plugin="{plugin}" name="p"/>'
    text = f'<launch><load_composable_node target="c">{node}</load_composable_node></launch>'
    write(cart / "launch/c.launch.py", "")
    write(cart / "launch/c.launch.xml", text)
    assert found(cart, "L103") == ([("c.launch.xml", 1, message)] if hint else [])


SECTION = "{}:\n  ros__parameters:\n    {}\n"


@pytest.mark.parametrize(("file", "is_reported"), [("mux", False), ("ekf", True), ("all", False)])
def test_a_node_does_not_load_the_file_of_another_node(tmp_path, file, is_reported):
    cart = package(tmp_path / "cart", "ament_cmake", "twist_mux", "robot_localization")
    write(cart / "config/mux.yaml", SECTION.format("twist_mux", "use_stamped: true"))
    write(cart / "config/ekf.yaml", SECTION.format("ekf_filter_node", "two_d_mode: true"))
    write(cart / "config/all.yaml", SECTION.format("/**", "use_sim_time: true"))
    node = f'<param from="$(find-pkg-share cart)/config/{file}.yaml"/>'
    write(cart / "launch/m.launch.xml", f'<launch>\n<node pkg="twist_mux" exec="twist_mux">\n{node}</node></launch>\n')
    message = "ekf.yaml has no section `twist_mux`; mux.yaml has it"
    assert found(cart, "L117") == ([("m.launch.xml", 3, message)] if is_reported else [])


STOP = """#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("stop")
speed = rospy.get_param("~speed", 0.4)
rospy.Subscriber("command", Twist, print)
publisher = rospy.Publisher("safe", Twist, queue_size=1)
"""
STOPPED = """<launch>
  <arg name="mapping" default="false"/>
  <include file="$(find cart)/launch/map.launch"><arg name="{argument}" value="$(arg mapping)"/></include>
  <node pkg="cart" type="stop.py" name="stop"><param name="speed" value="{speed}"/>
    <remap from="safe" to="{safe}"/></node>
  <param name="robot_description" textfile="$(find cart)/cart.urdf"/>
  <node pkg="cart" type="stop.py" name="second"><remap from="command" to="drive_safe"/></node>
  <node pkg="cart" type="stop.py" name="third"><remap from="safe" to="{drive}/cmd_vel"/></node>
  <node pkg="joint_state_publisher" type="joint_state_publisher" name="j">
    <remap from="robot_description" to="{d}"/></node>
</launch>
"""
MAP = """<launch>
  <arg name="map" default="$(find cart)/map.yaml"/>
  <arg name="mapping" default="false"/>
</launch>
"""
WHEELS = (
    "wheels_controller:\n  type: diff_drive_controller/DiffDriveController\n  left_wheel: [a]\n  right_wheel: [b]\n"
)
VALUES = {
    "argument": "mapping",
    "speed": "0.3",
    "safe": "drive_safe",
    "drive": "wheels_controller",
    "d": "robot_description",
}


@pytest.mark.parametrize(
    ("part", "wrong", "line", "words"),
    [
        ("argument", "map", 3, "launch argument `map` is the path of a file, but this include passes `mapping`"),
        ("speed", "0,3", 4, "`speed` is `0,3`, which is not a number"),
        ("safe", "drive_save", 5, "no other file names the topic `drive_save`; did you mean `drive_safe`?"),
        ("drive", "wheel_controller", 8, "`wheel_controller/cmd_vel`; did you mean `wheels_controller/cmd_vel`?"),
        (
            "d",
            "cart_model",
            10,
            "no other file names `cart_model`, so `joint_state_publisher` receives no description",
        ),
    ],
)
def test_a_mistake_in_a_ros_1_launch_file_is_reported_at_its_line(tmp_path, part, wrong, line, words):
    cart = package(tmp_path / "cart", "catkin", "joint_state_publisher", "rospy", "geometry_msgs")
    write(cart / "scripts/stop.py", STOP)
    write(cart / "launch/map.launch", MAP)
    write(cart / "config/wheels.yaml", WHEELS)
    for values, count in (({**VALUES, part: wrong}, 1), (VALUES, 0)):
        write(cart / "launch/cart.launch", STOPPED.format(**values))
        assert [each.line for each in lint(cart) if words in each.text] == [line] * count


@pytest.mark.parametrize(("world", "count"), [("hospital", 1), ("ward", 0)])
def test_the_world_of_a_spawner_exists(tmp_path, world, count):
    cart = package(tmp_path / "cart", "ament_cmake", "ros_gz_sim")
    write(cart / "worlds/ward.sdf", '<sdf version="1.9"><world name="ward"/></sdf>\n')
    arguments = f"-world {world} -topic robot_description"
    node = f'<node pkg="ros_gz_sim" exec="create" args="{arguments}"/>'
    write(cart / "launch/cart.launch.xml", f"<launch>\n{node}\n</launch>\n")
    assert len(found(cart, "K969")) == count


def test_the_code_is_read_once_for_all_remapped_descriptions(tmp_path, monkeypatch):
    from urdfkit.lint.facts.topics import words

    cart, counts = package(tmp_path / "cart", "ament_cmake", "robot_state_publisher"), []
    reads = list[Path]()
    monkeypatch.setattr(
        words, "code_texts", lambda *given, real=words.code_texts: reads.append(given[0]) or real(*given)
    )
    node = (
        '<node pkg="robot_state_publisher" exec="robot_state_publisher" namespace="r{0}">'
        '<param name="robot_description" value="$(command \'xacro cart.urdf\')"/>'
        '<remap from="robot_description" to="model_{0}"/></node>\n'
    )
    for count in (1, 20):
        reads.clear()
        write(cart / "launch/c.launch.xml", f"<launch>\n{''.join(map(node.format, range(count)))}</launch>\n")
        assert sum("receives no description" in row[2] for row in found(cart, "K980")) == count
        counts.append(len(reads))
    assert counts[0] == counts[1]


SIMULATED = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, RegisterEventHandler
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    gazebo = PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])
    slam = Node(
        package="slam_toolbox", executable="sync_slam_toolbox_node", name="slam",
        parameters=[{"use_sim_time": True}],
        condition=IfCondition(LaunchConfiguration("slam")),
    )
    spawn = Node(package="ros_gz_sim", executable="create", arguments=["-topic", "robot_description"])
    return LaunchDescription([
        DeclareLaunchArgument("slam", default_value="true"),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(gazebo)),
        spawn,
        RegisterEventHandler(OnProcessExit(target_action=spawn, on_exit=[slam])),
    ])
"""


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, []),
        ({"True": "False"}, [16]),
        ({"True": "False", '"slam")': '"use_real_robot")', '"slam",': '"use_real_robot",'}, []),
        ({"OnProcessExit(": "OnProcessStart(", "import OnProcessExit": "import OnProcessStart"}, [24]),
    ],
)
def test_the_clock_and_the_handlers_of_a_conditional_node(tmp_path, changes, expected):
    cart = package(tmp_path / "cart", "ament_cmake", "ros_gz_sim", "slam_toolbox")
    text = SIMULATED
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    write(cart / "launch/cart.launch.py", text)
    assert [line for _, line, _ in found(cart, "L121", "L106", "L105")] == expected


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("", [15]),
        ('condition=IfCondition(LaunchConfiguration("slam"))', []),
        ('ros_arguments=["-p", "use_sim_time:=true"]', []),
        ('arguments=["--ros-args", "-p", "use_sim_time:=true"]', []),
        ('arguments=["--ros-args", "-p", ["slam:use_sim_time:=", LaunchConfiguration("slam")]]', []),
        ('arguments=["--ros-args", "-r", "use_sim_time:=true"]', [15]),
    ],
)
def test_a_node_without_the_clock_next_to_gazebo(tmp_path, condition, expected):
    cart = package(tmp_path / "cart", "ament_cmake", "ros_gz_sim", "slam_toolbox")
    text = SIMULATED.replace(
        'parameters=[{"use_sim_time": True}],', 'parameters=[{"mode": "mapping"}],  # use_sim_time'
    )
    text = text.replace('condition=IfCondition(LaunchConfiguration("slam"))', condition or "output='screen'")
    write(cart / "launch/cart.launch.py", text)
    assert [line for _, line, _ in found(cart, "L121")] == expected
