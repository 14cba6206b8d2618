"""Launch files of several packages: which files a finding takes into account."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="2">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>A package for tests.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <exec_depend>{needed}</exec_depend>
</package>
"""
SPAWN = '<launch>\n  <node name="s" pkg="controller_manager" type="spawner" args="drive_controller"/>\n</launch>\n'
LOAD = '<launch>\n  <rosparam command="load" file="$(find cart_description)/config/control.yaml"/>\n</launch>\n'
GAZEBO = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"/>
  <node name="s" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model cart"/>
</launch>
"""


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A package with a robot and its controllers."""
    package = tmp_path / "cart_description"
    write(package / "package.xml", MANIFEST.format(name=package.name, needed="controller_manager"))
    write(package / "cart.urdf", '<robot name="cart">\n  <link name="base"/>\n</robot>\n')
    write(package / "config/control.yaml", "drive_controller:\n  type: diff_drive_controller/DiffDriveController\n")
    return tmp_path


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def codes(folder: Path) -> set[str]:
    here = Path.cwd()
    os.chdir(folder)
    try:
        return {finding.code for finding in lint("cart_description/cart.urdf")}
    finally:
        os.chdir(here)


def test_parameters_are_missing_unless_an_unrelated_launch_file_loads_them(source):
    write(source / "cart_description/launch/spawn.launch", SPAWN)
    assert "L112" in codes(source)
    write(source / "bringup/package.xml", MANIFEST.format(name="bringup", needed="rviz"))
    write(source / "bringup/launch/all.launch", LOAD)
    assert "L112" not in codes(source)


def test_a_description_is_missing_unless_an_including_launch_file_sets_it(source):
    write(source / "cart_description/launch/gazebo.launch", GAZEBO)
    assert "L113" in codes(source)
    including = '<launch>\n  <param name="robot_description" textfile="$(find cart_description)/cart.urdf"/>\n'
    including += '  <include file="$(find cart_description)/launch/gazebo.launch"/>\n</launch>\n'
    write(source / "cart_description/launch/all.launch", including)
    assert "L113" not in codes(source)


@pytest.mark.parametrize("tools", ["catkin", "ament_cmake", "catkin ament_cmake"])
def test_the_build_tool_decides_which_ros_reads_a_launch_file(source, tools):
    tags = "".join(f"  <buildtool_depend>{tool}</buildtool_depend>\n" for tool in tools.split())
    manifest = MANIFEST.replace("  <buildtool_depend>catkin</buildtool_depend>\n", tags)
    write(source / "cart_description/package.xml", manifest.format(name="cart_description", needed="rviz"))
    text = (
        '<launch>\n  <arg name="a" default="1"/>\n  <node name="r" pkg="rviz" {}="rviz" args="$({} a)"/>\n</launch>\n'
    )
    write(source / "cart_description/launch/one.launch", text.format("type", "arg"))
    assert ("L109" in codes(source)) is (tools == "ament_cmake")
    write(source / "cart_description/launch/one.launch", text.format("exec", "var"))
    assert ("L109" in codes(source)) is (tools == "catkin")


ROS2 = MANIFEST.replace("catkin", "ament_cmake").replace('format="2"', 'format="3"')
CLASS_OF_ARGUMENTS = """from dataclasses import dataclass

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_pal.arg_utils import LaunchArgumentsBase
from launch_pal.robot_arguments import CommonArgs


@dataclass(frozen=True)
class LaunchArguments(LaunchArgumentsBase):
    world: DeclareLaunchArgument = CommonArgs.world
    model: DeclareLaunchArgument = DeclareLaunchArgument("model", default_value="cart")


def generate_launch_description():
    launch = LaunchDescription()
    LaunchArguments().add_to_launch_description(launch)
    unused = DeclareLaunchArgument("gui", default_value="true")
    gui = IfCondition(LaunchConfiguration("world"))
    launch.add_action(Node(package="rviz2", executable="rviz2", condition=gui))
    return launch
"""


def findings(folder: Path) -> list[str]:
    here = Path.cwd()
    os.chdir(folder)
    try:
        found = lint("cart_description/cart.urdf")
    finally:
        os.chdir(here)
    return [f"{finding.code} {finding.severity} {finding.message}" for finding in found]


def ros2_package(source: Path, needed: str, comment: str = "") -> Path:
    package = source / "cart_description"
    write(package / "package.xml", ROS2.format(name=package.name, needed=needed).replace("</package>", comment))
    with (package / "package.xml").open("a") as file:
        file.write("</package>\n" if comment else "")
    (package / "config/control.yaml").unlink()
    return package


def test_attributes_of_a_class_of_arguments_are_used_and_its_bases_can_declare_more(source):
    package = ros2_package(source, "rviz2")
    write(package / "launch/class.launch.py", CLASS_OF_ARGUMENTS)
    found = [text for text in findings(source) if text[:4] in ("L101", "L107")]
    assert len(found) == 1
    assert found[0].startswith("L107 warning DeclareLaunchArgument `unused` is not added to the launch description")
    # Without the class, the arguments are known.
    start, end = CLASS_OF_ARGUMENTS.index("from launch_pal"), CLASS_OF_ARGUMENTS.index("def generate")
    known = CLASS_OF_ARGUMENTS[:start] + CLASS_OF_ARGUMENTS[end:]
    write(
        package / "launch/class.launch.py",
        known.replace("    LaunchArguments().add_to_launch_description(launch)\n", ""),
    )
    assert "L101 error launch argument `world` is not declared" in findings(source)


def test_modules_of_other_packages_can_declare_arguments(source):
    package = ros2_package(source, "rviz2")
    text = (
        "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument, LogInfo\n"
        "from launch.substitutions import LaunchConfiguration\n{}\n\ndef generate_launch_description():\n"
        '    gui = DeclareLaunchArgument("gui", default_value="true")\n'
        '    return LaunchDescription([gui, {}LogInfo(msg=LaunchConfiguration("world"))])\n'
    )
    write(package / "launch/a.launch.py", text.format("from cart_bringup.arguments import common", "*common(), "))
    assert not [found for found in findings(source) if found.startswith("L101")]
    write(package / "launch/a.launch.py", text.format("from os import environ", "*environ, "))
    assert [found for found in findings(source) if found.startswith("L101")]


@pytest.mark.parametrize(
    ("needed", "package", "is_missing"),
    [
        ("navigation2", "nav2_map_server", False),
        ("navigation2", "nav2_bringup", True),
        ("ros2_control", "controller_manager", False),
        ("ros2_control", "joint_state_broadcaster", True),
        ("moveit", "moveit_ros_move_group", False),
        ("moveit", "moveit_servo", True),
        ("ros2_controllers", "joint_state_broadcaster", False),
        ("ros2_controllers", "cart_controllers", True),
    ],
)
def test_metapackages_stand_for_the_packages_that_they_depend_on(source, needed, package, is_missing):
    folder = ros2_package(source, needed)
    write(folder / "launch/one.launch.xml", f'<launch>\n  <node pkg="{package}" exec="node"/>\n</launch>\n')
    assert (f"K956 warning missing dependency on `{package}`" in findings(source)) is is_missing


def test_a_dependency_that_package_xml_has_in_a_comment_is_disabled_on_purpose(source):
    folder = ros2_package(source, "rviz2", "  <!-- not released: <exec_depend>rviz_extras</exec_depend> -->\n")
    write(folder / "launch/one.launch.xml", '<launch>\n  <node pkg="rviz_extras" exec="node"/>\n</launch>\n')
    assert not [found for found in findings(source) if found.startswith("K956")]


def test_optional_launch_files_of_the_setup_assistant_have_no_dependencies(source):
    package = source / "cart_description"
    text = '<launch>\n  <arg name="path" default="$(find cart_description)/default_warehouse_mongo_db"/>\n'
    text += '  <node pkg="warehouse_ros_mongo" type="wrapper.py" name="db" args="$(arg path)"/>\n</launch>\n'
    write(package / "launch/warehouse.launch", text)
    assert codes(source) >= {"K956"}
    write(package / ".setup_assistant", "moveit_setup_assistant_config:\n")
    assert codes(source).isdisjoint({"K956", "K958"})


def test_create_ignores_unknown_options_unless_it_has_no_source(source):
    package = ros2_package(source, "ros_gz_sim")
    for arguments, severity in (
        ("-topic robot_description -model cart", "warning"),
        ("-topik robot_description", "error"),
    ):
        text = f'<launch>\n  <node pkg="ros_gz_sim" exec="create" args="{arguments}"/>\n</launch>\n'
        write(package / "launch/spawn.launch.xml", text)
        assert [found.split()[1] for found in findings(source) if found.startswith("K968")] == [severity]


ROBOT = '<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">\n{}\n  <link name="{}"/>\n</robot>\n'
OF_PACKAGE = '<xacro:include filename="$(find cart_description)/{}.urdf.xacro"/>'


@pytest.mark.parametrize("part", ["none", "in use", "left out"])
def test_misspelt_arguments_of_a_description_that_another_robot_includes_are_found(source, part):
    argument = '<xacro:arg name="use_camera" default="false"/>\n<xacro:property name="a" value="$(arg use_camera)"/>'
    if part != "none":
        condition = "true" if part == "in use" else "false"
        argument += f'<xacro:if value="{condition}">{OF_PACKAGE.format("part")}</xacro:if>'
    own = '<xacro:arg name="speed" default="1"/>' if part != "left out" else '<xacro:arg name="x" default="1"/>'
    write(source / "cart_description/part.urdf.xacro", ROBOT.format(own, "part"))
    write(source / "cart_description/cart.urdf.xacro", ROBOT.format(argument, "base_link"))
    write(source / "cart_description/two.urdf.xacro", ROBOT.format(OF_PACKAGE.format("cart"), "arm"))
    command = "xacro $(find cart_description)/cart.urdf.xacro use_camra:=true use_camera:=true color:=red speed:=2"
    launch = f'<launch>\n  <param name="robot_description" command="{command}"/>\n</launch>\n'
    write(source / "cart_description/launch/cart.launch", launch)
    found = [one.message.partition("; ")[0] for one in lint(source / "cart_description") if one.code == "L102"]
    names = {"in use": ["use_camra", "color"]}.get(part, ["use_camra", "color", "speed"])
    assert found == [f"cart.urdf.xacro has no argument `{name}`" for name in names]


IN_PYTHON = """from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = {}
    return LaunchDescription([Node(package="rviz2", executable="rviz2", arguments=[path])])
"""
USES = [
    ("a.launch.py", IN_PYTHON.format('FindPackageShare("{}")')),
    ("a.launch.py", IN_PYTHON.format('get_package_share_directory("{}")')),
    ("a.launch", '<launch>\n  <arg name="path" default="$(find {})"/>\n</launch>\n'),
    ("a.launch", '<launch>\n  <include file="$(find {})/a.launch"/>\n</launch>\n'),
    ("a.launch", '<launch>\n  <node name="a" pkg="{}" type="a"/>\n</launch>\n'),
]


@pytest.mark.parametrize(("file", "text"), USES)
@pytest.mark.parametrize(
    ("used", "meant"),
    [
        ("cart_descripton", "cart_description"),
        ("gazebo_rso", "gazebo_ros"),
        ("ur5e_moveit", None),
        ("cart_control", None),
    ],
)
def test_the_advice_on_a_misspelt_package_is_its_name(source, file, text, used, meant):
    write(source / "ur5_moveit/package.xml", MANIFEST.format(name="ur5_moveit", needed="rviz"))
    write(source / f"cart_description/launch/{file}", text.format(used))
    manifest = MANIFEST.format(name="cart_description", needed="rviz2</exec_depend><exec_depend>ur5_moveit")
    write(source / "cart_description/package.xml", manifest)
    (found,) = (one for one in lint(source / "cart_description") if one.code == "K956")
    if meant is None:
        assert (found.severity, found.message) == ("warning", f"missing dependency on `{used}`")
        assert found.help == f"add <exec_depend>{used}</exec_depend> to package.xml"
    else:
        assert (found.severity, found.message) == ("error", f"unknown package `{used}`; did you mean `{meant}`?")
        assert found.help is None
    line = next(number for number, each in enumerate(text.splitlines(), 1) if "{}" in each)
    assert [each.line for each in (found.related if meant is None else [found])] == [line]


def test_the_misspelt_package_of_a_mesh_is_an_error_with_its_name(source):
    mesh = '<visual><geometry><mesh filename="package://{}/a.stl"/></geometry></visual>'
    links = "".join(f'<link name="{one}">{mesh.format(one)}</link>\n' for one in ("cart_descripton", "elsewhere"))
    write(source / "cart_description/cart.urdf", f'<robot name="cart">\n{links}</robot>\n')
    found = [one for one in lint(source / "cart_description") if one.code == "G602"]
    assert [(one.link, one.severity) for one in found] == [("cart_descripton", "error"), ("elsewhere", "warning")]
    assert found[0].message.endswith("; did you mean `cart_description`?")


XACRO = """<launch>
  <arg name="model" default="$(find cart_description)/cart.urdf.xacro"/>
  <param name="robot_description" command="xacro $(arg model) use_camra:=true color:=red"/>
</launch>
"""
BY_ARGUMENT = [
    ("cart.launch", XACRO),
    (
        "cart.launch.py",
        IN_PYTHON.format('FindPackageShare("cart_description")').replace(
            "    return LaunchDescription([",
            '    model = DeclareLaunchArgument("model", default_value=[path, "/cart.urdf.xacro"])\n'
            '    command = Command(["xacro ", LaunchConfiguration("model"), " use_camra:=true", " color:=red"])\n'
            "    return LaunchDescription([model, ",
        ),
    ),
]


@pytest.mark.parametrize(("file", "launch"), BY_ARGUMENT)
def test_misspelt_arguments_of_the_default_description_are_found(source, file, launch):
    """Another description can have arguments that the default one lacks."""
    argument = '<xacro:arg name="use_camera" default="false"/>\n<xacro:property name="a" value="$(arg use_camera)"/>'
    write(source / "cart_description/cart.urdf.xacro", ROBOT.format(argument, "base_link"))
    write(source / f"cart_description/launch/{file}", launch)
    found = [one.message for one in lint(source / "cart_description") if one.code == "L102"]
    assert found == ["cart.urdf.xacro has no argument `use_camra`; did you mean `use_camera`?"]


NODE = 'Node(package="rviz2", executable="rviz2", name={})'


@pytest.mark.parametrize(
    ("second", "is_reported"),
    [
        (NODE.format('"view"'), True),
        (NODE.format('"view", namespace=""'), True),
        (NODE.format('"view", condition=UnlessCondition(gui)'), False),
        (NODE.format('"view", namespace="arm"'), False),
        (NODE.format('"rear_view"'), False),
        (f"GroupAction([{NODE.format(chr(34) + 'view' + chr(34))}])", False),
    ],
)
def test_two_nodes_of_one_name_in_python(source, second, is_reported):
    package = ros2_package(source, "<exec_depend>rviz2</exec_depend>")
    first = NODE.format('"view", condition=IfCondition(gui)')
    text = f"def generate_launch_description():\n    return LaunchDescription([{first}, {second}])\n"
    write(package / "launch/two.launch.py", text)
    assert any("also has the name `view`" in each for each in findings(source)) is is_reported


def test_the_paths_of_the_setup_assistant_exist_unless_the_builder_replaces_them(source):
    package = source / "cart_description"
    config = (
        "moveit_setup_assistant_config:\n  urdf:\n    package: cart_description\n    relative_path: cart.urdf.xacro\n"
    )
    write(package / ".setup_assistant", config)
    launch = 'import moveit_configs_utils as m\n\nm.MoveItConfigsBuilder("cart", package_name="{}"){}\n'
    write(package / "launch/move.launch.py", launch.format("cart_description", ""))
    assert "M111" in codes(source)
    write(package / "launch/move.launch.py", launch.format("cart_description", ".robot_description(file_path=urdf)"))
    assert "M111" not in codes(source)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ('.joint_limits(file_path="config/limit.yaml")', "`config/limit.yaml` does not exist in package"),
        ('.joint_limits(Path("config") / "limit.yaml")', "`config/limit.yaml` does not exist in package"),
        ('.planning_pipelines(pipelines=["opml"])', "planning pipeline `opml` has no file"),
        ('.planning_pipelines("opml", ["ompl"])', "`opml` is not in `pipelines`; did you mean `ompl`?"),
        ('.planning_pipelines(pipelines=["own"], default_planning_pipeline="ompl")', "`ompl` is not in `pipelines`"),
        ('.joint_limit(file_path="config/limits.yaml")', "has no method `joint_limit`; did you mean `joint_limits`?"),
        ('.joint_limits(filepath="config/limits.yaml")', "has no argument `filepath`; did you mean `file_path`?"),
        ('.joint_limits(file_path="config/limits.yaml").planning_pipelines(pipelines=["ompl", "own"])', ""),
        (".joint_limits(file_path=computed)", ""),
        ('.robot_description_kinematics("config/limits.yaml")', "has no `kinematics_solver`"),
        ('.joint_limits("config/own_planning.yaml")', "has no `joint_limits`, which `joint_limits` reads"),
    ],
)
def test_the_methods_of_the_moveit_builder_are_checked(source, call, message):
    package = source / "cart_description"
    write(package / "config/limits.yaml", "joint_limits:\n  wheel: {max_velocity: 1.0}\n")
    write(package / "config/own_planning.yaml", "planning_plugin: own/Planner\n")
    text = (
        f'builder = MoveItConfigsBuilder("cart", package_name="cart_description")\nbuilder{call}.to_moveit_configs()\n'
    )
    write(package / "launch/move.launch.py", text)
    found = [one.message for one in lint(package) if one.code == "M111"]
    assert len(found) == bool(message)
    assert all(message in one for one in found)


@pytest.mark.parametrize(
    ("parameters", "more", "is_reported"),
    [
        ("config.robot_description, config.robot_description_semantic, {'use_sim_time': True}", "", True),
        ("{'use_sim_time': True}", "", True),
        ("config.to_dict()", "", False),
        ("whole, {'use_sim_time': True}", "", False),
        ("config.robot_description, config.planning_pipelines", "", False),
        ("config.robot_description, {'planning_pipelines.pipeline_names': ['ompl']}", "", False),
        ("config.robot_description, other", "", False),
        ("config.robot_description", "config.robot_description.update(other)", False),
    ],
)
def test_move_group_needs_the_planning_pipelines_of_its_configuration(source, parameters, more, is_reported):
    package = ros2_package(source, "<exec_depend>moveit_ros_move_group</exec_depend>")
    text = f"""from moveit_configs_utils import MoveItConfigsBuilder

config = MoveItConfigsBuilder("cart", package_name="cart_moveit_config").to_moveit_configs()
whole = config.to_dict()
{more}
node = Node(package="moveit_ros_move_group", executable="move_group", parameters=[{parameters}])
"""
    write(package / "launch/move.launch.py", text)
    assert any("`move_group` needs the planning pipelines" in each for each in findings(source)) is is_reported


@pytest.mark.parametrize(
    ("text", "is_reported"),
    [
        ("from nav2_common.launch import RewrittenYaml\n", True),
        ("import moveit_configs_utils.launches\n", True),
        ("import launch, yaml, serial\nfrom launch_ros.actions import Node\n", False),
        ("try:\n    import nav2_common\nexcept ImportError:\n    pass\n", False),
    ],
)
def test_imports_of_launch_files_need_a_dependency(source, text, is_reported):
    package = ros2_package(source, "<exec_depend>rviz2</exec_depend>")
    write(package / "launch/all.launch.py", text)
    assert any("missing dependency on" in each for each in findings(source)) is is_reported


NAVIGATION = """amcl:
  ros__parameters:
    robot_base_frame: base_link
behavior_server:
  ros__parameters:
    cycle_frequency: 10.0
"""
XML_NODE = '<launch>\n  <node pkg="{}" exec="{}" name="{}"{}\n</launch>\n'
READS = '><param from="$(find-pkg-share cart_description)/config/nav.yaml"/></node>'


@pytest.mark.parametrize(
    ("node", "message"),
    [
        (("teleop_twist_joy", "teleop_twist_joy_node", "joy", "/>"), "no executable `teleop_twist_joy_node`; did you"),
        (("teleop_twist_joy", "teleop_node", "joy", "/>"), ""),
        (
            ("nav2_recoveries", "recoveries_server", "behavior_server", "/>"),
            "since Humble, the package `nav2_behaviors` replaces `nav2_recoveries`",
        ),
        (("nav2_behaviors", "behavior_server", "behavior_server", "/>"), ""),
        (("nav2_map_server", "map_server", "maps", '><param name="yaml_file" value="m"/></node>'), "`yaml_filename`?"),
        (("nav2_map_server", "map_server", "maps", '><param name="yaml_filename" value="m"/></node>'), ""),
        (("nav2_map_server", "map_server", "maps", '><param name="frame_ids" value="m"/></node>'), "mean `frame_id`?"),
        (("nav2_amcl", "amcl", "localizer", READS), "node `localizer` has no section in nav.yaml, which has `amcl`"),
        (("nav2_amcl", "amcl", "amcl", READS), ""),
        (
            ("controller_manager", "spawner", "s", ' args="a --controller_manager /c"/>'),
            "unknown option `--controller_manager` of `spawner`; did you mean `--controller-manager`?",
        ),
        (("controller_manager", "spawner", "s", ' args="a --controller-manager /c --my-option"/>'), ""),
    ],
)
def test_nodes_options_and_parameters_of_released_packages(source, node, message):
    package = ros2_package(source, f"{node[0]}</exec_depend><exec_depend>launch_ros")
    write(package / "config/nav.yaml", NAVIGATION)
    write(package / "launch/drive.launch.xml", XML_NODE.format(*node))
    found = [text for text in findings(source) if text.startswith(("L103", "L104", "L117", "K968"))]
    assert (len(found) == 1 and message in found[0]) if message else found == []


def test_an_unclosed_substitution_before_another_one_is_reported(source):
    launch = '<launch>\n  <arg name="x" default="0"/>\n  <arg name="y" default="{}"/>\n</launch>\n'
    write(source / "cart_description/launch/drive.launch", launch.format("$(arg x $(arg x)"))
    assert any("`$(arg x ` has no closing parenthesis" in each for each in findings(source))
    write(source / "cart_description/launch/drive.launch", launch.format("$(arg x) $(arg x)"))
    assert not any("parenthesis" in each for each in findings(source))


HELPER = """
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource


def include(name, **arguments):
    path = os.path.join(get_package_share_directory("cart_description"), "launch", name)
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(path), launch_arguments=arguments.items())


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("gui", default_value="true"),
        include("gz.launch.py", {argument}="true"),
    ])
"""


def test_arguments_that_a_function_of_the_file_passes_are_checked_at_the_call(source):
    declared = "from launch.actions import DeclareLaunchArgument\na = DeclareLaunchArgument('paused')\n"
    write(source / "cart_description/launch/gz.launch.py", declared)
    write(source / "cart_description/launch/all.launch.py", HELPER.replace("{argument}", "pausd"))
    unknown = [finding for finding in lint(source / "cart_description") if finding.code == "L102"]
    assert [(finding.line, finding.message) for finding in unknown] == [
        (17, "gz.launch.py has no argument `pausd`; did you mean `paused`?")
    ]
    write(source / "cart_description/launch/all.launch.py", HELPER.replace("{argument}", "paused"))
    assert "L102" not in {finding.code for finding in lint(source / "cart_description")}
