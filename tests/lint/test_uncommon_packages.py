"""Packages that do what most do in another way, next to those with a mistake."""

import pytest

from tests.lint.test_build_files import write
from urdfkit.lint import lint

ROBOT = '<robot name="cart"><link name="base"/></robot>'
MANIFEST = (
    "<package><name>cart</name><version>1.0.0</version><buildtool_depend>ament_cmake</buildtool_depend></package>"
)


def found(folder, code, **files):
    names = {
        "robot": "cart.urdf",
        "manifest": "package.xml",
        "start": "launch/start.launch.py",
        "yaml": "config/a.yaml",
    }
    names |= {"other": "launch/other.launch.py"}
    written = {names[key]: text for key, text in ({"robot": ROBOT, "manifest": MANIFEST} | files).items()}
    write(folder, written)
    return [each.message for each in lint(folder / "cart.urdf") if each.code == code]


def launch(imports, *actions):
    lines = "".join(f"        {action},\n" for action in actions)
    text = "from launch import LaunchDescription\nfrom launch.actions import *\nfrom launch.substitutions import *\n"
    text = text.replace("*", "DeclareLaunchArgument, ExecuteProcess, SetEnvironmentVariable", 1)
    text = text.replace("*", "LaunchConfiguration") + f"from launch_ros.actions import Node\n{imports}\n\n\n"
    text += "def generate_launch_description():\n    port = LaunchConfiguration('port')\n"
    return f"{text}    return LaunchDescription([\n{lines}    ])\n"


DECLARED = "DeclareLaunchArgument('port', default_value='/dev/ttyUSB0')"


@pytest.mark.parametrize(
    ("imports", "action", "count"),
    [
        ("", "Node(package='joy', executable='joy_node')", 1),
        ("from os.path import join", "Node(package='joy', executable=join('joy_node'))", 1),
        ("from cart.nodes import drivers", "*drivers()", 0),
        ("import cart.nodes", "*cart.nodes.drivers()", 0),
    ],
)
def test_arguments_that_functions_of_other_modules_may_read(tmp_path, imports, action, count):
    assert len(found(tmp_path, "L107", start=launch(imports, DECLARED, action))) == count


SET = "SetEnvironmentVariable('GAZEBO_MODEL_PATH', '/opt/models')"


@pytest.mark.parametrize(
    ("package", "process", "messages"),
    [
        ("ros_gz_sim", "gz", ["did you mean `GZ_SIM_RESOURCE_PATH`?"]),
        ("ros_ign_gazebo", "ign", ["did you mean `IGN_GAZEBO_RESOURCE_PATH`?"]),
        ("ros_gz_sim", "gzserver", []),
    ],
)
def test_variables_of_gazebo(tmp_path, package, process, messages):
    start = launch("", SET, f"ExecuteProcess(cmd=['{process}', '-v'])")
    other = launch("", f"Node(package='{package}', executable='create')")
    texts = found(tmp_path, "L104", start=start, other=other)
    assert [text.partition("; ")[2] for text in texts] == messages


BRIDGE = """- ros_topic_name: battery
  gz_topic_name: /model/{}/odometry
  ros_type_name: nav_msgs/msg/Odometry
  gz_type_name: gz.msgs.Odometry
  direction: GZ_TO_ROS
"""
CREATE = "Node(package='ros_gz_sim', executable='create', arguments=['-name', 'rover'])"


@pytest.mark.parametrize(
    ("used", "other", "count"),
    [
        ("rover_dock", "", 1),  # nothing else spawns it
        ("rover_dock", "Node(package='ros_gz_sim', executable='create', parameters=[{'name': 'rover_dock'}])", 0),
        ("rover_dock", "DeclareLaunchArgument('dock', description='/model/rover/')", 0),  # a second model
        ("rovre", "DeclareLaunchArgument('dock', description='/model/rover/odometry')", 1),
    ],
)
def test_names_of_models(tmp_path, used, other, count):
    text = BRIDGE.format(used) + (BRIDGE.format("rover") if "/model/" in other else "")
    start = launch("", CREATE, *filter(None, [other]))
    assert len(found(tmp_path, "K969", start=start, yaml=text)) == count


COSTMAP = """global_costmap:
  global_costmap:
    ros__parameters:
      global_frame: map
      robot_base_frame: base
      plugins: [static_layer, {}, inflation_layer]
      static_layer:
        plugin: nav2_costmap_2d::StaticLayer
      {}:
        plugin: nav2_costmap_2d::StaticLayer
        map_topic: {}
        map_subscribe_transient_local: false
      inflation_layer:
        plugin: nav2_costmap_2d::InflationLayer
"""


@pytest.mark.parametrize(("topic", "count"), [("/octomap", 0), ("/map", 1), ("map", 1)])
def test_a_second_map(tmp_path, topic, count):
    start = launch("", "Node(package='nav2_map_server', executable='map_server')")
    messages = found(tmp_path, "K982", start=start, yaml=COSTMAP.format("live", "live", topic))
    assert len(messages) == count
    assert all("before this layer subscribes" in message for message in messages)


FILTER = """ekf:
  ros__parameters:
    frequency: 30.0
    map_frame: map
    odom_frame: odom
    base_link_frame: base
    world_frame: map
    publish_tf: {}
    twist0: dvl
    twist0_config: [false, false, false, false, false, false, true, true, true, {}]
"""


@pytest.mark.parametrize(("publishes", "count"), [("true", 1), ("false", 0)])
def test_a_filter_of_velocities_that_publishes_no_transform(tmp_path, publishes, count):
    text = FILTER.format(publishes, ", ".join(["false"] * 6))
    assert sum("no input measures x and y" in each for each in found(tmp_path, "K983", yaml=text)) == count


RAY = """<robot name="cart"><link name="base"/><gazebo reference="base"><sensor name="scan" type="ray">
<plugin name="scan" filename="libgazebo_ros_ray_sensor.so"><ros><remapping>{}:=scan</remapping></ros></plugin>
</sensor></gazebo></robot>"""


@pytest.mark.parametrize(("old", "count"), [("~/out", 0), ("__node", 0), ("__ns", 0), ("laser", 1)])
def test_remappings_of_sensors(tmp_path, old, count):
    assert sum("has no topic" in each for each in found(tmp_path, "Z832", robot=RAY.format(old))) == count


SETUP = """import os
from glob import glob

from setuptools import setup

setup(
    name="cart",
    version="1.0.0",
    packages=["cart"],
    data_files=[
        ("share/cart", ["package.xml"]),
        (os.path.join("share", "cart", "{}", "dock"), glob("assets/dock/*")),
    ],
)
"""


@pytest.mark.parametrize(("folder", "count"), [("models", 0), ("models_old", 1)])
def test_folders_that_setup_installs_under_another_name(tmp_path, folder, count):
    export = '<export><build_type>ament_python</build_type><gazebo_ros gazebo_model_path="${prefix}/models"/></export>'
    people = '<description>Cart</description><maintainer email="a@b.org">A</maintainer><license>MIT</license>'
    text = MANIFEST.replace("<buildtool_depend>ament_cmake</buildtool_depend>", people + export)
    write(tmp_path, {"setup.py": SETUP.format(folder), "cart/__init__.py": "", "assets/dock/model.sdf": "<sdf/>"})
    assert sum("of gazebo_model_path" in each for each in found(tmp_path, "K972", manifest=text)) == count


DRIVE = """controller_manager:
  ros__parameters:
    base:
      type: diff_drive_controller/DiffDriveController
base:
  ros__parameters:
    left_wheel_names: [left]
    right_wheel_names: [right]
    wheel_separation: 0.4
    wheel_radius: 0.1
"""


def test_the_place_of_commands_that_no_drive_reads(tmp_path):
    """A remapping of another topic is not to blame."""
    node = "Node(package='teleop_twist_joy', executable='teleop_node', remappings=[('joy', 'pad')])"
    start = launch("", node)
    write(tmp_path, {"cart.urdf": ROBOT, "package.xml": MANIFEST, "config/a.yaml": DRIVE, "launch/s.launch.py": start})
    [each] = [each for each in lint(tmp_path / "cart.urdf") if "no node subscribes to the velocity" in each.message]
    assert start.splitlines()[each.line - 1][each.column - 1 :].startswith("'teleop_node'")


SERVERS = """Node(package='nav2_controller', executable='controller_server', name='controller_server'{}),
        Node(package='nav2_behaviors', executable='behavior_server', name='behavior_server'{}),
        Node(package='nav2_velocity_smoother', executable='velocity_smoother', name='velocity_smoother'{}),
        Node(package='nav2_lifecycle_manager', executable='lifecycle_manager', name='manager',
             parameters=[{{'autostart': True, 'node_names': {}}}])"""
NAMES = "['controller_server', 'behavior_server', 'velocity_smoother']"
TO_SMOOTHER = ", remappings=[('cmd_vel', 'cmd_vel_nav')]"


@pytest.mark.parametrize(
    ("first", "names", "count"),
    [
        ('"""Nav2 without nav2_bringup."""\n', NAMES, 0),
        ('"""Nav2 without nav2_bringup."""\n', NAMES.replace("'behavior_server', ", ""), 1),
        ('SHARE = "nav2_bringup"\n', NAMES.replace("'behavior_server', ", ""), 0),  # its launch files may list it
    ],
)
def test_servers_that_no_list_contains(tmp_path, first, names, count):
    start = first + launch("", SERVERS.format(TO_SMOOTHER, TO_SMOOTHER, TO_SMOOTHER, names))
    assert sum("never activated" in each for each in found(tmp_path, "L117", start=start)) == count


@pytest.mark.parametrize(
    ("controller", "behaviors", "smoother", "count"),
    [
        (TO_SMOOTHER, TO_SMOOTHER, TO_SMOOTHER, 0),
        (TO_SMOOTHER, "", TO_SMOOTHER, 0),  # as in nav2_bringup of Humble
        ("", TO_SMOOTHER, TO_SMOOTHER, 1),
        ("", "", "", 0),
        (", remappings=rules", TO_SMOOTHER, TO_SMOOTHER, 0),
    ],
)
def test_a_controller_that_publishes_past_the_smoother(tmp_path, controller, behaviors, smoother, count):
    start = launch("", SERVERS.format(controller, behaviors, smoother, NAMES))
    assert sum("past `velocity_smoother`" in each for each in found(tmp_path, "K980", start=start)) == count


COMMAND = '<launch><param name="robot_description" command="{} $(find cart)/cart.urdf"/></launch>'


@pytest.mark.parametrize(
    ("program", "version", "count"),
    [
        ("$(find xacro)/xacro.py", "3.0.2", 1),
        ("rosrun xacro xacro.py", "3.0.2", 1),
        ("$(find xacro)/xacro", "3.0.2", 0),
        ("$(find xacro)/xacro.py", "2.8.3", 0),  # Melodic and before
        ("$(find cart)/xacro.py", "3.0.2", 0),
    ],
)
def test_programs_that_noetic_has_no_longer(tmp_path, program, version, count):
    text = (
        f"cmake_minimum_required(VERSION {version})\nproject(cart)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    )
    write(tmp_path, {"launch/start.launch": COMMAND.format(program), "CMakeLists.txt": text})
    messages = found(tmp_path, "L103", manifest=MANIFEST.replace("ament_cmake", "catkin"))
    assert sum("in Noetic" in message for message in messages) == count


def arm(prefix):
    """Return the links and joints of an arm in a frame `world`."""
    parents = ["world", *(f"{prefix}l{k}" for k in (1, 2))]
    return "".join(
        f'<link name="{prefix}l{k}"/><joint name="{prefix}joint_{k}" type="revolute"><parent link="{parent}"/>'
        f'<child link="{prefix}l{k}"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for k, parent in enumerate(parents, 1)
    )


OTHER = f"""<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="world"/>
<xacro:macro name="arm" params="prefix">{arm("${prefix}")}</xacro:macro>
</robot>
"""
STATE = '<robot name="cart"><group name="arm"><chain base_link="world" tip_link="arm_l3"/></group>\n{}</robot>'


@pytest.mark.parametrize(
    ("joints", "count"),
    [
        (("arm_joint_1", "arm_joint_2", "arm_joint_3"), 0),
        (("joint_1", "arm_joint_2", "arm_joint_3"), 1),
        (("joint_1", "joint_2", "joint_3"), 0),  # of the arm that the macro makes without a prefix
    ],
)
def test_names_without_the_prefix_of_all_others(tmp_path, joints, count):
    values = "".join(f'<joint name="{joint}" value="0"/>' for joint in joints)
    state = f'<group_state name="home" group="arm">{values}</group_state>'
    write(tmp_path, {"arm.urdf.xacro": OTHER, "cart.srdf": STATE.format(state)})
    robot = f'<robot name="cart"><link name="world"/>{arm("arm_")}</robot>'
    assert sum("does not exist in robot" in each for each in found(tmp_path, "M104", robot=robot)) == count


@pytest.mark.parametrize(
    ("installed", "count"),
    [
        ("PROGRAMS scripts/detector.py", 1),  # a script with the name of the missing file
        ("FILES generated/detector.yaml", 0),
        ("PROGRAMS scripts/${detector}", 0),
    ],
)
def test_a_missing_file_with_the_name_of_a_script(tmp_path, installed, count):
    text = f"project(cart)\nfind_package(ament_cmake REQUIRED)\ninstall({installed} DESTINATION lib/cart)\n"
    files = {"scripts/detector.py": "", "config/eggs.yaml": "a: 1\n", "CMakeLists.txt": text + "ament_package()\n"}
    path = '<param from="$(find-pkg-share cart)/config/detector.yaml"/>'
    start = f'<launch><node pkg="joy" exec="joy_node">{path}</node></launch>'
    write(tmp_path, files | {"launch/start.launch.xml": start})
    assert sum("does not exist in package" in each for each in found(tmp_path, "K958")) == count


BRUSH = """controller_manager:
  ros__parameters:
    brush_controller:
      type: {}
brush_controller:
  ros__parameters:
    joints: [brush]
"""


@pytest.mark.parametrize(
    ("kind", "new", "count"),
    [
        ("forward_command_controller/ForwardCommandController", "brush_controller/commands", 0),
        ("forward_command_controller/ForwardCommandController", "/brush_controller/command", 1),
        ("forward_command_controller/ForwardCommandController", "other_controller/command", 0),
        ("joint_trajectory_controller/JointTrajectoryController", "brush_controller/commands", 1),
        ("own_controllers/BrushController", "brush_controller/command", 0),
    ],
)
def test_remappings_to_topics_of_controllers(tmp_path, kind, new, count):
    start = launch("", f"Node(package='cart', executable='brush', remappings=[('out', '{new}')])")
    messages = found(tmp_path, "K980", start=start, yaml=BRUSH.format(kind))
    assert sum("has no topic or action" in message for message in messages) == count


SPACED = """<launch><node pkg="joy" exec="joy_node" namespace="pad"/>
<node pkg="robot_localization" exec="ekf_node" name="ekf"><param from="$(find-pkg-share cart)/config/b.yaml"/></node>
</launch>"""


@pytest.mark.parametrize(("topic", "count"), [("/odom", 1), ("odom", 0), ("/base/odom", 0)])
def test_absolute_names_beside_nodes_in_namespaces(tmp_path, topic, count):
    """A namespace may complete the relative name `odom`, but not `/odom`."""
    text = FILTER.format("true", ", ".join(["false"] * 6)).replace("twist0", "odom0").replace("dvl", topic)
    write(tmp_path, {"config/b.yaml": text, "launch/start.launch.xml": SPACED})
    assert len(found(tmp_path, "K977", yaml=DRIVE)) == count
