"""Arguments that launch files of all formats pass to xacro, and which of them are used."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description.launch.launch_arguments import choose, description_of, passed_to, values_of
from urdfkit.description.launch.launch_scope import MAX_TEXT
from urdfkit.description.packages.resolver import Packages

PYTHON = """
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
def generate_launch_description():
    package = "arm"
    return LaunchDescription([
        DeclareLaunchArgument("camera", default_value="true", description="Whether to add the camera"),
        DeclareLaunchArgument("speed"),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(
            os.path.join(get_package_share_directory("ros_gz_sim"), "launch", "gz_sim.launch.py"))),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource([os.path.join(
                get_package_share_directory(package), "launch", "rsp.launch.py")]),
            launch_arguments={"sim": "true", "tool": f"{package}_gripper"}.items(),
        ),
    ])
"""
RSP = """
def generate_launch_description():
    path = os.path.join(get_package_share_directory("arm"))
    xacro_file = os.path.join(path, "urdf", "arm.urdf.xacro")
    DeclareLaunchArgument("sim", default_value="false")
    command = Command([FindExecutable(name="xacro"), " ", xacro_file, " sim_mode:=", LaunchConfiguration("sim"),
        " camera:=", LaunchConfiguration("camera"), " tool:=", LaunchConfiguration("tool"),
        " speed:=", LaunchConfiguration("speed"), " host:=", os.environ["HOST"],
        " limits:=", PathJoinSubstitution([FindPackageShare("arm"), "config", "limits.yaml"])])
"""
ROS1 = """<launch>
  <arg name="camera" default="true" doc="Whether to add the camera"/>
  <arg name="off" default="false"/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"/>
  <param if="$(arg off)" name="robot_description" command="xacro '$(find arm)/urdf/arm.urdf.xacro' sim_mode:=no"/>
  <group unless="$(arg off)">
    <include file="$(find arm)/launch/upload.launch"><arg name="sim" value="true"/></include>
  </group>
</launch>"""
UPLOAD = """<launch>
  <arg name="sim" default="false"/>
  <param name="robot_description"
    command="$(find xacro)/xacro --inorder $(find arm)/urdf/arm.urdf.xacro sim_mode:=$(arg sim) host:=$(env HOST)"/>
</launch>"""
ROS2_XML = """<launch>
  <arg name="camera" default="true" description="Whether to add the camera"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description"
      value="$(command 'xacro $(find-pkg-share arm)/urdf/arm.urdf.xacro sim_mode:=true camera:=$(var camera)' 'warn')"/>
  </node>
  <node pkg="ros_gz_sim" exec="create"/>
</launch>"""
ROS2_YAML = """
launch:
- arg: {name: camera, default: "true", description: Whether to add the camera}
- group:
  - node:
      pkg: robot_state_publisher
      exec: robot_state_publisher
      param:
      - name: robot_description
        value: $(command 'xacro $(find-pkg-share arm)/urdf/arm.urdf.xacro sim_mode:=true camera:=$(var camera)')
- node: {pkg: ros_gz_sim, exec: create}
"""
PROCESSED = """
def setup(context):
    document = xacro.process_file(Path(get_package_share_directory("arm")) / "urdf" / "arm.urdf.xacro",
        mappings={"sim_mode": "true", "camera": LaunchConfiguration("camera").perform(context)})
    return [Node(package="ros_gz_sim", executable="create")]
DeclareLaunchArgument(name="camera", default_value="true", description="Whether to add the camera")
"""

Package = Callable[[dict[str, str]], Path]


@pytest.fixture
def package(tmp_path: Path) -> Package:
    """Return a function that writes the package `arm` with launch files, and returns its description."""

    def write(launches: dict[str, str]) -> Path:
        root = tmp_path / "src" / "arm"
        for folder in ("urdf", "launch", "config"):
            (root / folder).mkdir(parents=True)
        (root / "package.xml").write_text("<package><name>arm</name></package>")
        (root / "config" / "limits.yaml").write_text("a: 1\n")
        for name, text in launches.items():
            (root / "launch" / name).write_text(text)
        description = root / "urdf" / "arm.urdf.xacro"
        description.write_text("<robot name='arm'/>")
        return description

    return write


@pytest.mark.parametrize(
    ("name", "text"),
    [("sim.launch.xml", ROS2_XML), ("sim.launch.yaml", ROS2_YAML), ("sim.launch.py", PROCESSED)],
)
def test_each_format_of_ros2(name: str, text: str, package: Package) -> None:
    description = package({name: text})
    passed = passed_to(description, Packages(near=description))
    chosen = choose(passed, "simulation", {}).chosen
    assert {path.name: dict(found) for path, found in chosen.items()} == {name: {"sim_mode": "true", "camera": "true"}}
    assert description_of("camera", passed) == "Whether to add the camera"
    assert choose(passed, "display", {}).chosen == {}


@pytest.mark.parametrize(
    ("mappings", "expected"),
    [
        ('{"a": "x", "b": "y"}', {"a": "x", "b": "y"}),
        ('dict(a="x", b="y")', {"a": "x", "b": "y"}),
        ('dict(a="x").items()', {"a": "x"}),
        ('{"a": "x"}.items()', {"a": "x"}),
        ('[("a", "x"), ["b", "y"], ("c", "d", "e")]', {"a": "x", "b": "y"}),
        ("constant", {"a": "x"}),
        ("unknown", {}),
        ('zip("a", "x")', {}),
        ('{"a": "x" + "_" + tool}', {"a": "x_gripper"}),
        ('{"a": f"x_{tool}"}', {"a": "x_gripper"}),
        ('{"a": f"x_{tool!s}"}', {"a": "x_gripper"}),
        ('{"a": f"x_{tool!r}", "b": f"{tool:>9}", "c": "y"}', {"c": "y"}),
        ('{"a": str(tool)}', {"a": "gripper"}),
        ('{"a": ["x_", tool]}', {"a": "x_gripper"}),
        ('{"a": TextSubstitution(text="x")}', {"a": "x"}),
        ('{"a": LaunchConfiguration("declared")}', {"a": "1"}),
        ('{"a": LaunchConfiguration("declared", default="2")}', {"a": "1"}),
        ('{"a": LaunchConfiguration(variable_name="declared").perform(context)}', {"a": "1"}),
        ('{"a": LaunchConfiguration("other", default="2")}', {"a": "2"}),
        ('{"a": PathJoinSubstitution(["x", tool])}', {"a": "x/gripper"}),
        ('{"a": os.path.join("x", tool)}', {"a": "x/gripper"}),
        ('{"a": Path("x") / tool}', {"a": "x/gripper"}),
        ('{"a": Path("x").joinpath(tool)}', {"a": "x/gripper"}),
        ('{"a": 2}', {"a": "2"}),
    ],
)
def test_values_of_python_launch_files(mappings: str, expected: dict[str, str], package: Package) -> None:
    file = 'Path(get_package_share_directory("arm")) / "urdf" / "arm.urdf.xacro"'
    description = package(
        {
            "sim.launch.py": f'tool = "gripper"\nconstant = {{"a": "x"}}\n'
            f'DeclareLaunchArgument("declared", default_value="1")\n'
            f"document = xacro.process_file({file}, mappings={mappings})\n"
        }
    )
    found = passed_to(description, Packages(near=description))
    assert [dict(each.arguments) for each in found] == [expected]


def test_arguments_follow_the_includes_of_python_launch_files(package: Package) -> None:
    description = package({"sim.launch.py": PYTHON, "rsp.launch.py": RSP})
    passed = passed_to(description, Packages(near=description))
    (each,) = passed  # not rsp.launch.py alone
    assert each.launch.name == "sim.launch.py"
    limits = str(description.parents[1] / "config" / "limits.yaml")
    assert each.arguments == {"sim_mode": "true", "camera": "true", "tool": "arm_gripper", "limits": limits}


def test_arguments_follow_the_includes_and_conditions_of_ros1_launch_files(package: Package) -> None:
    description = package({"gazebo.launch": ROS1, "upload.launch": UPLOAD})
    (each,) = passed_to(description, Packages(near=description))
    assert (each.launch.name, each.arguments) == ("gazebo.launch", {"sim_mode": "true"})


def test_contradicting_launch_files_leave_the_choice_to_the_user(package: Package) -> None:
    description = package(
        {"a.launch.xml": ROS2_XML, "b.launch.xml": ROS2_XML.replace("sim_mode:=true", "sim_mode:=no")}
    )
    passed = passed_to(description, Packages(near=description))
    choice = choose(passed, "simulation", {})
    assert choice.chosen == {}
    assert {value: path.name for value, path in choice.conflicts["sim_mode"].items()} == {
        "true": "a.launch.xml",
        "no": "b.launch.xml",
    }
    assert [value for value, _ in values_of("sim_mode", passed)] == ["true", "no"]
    chosen = choose(passed, "simulation", {"sim_mode": "no"}).chosen  # agrees with one of them
    assert {path.name: dict(found) for path, found in chosen.items()} == {"b.launch.xml": {"camera": "true"}}


def test_the_own_package_has_precedence_over_packages_that_depend_on_it(package: Package) -> None:
    description = package({"a.launch.xml": ROS2_XML})
    other = description.parents[2] / "demo"
    other.mkdir()
    (other / "package.xml").write_text("<package><name>demo</name><depend>arm</depend></package>")
    (other / "demo.launch.xml").write_text(ROS2_XML.replace("sim_mode:=true", "sim_mode:=no"))
    passed = passed_to(description, Packages(near=description))
    assert len(passed) == 2
    assert [path.name for path in choose(passed, "simulation", {}).chosen] == ["a.launch.xml"]


def test_display_launch_files_are_those_with_sliders_or_rviz(package: Package) -> None:
    command = "<param name='robot_description' command='xacro $(find arm)/urdf/arm.urdf.xacro gripper:={}'/>"
    rviz = "<launch>" + command.format("a") + "<node pkg='rviz' type='rviz'/></launch>"
    sliders = "<launch>" + command.format("b") + "<node pkg='joint_state_publisher_gui' type='x'/></launch>"
    description = package({"rviz.launch": rviz, "sliders.launch": sliders, "sim.launch.xml": ROS2_XML})
    chosen = choose(passed_to(description, Packages(near=description)), "display", {}).chosen
    assert {path.name: dict(found) for path, found in chosen.items()} == {"sliders.launch": {"gripper": "b"}}


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("x.launch.py", "a = b + b\n" + "".join(f"x{i} = x{i + 1} + x{i + 1}\n" for i in range(60)) + "Command(x0)"),
        ("x.launch.py", "Command(" + "(" * 150 + "'xacro'" + ")" * 150 + ")"),
        ("x.launch.py", "x = x\nCommand([x, 'xacro', '"),
        ("x.launch", '<launch><include file="$(find arm)/launch/x.launch"/></launch>'),
        ("x.launch", "<launch><arg name='a' default='$(arg a)$(arg a)$(find arm'/><param command='xacro $(arg a)'/>"),
        ("x.launch.xml", "<launch>" + "<group>" * 500),
        ("x.launch.yaml", "launch: " + "[" * 5_000),
        ("x.launch.yaml", "launch:\n- group: &a\n  - group: *a\n"),
    ],
)
def test_launch_files_that_cannot_be_read_count_as_empty(name: str, text: str, package: Package) -> None:
    description = package({name: text})
    assert passed_to(description, Packages(near=description)) == []


@pytest.mark.parametrize(("more", "expected"), [(0, [{"sim_mode": "true"}]), (1, [])])
def test_texts_above_the_limit_are_unknown(more: int, expected: list[dict[str, str]], package: Package) -> None:
    command = "$(find xacro)/xacro $(find arm)/urdf/arm.urdf.xacro sim_mode:=true$(arg{}empty)"
    text = command.format(" " * (MAX_TEXT + more - len(command) + len("{}")))
    parameter = f'<param name="robot_description" command="{text}"/>'
    description = package({"sim.launch": f'<launch><arg name="empty" default=""/>{parameter}</launch>'})
    assert [dict(each.arguments) for each in passed_to(description, Packages(near=description))] == expected


@pytest.mark.parametrize(("more", "expected"), [(0, {"a": "x" * MAX_TEXT}), (1, {})])
def test_values_above_the_limit_are_unknown(more: int, expected: dict[str, str], package: Package) -> None:
    file = 'Path(get_package_share_directory("arm")) / "urdf" / "arm.urdf.xacro"'
    value = "x" * (MAX_TEXT + more)
    description = package({"sim.launch.py": f"document = xacro.process_file({file}, mappings={{'a': '{value}'}})\n"})
    (each,) = passed_to(description, Packages(near=description))
    assert dict(each.arguments) == expected
