"""A package.xml that cannot be read is a finding, and the robots of its package are linted."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

GOOD = "<package><name>p</name><version>0.0.1</version></package>"


@pytest.mark.parametrize(
    ("text", "line"),
    [("<package>\n<name>p</name>\n<version>0.0.1\n</package>\n", 3), ("", 1), ("  \n", 1), ("nothing", 1)],
)
def test_a_manifest_that_is_no_xml_is_told_in_its_place(tmp_path, monkeypatch, text, line):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "package.xml").write_text(text)
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf" / "r.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    (found,) = lint(tmp_path)
    assert (found.code, found.severity, found.file, found.line) == ("K964", "error", "package.xml", line)
    (tmp_path / "package.xml").write_text(GOOD)
    assert lint(tmp_path) == []


def manifest(name: str, *needed: str) -> str:
    depends = "".join(f"<exec_depend>{each}</exec_depend>" for each in needed)
    people = '<maintainer email="a@example.com">A</maintainer><license>MIT</license>'
    build = "<buildtool_depend>ament_cmake</buildtool_depend>"
    return (
        f'<package format="3"><name>{name}</name><version>0.0.1</version><description>d</description>'
        f"{people}{build}{depends}<export><build_type>ament_cmake</build_type></export></package>"
    )


def test_a_dependency_on_the_package_itself_stands_for_the_missing_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    packages = {
        "arm_description": manifest("arm_description"),
        "arm_gazebo": manifest("arm_gazebo", "arm_description"),
        "arm_bringup": manifest("arm_bringup", "arm_bringup", "arm_description"),
    }
    for name, text in packages.items():
        (tmp_path / name / "launch").mkdir(parents=True)
        (tmp_path / name / "package.xml").write_text(text)
    (tmp_path / "arm_description" / "arm.urdf").write_text('<robot name="arm"><link name="a"/></robot>')
    launch = '<launch><include file="$(find-pkg-share arm_gazebo)/launch/world.launch.xml"/></launch>'
    (tmp_path / "arm_bringup" / "launch" / "arm.launch.xml").write_text(launch)
    (tmp_path / "arm_gazebo" / "launch" / "world.launch.xml").write_text("<launch/>")
    found = [(each.code, each.message) for each in lint(tmp_path) if each.file.endswith("bringup/package.xml")]
    assert found == [("K972", "package `arm_bringup` depends on itself")]
    assert "K956" not in {each.code for each in lint(tmp_path)}
    (tmp_path / "arm_bringup" / "package.xml").write_text(manifest("arm_bringup", "arm_description"))
    assert "missing dependency on `arm_gazebo`" in {each.message for each in lint(tmp_path)}


@pytest.mark.parametrize(("build", "codes"), [("ament_cmake", ["K972"]), ("catkin", ["K956"])])
def test_in_ros_2_the_name_of_a_package_of_ros_1_stands_for_its_successor(tmp_path, monkeypatch, build, codes):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "package.xml").write_text(manifest("arm_description", "rviz").replace("ament_cmake", build))
    (tmp_path / "arm.urdf").write_text('<robot name="arm"><link name="a"/></robot>')
    (tmp_path / "arm.launch.xml").write_text('<launch><include file="$(find-pkg-share rviz2)/a.xml"/></launch>')
    assert [each.code for each in lint(tmp_path) if "rviz" in each.message] == codes


def test_a_cycle_of_dependencies_is_reported_once(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    needs = {"a_description": ["b_control"], "b_control": ["c_bringup"], "c_bringup": ["a_description"]}
    for name, needed in needs.items():
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(manifest(name, *needed))
    (tmp_path / "a_description" / "arm.urdf").write_text('<robot name="arm"><link name="a"/></robot>')
    (found,) = lint(tmp_path)
    cycle = "`a_description` → `b_control` → `c_bringup` → `a_description`"
    assert (found.file, found.code) == ("a_description/package.xml", "K972")
    assert found.message == f"the packages depend on each other: {cycle}; colcon fails"
    for tool in ("catkin", "ament_cmake"):
        text = manifest("b_control", "c_bringup").replace(
            "exec_depend", "test_depend" if "ament" in tool else "exec_depend"
        )
        for name in needs:
            file = tmp_path / name / "package.xml"
            file.write_text((text if name == "b_control" else file.read_text()).replace("ament_cmake", tool))
        notes = [found.message] if tool == "catkin" else []  # catkin itself only needs an order for the build
        assert [(each.severity, each.message) for each in lint(tmp_path)] == [("note", text) for text in notes]


@pytest.mark.parametrize(
    ("export", "messages"),
    [
        ('gazebo_model_path="${prefix}/..:${prefix}/worlds"', []),
        (
            'gazebo_model_path="${prefix}/models"',
            ["folder `models` of gazebo_model_path does not exist in this package"],
        ),
        ('gazebo_model_paht="${prefix}/.."', ["unknown attribute `gazebo_model_paht` of <gazebo_ros>"]),
        ('plugin_path="${prefix}/lib"', []),
        ('gazebo_media_path="${prefix}/installed"', []),
    ],
)
def test_exported_paths_of_gazebo(tmp_path, monkeypatch, export, messages):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text('<robot name="arm"><link name="a"/></robot>')
    (tmp_path / "worlds").mkdir()
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.8)\nproject(arm_description)\nfind_package(ament_cmake REQUIRED)\n"
        "install(DIRECTORY worlds DESTINATION share/${PROJECT_NAME})\n"
        "install(DIRECTORY worlds/ DESTINATION share/${PROJECT_NAME}/installed)\nament_package()\n"
    )
    text = manifest("arm_description").replace("<export>", f"<export><gazebo_ros {export}/>")
    assert "<gazebo_ros" in text
    (tmp_path / "package.xml").write_text(text)
    assert [each.message.partition(";")[0] for each in lint(tmp_path)] == messages


def test_a_misspelt_name_without_its_last_letter_and_utf_16(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text('<robot name="arm"><link name="a"/></robot>')
    (tmp_path / "package.xml").write_text(manifest("p", "moveit_kinematic", "velocity_controller"))
    assert [each.message for each in lint(tmp_path)] == [
        "unknown dependency `moveit_kinematic`; did you mean `moveit_kinematics`?"
    ]
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch" / "v.launch.xml").write_text('<launch><node pkg="rviz2" exec="rviz2"/></launch>')
    (tmp_path / "package.xml").write_text(manifest("p", "rviz2"), "utf-16")
    assert [each.message for each in lint(tmp_path)] == ["package.xml is in UTF-16; colcon and catkin read UTF-8 only"]


def test_a_uri_with_the_folder_of_the_package_in_place_of_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "robot-data").mkdir()
    (tmp_path / "robot-data" / "package.xml").write_text(manifest("robot_descriptions"))
    mesh = '<visual><geometry><mesh filename="package://robot-data/{}.stl"/></geometry></visual>'
    links = f'<link name="a">{mesh.format("a")}</link>'
    (tmp_path / "robot-data" / "r.urdf").write_text(f'<robot name="r">{links}</robot>')
    message = "`robot-data` is the folder of this package; its name in package.xml is `robot_descriptions`"
    assert [each.message for each in lint(tmp_path) if each.code == "K956"] == [message]


NAVIGATION = """controller_server:
  ros__parameters:
    FollowPath:
      plugin: nav2_mppi_controller::MPPIController
    goal_checker:
      plugin: "nav2_controller::SimpleGoalChecker"
planner_server:
  ros__parameters:
    GridBased:
      plugin: nav2_smac_planner::SmacPlanner2D
"""
GRIPPER = """controller_manager:
  ros__parameters:
    hand:
      type: position_controllers/GripperActionController
"""
SIMULATED = """<robot name="arm"><link name="a"/>
<gazebo><plugin filename="libgazebo_ros2_control.so" name="control"/></gazebo></robot>"""
PLAIN = '<robot name="arm"><link name="a"/></robot>'


@pytest.mark.parametrize(
    ("robot", "yaml", "declared", "needed"),
    [
        (PLAIN, NAVIGATION, ["nav2_controller", "nav2_smac_planner"], "nav2_mppi_controller"),
        (PLAIN, GRIPPER, ["controller_manager"], "gripper_controllers"),
        (SIMULATED, "", ["gz_ros2_control"], "gazebo_ros2_control"),
    ],
)
def test_packages_of_plugins_are_dependencies_if_others_of_their_kind_are(
    tmp_path, monkeypatch, robot, yaml, declared, needed
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "settings.yaml").write_text(yaml)
    (tmp_path / "arm.urdf").write_text(robot)

    def missing(*names: str) -> list[str]:
        (tmp_path / "package.xml").write_text(manifest("arm_description", *names))
        return [each.message for each in lint(tmp_path) if each.code == "K956"]

    (message,) = missing(*declared)
    assert message.startswith(f"missing dependency on `{needed}`, wh")
    assert missing(*declared, needed) == []
    assert missing() == []
    if yaml == NAVIGATION:
        assert missing("navigation2") == missing("nav2_controller") == []


@pytest.mark.parametrize(
    ("tool", "foreign", "other"), [("catkin", "rclpy", "ROS 2"), ("ament_cmake", "roscpp", "ROS 1")]
)
def test_packages_of_the_other_version_of_ros(tmp_path, monkeypatch, tool, foreign, other):
    monkeypatch.chdir(tmp_path)
    text = manifest("arm_description", foreign, "xacro").replace("ament_cmake", tool)
    (tmp_path / "package.xml").write_text(text)
    (tmp_path / "arm.urdf").write_text(PLAIN)
    message = f"`{foreign}` is a package of {other}, but `{tool}` builds this package"
    assert message in [each.message for each in lint(tmp_path)]
    conditional = f"<exec_depend>{foreign}", f'<exec_depend condition="$ROS_VERSION == 1">{foreign}'
    (tmp_path / "package.xml").write_text(text.replace(*conditional))
    assert message not in [each.message for each in lint(tmp_path)]


def test_python_programs_that_catkin_installs_exist(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "package.xml").write_text(manifest("arm_description").replace("ament_cmake", "catkin"))
    (tmp_path / "arm.urdf").write_text(PLAIN)
    cmake = "cmake_minimum_required(VERSION 3.0.2)\nproject(arm_description)\nfind_package(catkin REQUIRED)\n"
    cmake += "catkin_package()\ncatkin_install_python(PROGRAMS scripts/wave.py DESTINATION bin)\n"
    (tmp_path / "CMakeLists.txt").write_text(cmake)
    message = "`scripts/wave.py` does not exist in this package"
    assert message in [each.message for each in lint(tmp_path)]
    (tmp_path / "scripts").mkdir()
    (tmp_path / "scripts" / "wave.py").touch()
    assert message not in [each.message for each in lint(tmp_path)]


def test_the_old_name_of_a_package_is_reported_where_it_is_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text(PLAIN)
    (tmp_path / "launch").mkdir()
    launch = tmp_path / "launch" / "sim.launch.xml"

    def found(package: str, declared: str) -> list[tuple[str, int, int, str]]:
        launch.write_text(f'<launch>\n<node pkg="{package}" exec="parameter_bridge"/></launch>')
        (tmp_path / "package.xml").write_text(manifest("p", "xacro", declared).replace("<exec", "\n<exec"))
        found = (each for each in lint(tmp_path) if each.code == "K956")
        return [(each.file.rpartition("/")[2], each.line, each.span.column, each.message) for each in found]

    missing = "missing dependency on `ros_gz_bridge`"
    unknown = "unknown package `ros_ign_bridge`; did you mean `ros_gz_bridge`?"
    assert found("ros_gz_bridge", "ros_ign_bridge") == [("package.xml", 3, 14, missing)]
    assert found("ros_ign_bridge", "ros_gz_bridge") == [("sim.launch.xml", 2, 12, unknown)]
    assert found("ros_gz_bridge", "ros_gz_bridge") == []
    assert found("ros_ign_bridge", "ros_ign_bridge") == []


@pytest.mark.parametrize(
    ("written", "message"),
    [
        ("moveit_simple_controllers_manager", "unknown dependency `moveit_simple_controllers_manager`"),
        ("moveit_simple_controller_manager", ""),
        ("moveit_planners", "missing dependency on `moveit_simple_controller_manager`"),
    ],
)
def test_a_dependency_that_differs_by_a_plural(tmp_path, monkeypatch, written, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text('<robot name="arm"><link name="a"/></robot>')
    (tmp_path / "arm.launch.xml").write_text(
        '<launch><node pkg="moveit_simple_controller_manager" exec="a" name="a"/></launch>\n'
    )
    (tmp_path / "package.xml").write_text(manifest("arm_description", written))
    found = [(each.file, each.message.partition(";")[0]) for each in lint(tmp_path) if each.code == "K956"]
    assert found == ([("package.xml", message)] if message else [])
