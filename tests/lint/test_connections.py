"""Nodes of a launch that do not reach each other: other controller managers, namespaces and parameter sections."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>cart</name><version>1.0.0</version><description>A cart.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend><exec_depend>controller_manager</exec_depend>
  <exec_depend>robot_state_publisher</exec_depend><exec_depend>ros_gz_sim</exec_depend>
  <export><build_type>ament_cmake</build_type></export></package>
"""
ROBOT = '<robot name="cart"><link name="base"/></robot>\n'
CONTROLLERS = """MANAGER:
  ros__parameters:
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
"""
PYTHON = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, ThisLaunchFileDir
from launch_ros.actions import Node, PushRosNamespace
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    controllers = PathJoinSubstitution([FindPackageShare("cart"), "config", "controllers.yaml"])
"""
BASE = (
    PYTHON
    + """    argument = DeclareLaunchArgument("namespace", default_value="/")
    name = DeclareLaunchArgument("manager", default_value="/controller_manager")
    space = LaunchConfiguration("namespace")
    manager = Node(
        package="controller_manager", executable="ros2_control_node", namespace=space, parameters=[controllers]
    )
    state = Node(package="robot_state_publisher", executable="robot_state_publisher", namespace=space)
    spawner = Node(
        package="controller_manager",
        executable="spawner",
        namespace=space,
        arguments=["joint_state_broadcaster", "-c", LaunchConfiguration("manager")],
    )
    return LaunchDescription([argument, name, manager, state, spawner])
"""
)
BOTH = (
    PYTHON
    + """    return LaunchDescription([
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource([ThisLaunchFileDir(), "/base.launch.py"]),
            launch_arguments={"namespace": "left", "manager": "/left/controller_manager"}.items(),
        ),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource([ThisLaunchFileDir(), "/base.launch.py"]),
            launch_arguments={"namespace": "right", "manager": "/right/controller_manager"}.items(),
        ),
        Node(
            package="controller_manager",
            executable="spawner",
            arguments=["joint_state_broadcaster", "-c", "/left/controller_manager", "--inactive"],
        ),
    ])
"""
)
GROUP = (
    PYTHON
    + """    manager = Node(package="controller_manager", executable="ros2_control_node", parameters=[controllers])
    state = Node(package="robot_state_publisher", executable="robot_state_publisher")
    spawner = Node(
        package="controller_manager",
        executable="spawner",
        arguments=["joint_state_broadcaster"],
    )
    create = Node(package="ros_gz_sim", executable="create", arguments=["-topic", "robot_description"])
    return LaunchDescription([GroupAction([PushRosNamespace("cart"), manager, state, spawner, create])])
"""
)
XML = """<launch>
  <group>
    <push_ros_namespace namespace="cart"/>
    <node pkg="controller_manager" exec="ros2_control_node">
      <param from="$(find-pkg-share cart)/config/controllers.yaml"/>
    </node>
    <node pkg="robot_state_publisher" exec="robot_state_publisher"/>
    <node pkg="controller_manager" exec="spawner" args="joint_state_broadcaster -c /cart/controller_manager"/>
    <node pkg="ros_gz_sim" exec="create" args="-topic /cart/robot_description"/>
  </group>
</launch>
"""
FILES = {
    "launch/base.launch.py": BASE,
    "launch/both.launch.py": BOTH,
    "launch/group.launch.py": GROUP,
    "launch/group.launch.xml": XML,
}


def found(folder: Path, section: str, files: dict[str, str]) -> list[tuple[str, str, str]]:
    """Return the file, code and message of the findings on connections, for some files of a package."""
    controllers = CONTROLLERS.replace("MANAGER", section)
    own = {"package.xml": MANIFEST, "cart.urdf": ROBOT, "config/controllers.yaml": controllers}
    for name, text in (own | files).items():
        (folder / "cart" / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / "cart" / name).write_text(text)
    codes = ("K968", "K980", "L117")
    return [(Path(each.file).name, each.code, each.message) for each in lint(folder / "cart") if each.code in codes]


@pytest.mark.parametrize("names", [["base", "both"], ["group.launch.py"], ["group.launch.xml"]])
@pytest.mark.parametrize("section", ["/**", "/**/controller_manager"])
def test_robots_in_namespaces_are_connected(tmp_path, names, section):
    files = {name: text for name, text in FILES.items() if any(part in name for part in names)}
    assert found(tmp_path, section, files) == []


OTHER = "no controller manager is called `/arm/controller_manager`; did you mean `/cart/controller_manager`?"
MOVED = "this controller manager is called `/arm/controller_manager`, but all spawners name `/cart/controller_manager`"
MISTAKES = [
    ("group.launch.py", 'broadcaster"]', 'broadcaster", "-c", "/arm/controller_manager"]', OTHER),
    ("group.launch.py", 'executable="ros2_control_node"', 'executable="ros2_control_node", namespace="/arm"', MOVED),
    ("group.launch.py", '"robot_description"]', '"/robot_description"]', "`create` subscribes to `/robot_description`"),
    ("group.launch.xml", "-c /cart/", "-c /arm/", OTHER),
    ("group.launch.xml", "-topic /cart/", "-topic /", "`create` subscribes to `/robot_description`"),
    ("both.launch.py", '"/right/controller_manager"', '"/rigth/controller_manager"', "`/right/controller_manager`?"),
    ("both.launch.py", '"-c", "/left/', '"-c", "/', "no controller manager is called `/controller_manager`"),
]


@pytest.mark.parametrize(("file", "old", "new", "message"), MISTAKES)
def test_a_node_in_another_namespace_has_one_finding(tmp_path, file, old, new, message):
    files = {name: text for name, text in FILES.items() if file[:4] in name or (file[:4] == "both" and "base" in name)}
    files = {name: text for name, text in files.items() if name.endswith(file[-3:])}
    text = files[f"launch/{file}"]
    assert old in text
    findings = found(tmp_path, "/**", files | {f"launch/{file}": text.replace(old, new, 1)})
    assert len(findings) == 1, findings
    assert message in findings[0][2]


@pytest.mark.parametrize(
    ("section", "file"), [("controller_manager", "group.launch.xml"), ("/arm/controller_manager", "controllers.yaml")]
)
def test_a_section_in_another_namespace_is_found(tmp_path, section, file):
    findings = found(tmp_path, section, {"launch/group.launch.xml": XML})
    message = (
        f"node `/cart/controller_manager` has no section in controllers.yaml; it has a section `/{section.strip('/')}`"
    )
    assert [each[1:] for each in findings] == [("L117", message)]
