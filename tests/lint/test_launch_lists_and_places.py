"""Lists of Python launch files with computed parts, and the lines of findings in launch files."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write

MAPS = """
from launch import LaunchDescription
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from ament_index_python.packages import get_package_share_directory
from os.path import join

params = join(get_package_share_directory("cart"), "config", "nav.yaml")


def generate_launch_description():
    def server(package, executable, extra=None):
        return Node(package=package, executable=executable, parameters=[params] + {more})

    return LaunchDescription([server("nav2_map_server", "map_server", {{"{name}": "hall.yaml"}})])
"""


@pytest.mark.parametrize(
    ("more", "name", "is_reported"),
    [
        ("([extra] if extra else [])", "yaml_filename", False),
        ("([extra] if extra else [])", "frame_id", True),
        ("([extra] if environ else [])", "frame_id", False),
        ("more(extra)", "frame_id", False),
    ],
)
def test_parameters_in_a_sum_of_lists_are_parameters_of_the_node(tmp_path, more, name, is_reported):
    cart = package(tmp_path / "cart", "ament_cmake", "nav2_map_server", "launch_ros")
    write(cart / "config/nav.yaml", "map_server:\n  ros__parameters:\n    topic_name: map\n")
    write(cart / "launch/m.launch.py", MAPS.format(more=more, name=name))
    message = "`map_server` needs the parameter `yaml_filename`"
    assert [text for _, _, text in found(cart, "L126")] == ([message] if is_reported else [])


FORMAT = """
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([IncludeLaunchDescription(
        PythonLaunchDescriptionSource(PathJoinSubstitution([FindPackageShare("cart"), "launch", "{}"])))])
"""


@pytest.mark.parametrize("name", ["lift.launch.xml", "lift.launch.py"])
def test_the_last_part_of_a_joined_path_decides_the_format(tmp_path, name):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros")
    write(cart / "launch/m.launch.py", FORMAT.format(name))
    write(cart / "launch/lift.launch.xml", "<launch/>")
    write(cart / "launch/lift.launch.py", "from launch import LaunchDescription\n")
    message = "`PythonLaunchDescriptionSource` cannot load `lift.launch.xml`, which has another format"
    lines = [(line, text.partition(";")[0]) for _, line, text in found(cart, "L106")]
    assert lines == ([(11, message)] if name.endswith("xml") else [])


SERVERS = """
from launch import LaunchDescription
from launch_ros.actions import Node

NODES = [
    "map_server",
    "amcl",
]


def server(package, executable):
    return Node(package=package, executable=executable,
                name="{prefix}" + executable, parameters=[{{"frame_id": "map"}}, "params"])


def generate_launch_description():
    manager = Node(package="nav2_lifecycle_manager", executable="lifecycle_manager",
                   parameters=[{{"node_names": NODES}}])
    mapping = server("nav2_map_server", "map_server")
    planner = server("nav2_planner", "planner_server")
    return LaunchDescription([
        mapping,
        {planner}
        server("nav2_amcl", "amcl"),
        manager,
    ])
"""


@pytest.mark.parametrize(
    ("planner", "expected"),
    [
        ("planner,", [("L117", 6)]),  # after map_server
        ("", [("L107", 22), ("L117", 6)]),
    ],
)
def test_what_a_list_lacks_is_reported_where_it_is_to_be_added(tmp_path, planner, expected):
    needed = ("nav2_map_server", "nav2_amcl", "nav2_planner", "nav2_lifecycle_manager", "launch_ros")
    cart = package(tmp_path / "cart", "ament_cmake", *needed)
    write(cart / "launch/n.launch.py", SERVERS.format(prefix="", planner=planner))
    lines = [(code, line) for code in ("L107", "L117") for _, line, _ in found(cart, code)]
    assert lines == expected


BRIDGE = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="ros_gz_bridge", executable="parameter_bridge",
             parameters=[{{
                 "use_sim_time": True,
                 "{name}": "bridge.yaml",
             }}]),
        Node(package="controller_manager", executable="ros2_control_node",
             parameters=[
                 {{"robot_description": "x"}}]),
    ])
"""


def test_lines_of_nodes_without_parameters(tmp_path):
    needed = ("ros_gz_bridge", "controller_manager", "launch_ros")
    cart = package(tmp_path / "cart", "ament_cmake", *needed)
    write(cart / "launch/n.launch.py", BRIDGE.format(name="bridge_file_of_topics"))
    assert [(code, line) for code in ("L112", "L126") for _, line, _ in found(cart, code)] == [
        ("L112", 15),
        ("L126", 11),
    ]


MOVE_GROUP = """<launch>
  <node name="move_group" pkg="moveit_ros_move_group" type="move_group"/>
  <group ns="{}">
    <group ns="planning_pipelines/ompl">
      <param name="planning_plugin" value="ompl_interface/OMPLPlanner"/>
    </group>
  </group>
</launch>
"""


@pytest.mark.parametrize("space", ["move_group", "moveit"])
def test_move_group_reads_pipelines_from_its_own_namespace(tmp_path, space):
    cart = package(tmp_path / "cart", "catkin", "moveit_ros_move_group")
    write(cart / "launch/m.launch", MOVE_GROUP.format(space))
    message = "node `move_group` reads planning pipelines from its own namespace; did you mean `move_group`?"
    assert [row[1:] for row in found(cart, "L110")] == ([(3, message)] if space == "moveit" else [])


@pytest.mark.parametrize(
    ("space", "pipelines", "count"),
    [("move_group/ompl", True, 1), ("move_group/planning_pipelines/ompl", True, 0), ("move_group", False, 0)],
)
def test_included_pipelines_are_in_the_namespace_of_move_group(tmp_path, space, pipelines, count):
    cart = package(tmp_path / "cart", "catkin", "moveit_ros_move_group")
    plugin = '<launch><param name="planning_plugin" value="ompl_interface/OMPLPlanner"/></launch>\n'
    write(cart / "launch/ompl.launch.xml", plugin)
    names = '<rosparam param="planning_pipelines">["ompl"]</rosparam>' if pipelines else ""
    node = f'<node name="move_group" pkg="moveit_ros_move_group" type="move_group">{names}</node>'
    include = f'<include ns="{space}" file="$(find cart)/launch/ompl.launch.xml"/>'
    write(cart / "launch/m.launch", f"<launch>\n{include}\n{node}\n</launch>\n")
    message = "node `move_group` reads its planning pipelines from `move_group/planning_pipelines`"
    assert [row[1:] for row in found(cart, "L110")] == [(2, message)] * count


def test_a_misspelt_namespace_of_planning_pipelines(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "moveit_ros_move_group")
    write(cart / "launch/m.launch", MOVE_GROUP.format("move_group").replace("planning_pipelines", "planning_pipeline"))
    [(_, line, message)] = found(cart, "L110")
    assert line == 4
    assert message.startswith("move_group reads its pipelines from `planning_pipelines`")


FILTER = '<node pkg="robot_localization" exec="ekf_node"/>'
VIRTUAL = (
    '<robot name="cart"><group name="all"><link name="base"/></group>'
    '<virtual_joint name="v" type="planar" parent_frame="odom" child_link="base"/></robot>'
)


@pytest.mark.parametrize(
    ("frames", "other", "semantics", "is_swapped"),
    [
        ("map base", FILTER, "", False),
        ("base map", FILTER, "", True),
        ("base map", "", VIRTUAL, True),
        ("base map", "", "", False),
        ("base map", f"<!-- {FILTER} -->", "", False),
        ("base camera", FILTER, "", False),
    ],
)
def test_a_map_is_not_below_the_root_of_a_robot_that_something_else_places(
    tmp_path, frames, other, semantics, is_swapped
):
    cart = package(tmp_path / "cart", "ament_cmake", "tf2_ros")
    if semantics:
        write(cart / "config/cart.srdf", semantics)
    parent, child = frames.split()
    arguments = f"--x 1 --frame-id {parent} --child-frame-id {child}"
    node = f'<node pkg="tf2_ros" exec="static_transform_publisher" args="{arguments}"/>'
    write(cart / "launch/m.launch.xml", f"<launch>\n{node}\n{other}\n</launch>\n")
    message = "`map` cannot be below `base`, the root of robot `cart`; swap the frames"
    assert [row[2] for row in found(cart, "L118")] == ([message] if is_swapped else [])
