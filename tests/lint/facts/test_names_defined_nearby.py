"""Launch files and YAML around a description: read without running them, nothing said of what is computed."""

from __future__ import annotations

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint import lint
from urdfkit.lint.engine.run import run
from urdfkit.lint.facts.control.controller_joints import controllers, joints
from urdfkit.lint.facts.control.launch_package_paths import package_paths
from urdfkit.lint.project.entry_files import find_entries
from urdfkit.lint.project.options import Options

ARM = """<robot name="arm">
  <link name="base"/>
  <link name="upper"/>
  <joint name="elbow" type="fixed"><parent link="base"/><child link="upper"/></joint>
</robot>
"""
CONTROLLERS = """arm_controller:
  type: position_controllers/JointPositionController
  joint: elbo
"""
LAUNCH = """import os
from ament_index_python.packages import get_package_share_directory
NAME = "arm_description"
def generate_launch_description():
    share = get_package_share_directory(NAME)
    raise SystemExit("this is never run")
    model = os.path.join(share, "urdf", "arms.urdf")
"""


def package(folder, *needs: str):
    depends = "".join(f"<exec_depend>{need}</exec_depend>" for need in needs)
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(f'<package format="3"><name>{folder.name}</name>{depends}</package>')
    return folder


@pytest.fixture
def workspace(tmp_path):
    """A description, and a package next to it that starts it."""
    described, started = package(tmp_path / "arm_description"), package(tmp_path / "arm_start", "arm_description")
    for folder in (described / "urdf", started / "launch", started / "config"):
        folder.mkdir()
    (described / "urdf" / "arm.urdf").write_text(ARM)
    (started / "launch" / "arm.launch.py").write_text(LAUNCH)
    (started / "config" / "controllers.yaml").write_text(CONTROLLERS)
    return tmp_path


def found(path, **options):
    findings = [finding for finding in lint(path, **options) if finding.code in ("K958", "K959", "K960")]
    return [(finding.code, finding.file.rpartition("/")[2], finding.line, finding.column) for finding in findings]


def test_a_package_that_depends_on_the_description_is_looked_at(workspace):
    both = [("K959", "controllers.yaml", 3, 10), ("K958", "arm.launch.py", 7, 13)]
    assert found(workspace) == both
    assert found(workspace / "arm_start" / "launch" / "arm.launch.py") == both[1:]
    assert found(workspace / "arm_start" / "config" / "controllers.yaml") == both[:1]


def test_the_nearest_names_are_given(workspace):
    messages = [finding.message for finding in lint(workspace, select=("K95",))]
    assert any("did you mean `elbow`?" in message for message in messages)
    assert any("did you mean `arm.urdf`?" in message for message in messages)


def test_of_a_package_that_does_not_depend_on_it_only_the_files_it_names_are_checked(workspace):
    (workspace / "arm_start" / "package.xml").write_text("<package><name>start</name></package>")
    assert found(workspace) == [("K958", "arm.launch.py", 7, 13)]


def test_what_the_build_makes_or_takes_from_elsewhere_is_there(workspace):
    launch = workspace / "arm_description" / "launch.launch"
    launch.write_text('<launch><param textfile="$(find arm_description)/arms.urdf"/></launch>')
    assert ("K958", "launch.launch", 1, 26) in found(workspace)
    (workspace / "arm_description" / "CMakeLists.txt").write_text("xacro_add_files(urdf/arms.urdf.xacro)")
    assert found(workspace) == [("K959", "controllers.yaml", 3, 10)]


@pytest.mark.parametrize(
    "other",
    [
        '<robot name="b"><link name="base"/><joint name="elbo" type="fixed"/></robot>',
        """<robot name="b" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m" params="p">
        <joint name="${p}bo" type="fixed"/></xacro:macro></robot>""",
    ],
)
def test_joints_that_other_descriptions_may_have_are_let_pass(workspace, other):
    (workspace / "arm_description" / "urdf" / "other.xacro").write_text(other)
    assert not [row for row in found(workspace) if row[0] == "K959"]


def test_joints_under_conditions_are_let_pass(workspace):
    (workspace / "arm_description" / "urdf" / "arm.urdf").write_text(
        ARM.replace("</robot>", '<xacro:if value="0"><joint name="elbo"/></xacro:if></robot>').replace(
            "<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"'
        )
    )
    assert not [row for row in found(workspace) if row[0] == "K959"]


CALLS = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="sim" default="true"/>
  <link name="base"/>
  <xacro:macro name="segment" params="name">
    <link name="${{name}}"/>
    <joint name="${{name}}" type="fixed"><parent link="base"/><child link="${{name}}"/></joint>
  </xacro:macro>
  <xacro:segment name="elbow"/>
  <xacro:if value="${{not $(arg sim)}}"><xacro:segment name="{other}"/></xacro:if>
  <xacro:macro name="control" params="joint">
    <joint name="${{joint}}"><command_interface name="position"/></joint>
  </xacro:macro>
  <ros2_control name="c" type="system"><xacro:control joint="elbow"/></ros2_control>
</robot>
"""


@pytest.mark.parametrize(
    ("other", "is_found"),
    [
        ("elbo", False),
        ("wrist", True),
        ("${tool}", False),
        ("${tool}bo", False),
        ("${tool}wrist", True),
        ("a${{1:2}[1]}", False),
    ],
)
def test_of_names_that_macros_make_those_count_that_their_calls_give(workspace, other, is_found):
    (workspace / "arm_description" / "urdf" / "arm.urdf").unlink()
    (workspace / "arm_description" / "urdf" / "arm.urdf.xacro").write_text(CALLS.format(other=other))
    assert any(row[0] == "K959" for row in found(workspace)) is is_found


OTHER_MACRO = """  <xacro:macro name="scanner" params="name {default}">
    <link name="${{{inner}}}_bo"/><joint name="${{{inner}}}bo" type="fixed"/>
  </xacro:macro>
  <xacro:scanner name="front"/>
"""


@pytest.mark.parametrize(
    ("default", "inner", "called", "is_found"),
    [
        ("side:=left", "name", "scanner", True),
        ("side:=left", "side", "scanner", True),
        ("side:=el", "side", "scanner", False),
        ("side:=left", "other", "scanner", False),  # a parameter of the caller
        ("side:=left", "name", "call", False),  # a macro whose name is computed
    ],
)
def test_the_parameters_of_a_macro_have_the_values_of_its_own_calls(workspace, default, inner, called, is_found):
    (workspace / "arm_description" / "urdf" / "arm.urdf").unlink()
    text = OTHER_MACRO.format(default=default, inner=inner).replace("<xacro:scanner", f"<xacro:{called}")
    robot = CALLS.format(other="el").replace('name="elbow"/>', 'name="elbow" other="el"/>', 1)
    robot = robot.replace("  <ros2_control", f"{text}  <ros2_control")
    (workspace / "arm_description" / "urdf" / "arm.urdf.xacro").write_text(robot)
    assert any(row[0] == "K959" for row in found(workspace)) is is_found


PROPERTY = """  <xacro:macro name="limb" params="name">
    <xacro:property name="{property}" {value}
    <xacro:segment name="${{joint_name}}_x"/><joint name="${{joint_name}}bo" type="fixed"/>
  </xacro:macro>
  <xacro:limb name="front"/>
"""


@pytest.mark.parametrize(
    ("property", "value", "is_found"),
    [
        ("joint_name", 'value="left_${name}"/>', True),
        ("joint_name", "default='el'/>", False),
        ("joint_name", 'value="${{1:2}[1]}"/>', False),
        ("joint_name", "><a/></xacro:property>", False),
        ("other", 'value="el"/>', False),
    ],
)
def test_a_property_in_a_name_has_its_own_values(workspace, property, value, is_found):
    (workspace / "arm_description" / "urdf" / "arm.urdf").unlink()
    robot = CALLS.format(other="el").replace(
        "  <ros2_control", f"{PROPERTY.format(property=property, value=value)}  <ros2_control"
    )
    (workspace / "arm_description" / "urdf" / "arm.urdf.xacro").write_text(robot)
    assert any(row[0] == "K959" for row in found(workspace)) is is_found


def test_the_name_of_the_package_in_its_build_files_makes_no_file(workspace):
    launch = workspace / "arm_description" / "launch.launch"
    launch.write_text('<launch><param textfile="$(find arm_description)/urdf/arm_description.urdf"/></launch>')
    (workspace / "arm_description" / "CMakeLists.txt").write_text("project(arm_description)\n")
    assert ("K958", "launch.launch", 1, 26) in found(workspace)


def test_what_was_found_before_is_found_anew_once_a_file_comes_or_changes(workspace, tmp_path, monkeypatch):
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "cache"))

    def again() -> tuple[set[str], int]:
        outcome = run(find_entries([workspace / "arm_description"]), Options(select=("K958", "K959")), cached=True)
        return {finding.code for finding in outcome.findings}, outcome.cached

    assert again() == ({"K958", "K959"}, 0)
    assert again() == ({"K958", "K959"}, 1)
    (workspace / "arm_start" / "config" / "controllers.yaml").write_text(CONTROLLERS.replace("elbo", "elbow"))
    assert again() == ({"K958"}, 0)
    (workspace / "arm_description" / "urdf" / "arms.urdf").write_text(ARM.replace('"arm"', '"arms"'))
    assert again()[0] == set()
    (workspace / "arm_start" / "launch" / "more.launch").write_text('<a b="$(find arm_description)/none.yaml"/>')
    assert again() == ({"K958"}, 0)


SELF_REFERENCES = ["é", 'é / "a"', 'é + "/a"', 'os.path.join(é, "a")', '[é, "/a"]', 'f"{é}/a"']
"""Expressions that are assigned to the name that they use."""


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ('os.path.join(get_package_share_directory("p"), "a", "b.urdf")', ["a/b.urdf"]),
        ('PathJoinSubstitution([FindPackageShare("p"), "a", "b.urdf"])', ["a/b.urdf"]),
        ('PathJoinSubstitution([FindPackageShare(package="p"), "a"])', ["a"]),
        ('get_package_share_directory("p") + "/a/b.urdf"', ["a/b.urdf"]),
        ('Path(get_package_share_directory("p")) / "a" / "b.urdf"', ["a/b.urdf"]),
        ('os.path.join(get_package_share_directory("p"), name)', []),
        ('os.path.join(get_package_share_directory(which), "a")', []),
        ('os.path.exists(os.path.join(get_package_share_directory("p"), "a"))', []),
        ('(Path(get_package_share_directory("p")) / "a").exists()', []),
        ('get_package_share_directory("p") + "_more/a"', []),
        ('f"{get_package_share_directory(chr(112))}/a"', []),
        ("get_package_share_directory(((", []),
        *((f'{path} or get_package_share_directory("p")', []) for path in SELF_REFERENCES),
    ],
)
def test_paths_in_python(line, named):
    assert [path.path for path in package_paths(Source("x.launch.py", f"é = {line}\n"))] == named


def test_controllers_and_joints_in_yaml():
    text = (
        "a:\r\n  ros__parameters:\r\n    type: x_controllers/Y\r\n    joints:\r\n    - 'one'\r\n\r\n    - two\r\n"
        '    rate: 3\r\nb:\n  type: y_controller/Z\n  left_wheel_names: [\n    three, # left\n    "four"]\n'
    )
    source = Source("c.yaml", text)
    assert controllers(source) == ["a", "b"]
    assert [named.name for named in joints(source)] == ["one", "two", "three", "four"]
    assert all(text[named.start :].startswith(named.name) for named in joints(source))
    assert list(joints(Source("c.yaml", "joints: [one]\n"))) == []


def test_a_spawner_in_python(workspace):
    launch = workspace / "arm_start" / "launch" / "arm.launch.py"
    node = 'Node(package="controller_manager", executable="spawner", arguments=["--param-file", "x", "{}"])\n'
    launch.write_text("n = " + node.format("arm_controler"))
    assert ("K960", "arm.launch.py", 1, launch.read_text().index("arm_contr") + 1) in found(workspace)
    launch.write_text("n = " + node.format("arm_controller"))
    assert not [row for row in found(workspace) if row[0] == "K960"]


def test_a_spawner_in_yaml(workspace):
    launch = workspace / "arm_start" / "launch" / "arm.launch.yaml"
    node = """launch:
- group:
  - node:
      pkg: controller_manager
      exec: spawner  # args: "arm_controlle"
      args: {}
"""
    for args in ('"--param-file x arm_controler"', "$(var first) arm_controler"):
        launch.write_text(node.format(args))
        column = launch.read_text().splitlines()[5].index("arm_controler") + 1
        assert ("K960", "arm.launch.yaml", 6, column) in found(workspace)
    for args in ("arm_controller", '"--param-file arm_controler"', '"$(var prefix)arm_controler"', "[arm_controler]"):
        launch.write_text(node.format(args))
        assert not [row for row in found(workspace) if row[0] == "K960"]


def test_launch_files_need_what_they_start_and_include(workspace):
    (workspace / "arm_start" / "launch" / "arm.launch.py").write_text(
        "from ament_index_python.packages import get_package_share_directory\n"
        "from launch_ros.actions import Node\n"
        "OURS = 'arm_description'\n"
        "def generate_launch_description():\n"
        "    share = get_package_share_directory('other_settings')\n"
        "    nodes = [Node(package='rviz2', executable='rviz2'), Node(package='rviz2', executable='again')]\n"
        "    nodes += [Node(package=OURS, executable='x'), Node(package=name(), executable='y')]\n"
    )
    (workspace / "arm_description" / "view.launch").write_text(
        '<launch>\n<!-- <node pkg="gone" type="x"/> -->\n<node pkg="rviz" type="rviz"/>\n'
        '<include file="$(find arm_start)/launch/x.launch"/></launch>\n'
    )
    findings = [each for finding in lint(workspace) if finding.code == "K956" for each in finding.related]
    assert [(f.file.rpartition("/")[2], f.line, f.message.split("`")[1]) for f in findings] == [
        ("view.launch", 4, "arm_start"),
        ("view.launch", 3, "rviz"),
        ("arm.launch.py", 5, "other_settings"),
        ("arm.launch.py", 6, "rviz2"),
        ("arm.launch.py", 6, "rviz2"),
    ]


def test_links_in_settings_are_compared_with_those_of_every_description_around(workspace):
    settings = workspace / "arm_start" / "config" / "controllers.yaml"
    settings.write_text("base_frame: bas\ntip_link: uper\nrobot_base_frame: somewhere\n# base_frame: bse\n")
    findings = [finding for finding in lint(workspace) if finding.code == "K961"]
    assert [(f.line, f.column, f.message) for f in findings] == [
        (1, 13, "`base_frame` is `bas`, but robot `arm` has no such link; did you mean `base`?"),
        (2, 11, "`tip_link` is `uper`, but robot `arm` has no such link; did you mean `upper`?"),
    ]
    (workspace / "arm_description" / "urdf" / "other.urdf").write_text('<robot name="o"><link name="bas"/></robot>')
    assert {f.line for f in lint(workspace) if f.code == "K961" and "`arm`" in f.message} == {2}


def test_a_manifest_that_is_being_edited_counts_as_it_is_in_the_editor(tmp_path, monkeypatch):
    folder = package(tmp_path / "arm_description")
    monkeypatch.chdir(folder)
    file = folder / "arm.urdf.xacro"
    file.write_text('<robot name="a"><link name="b"/><!-- $(find x) --><material name="$(find arm_msgs)"/></robot>')
    needs = "<package><name>arm_description</name><depend>arm_msgs</depend></package>"

    def codes(texts):
        outcome = run(find_entries([file]), Options(select=("K956",), texts=texts))
        return [finding.code for finding in outcome.findings]

    assert codes({}) == ["K956"]
    assert codes({str(folder / "package.xml"): needs}) == []
    assert codes({str(folder / "package.xml"): f"<!-- {needs} -->"}) == ["K956"]


def test_what_launch_files_in_python_hand_to_gazebo(tmp_path):
    (tmp_path / "package.xml").write_text(
        "<package format='3'><name>cart</name><version>1.0.0</version><exec_depend>ros_gz_sim</exec_depend>"
        "<exec_depend>ros_gz_bridge</exec_depend></package>"
    )
    (tmp_path / "cart.urdf").write_text("<robot name='cart'><link name='base'/></robot>")
    launch = tmp_path / "cart.launch.py"
    lines = (
        "from launch import LaunchDescription; from launch_ros.actions import Node",
        'Node(package="ros_gz_sim", executable="create", arguments=["-nmae", "cart", "-topic", "robot_descripton"])',
        'Node(package="ros_gz_bridge", executable="parameter_bridge", arguments=[',
        '    "/cmd_vel@geometry_msgs/msg/Twist]gz.msgs.Twits",',
        '    "/scan@sensor_msgs/msg/LaserScan[gz.msgs.PointCloudPacked",',
        '    "/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock", "--ros-args"])',
        "def generate_launch_description():",
        "    return LaunchDescription([])",
    )
    launch.write_text("\n".join(lines))
    found = [(f.code, f.line, f.column) for f in lint(tmp_path, target="ros2") if f.code != "L105"]
    assert found == [
        ("K968", 2, lines[1].index("-nmae") + 1),
        ("K968", 2, lines[1].index("robot_descripton") + 1),
        ("K969", 4, lines[3].index("gz.msgs") + 1),
        ("K969", 5, lines[4].index("gz.msgs") + 1),
    ]


HARDWARE = """<robot name='arm' xmlns:xacro='http://www.ros.org/wiki/xacro'>
  <link name='base'/><link name='upper'/>
  <joint name='elbow' type='fixed'><parent link='base'/><child link='upper'/></joint>
  <ros2_control name='arm' type='system'>
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <joint name='elbow'>{}</joint>
  </ros2_control>
</robot>"""


@pytest.mark.parametrize(
    ("interfaces", "other", "is_found"),
    [
        ("<command_interface name='position'/>", "", True),
        ("<xacro:if value='true'><command_interface name='position'/></xacro:if>", "", True),
        ("<xacro:if value='false'><command_interface name='velocity'/></xacro:if>", "", False),
        ("<command_interface name='position'/>", HARDWARE.format("<command_interface name='velocity'/>"), False),
        ("<command_interface name='velocity'/>", "", False),
    ],
)
def test_interfaces_that_other_files_may_provide_are_not_reported(tmp_path, interfaces, other, is_found):
    (tmp_path / "package.xml").write_text("<package format='3'><name>arm</name><version>1.0.0</version></package>")
    (tmp_path / "arm.urdf.xacro").write_text(HARDWARE.format(interfaces))
    if other:
        (tmp_path / "other.urdf.xacro").write_text(other)
    (tmp_path / "arm.yaml").write_text(
        "controller_manager:\n  ros__parameters:\n"
        "    group: {type: velocity_controllers/JointGroupVelocityController}\n"
        "group:\n  ros__parameters:\n    joints: [elbow]\n"
    )
    assert ("K965" in {finding.code for finding in lint(tmp_path / "arm.urdf.xacro", target="ros2")}) is is_found


def test_a_package_whose_settings_a_plugin_reads_is_looked_at(tmp_path):
    description, control = tmp_path / "arm_description", tmp_path / "own_control"
    description.mkdir()
    control.mkdir()
    for folder in (description, control):
        (folder / "package.xml").write_text(f"<package><name>{folder.name}</name></package>")
    settings = control / "controllers.yaml"
    plugin = '<plugin name="control" filename="libgazebo_ros2_control.so"><parameters>{}</parameters></plugin>'
    text = '<robot name="arm"><link name="base"/>\n<gazebo>{}</gazebo></robot>'
    (description / "arm.urdf").write_text(text.format(plugin.format(settings)))
    lines = "controller_manager:\n  ros__parameters:\n    {}\n    use_sim_time: true\n"
    settings.write_text(lines.format("update_rate 100"))
    assert [(f.code, f.line) for f in lint(description, target="ros2")] == [("K966", 3)]
    settings.write_text(lines.format("update_rate: 100"))
    assert lint(description, target="ros2") == []
    settings.write_text(lines.format("update_rate 100"))
    (description / "arm.urdf").write_text(text.format(""))
    assert lint(description, target="ros2") == []


@pytest.mark.parametrize(
    ("lines", "place", "reported"),
    [
        ("a:\n  b\n  - one\n  - two\n  c: 1\n", 2, "missing colon after `b`"),
        ("a:\n  b: 1\n  c:2\n  d: 3\n", 3, "missing space after `c:`"),
        ("a: {b: 1\nc: 2\n", 2, "expected"),
        ("a:\n  b: 'open\n", 3, "end of stream"),
    ],
)
def test_where_a_text_ceases_to_be_yaml(tmp_path, lines, place, reported):
    (tmp_path / "package.xml").write_text("<package><name>arm</name></package>")
    (tmp_path / "arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
    (tmp_path / "arm.yaml").write_text(lines)
    (found,) = lint(tmp_path)
    assert (found.code, found.line) == ("K966", place), found
    assert reported in found.message


def test_what_a_condition_holds():
    from urdfkit.lint.facts.conditions import is_conditional

    assert is_conditional('<xacro:if value="1"><gazebo/></xacro:if>', "<gazebo")
    assert not is_conditional('<xacro:if value="1"><link/></xacro:if><gazebo/>', "<gazebo")
    assert not is_conditional('<gazebo/><xacro:unless value="1"/>', "<gazebo")


def test_a_misspelt_interface_of_hardware_is_one_finding(tmp_path):
    package(tmp_path / "arm")
    (tmp_path / "arm" / "arm.urdf").write_text(HARDWARE_WITH.format(joint="elbow", name="positon"))
    (tmp_path / "arm" / "arm.yaml").write_text(TRAJECTORIES)
    assert [f.code for f in lint(tmp_path) if f.code.startswith(("C", "K96"))] == ["C710"]
    (tmp_path / "arm" / "arm.urdf").write_text(HARDWARE_WITH.format(joint="elbw", name="position"))
    assert [f.code for f in lint(tmp_path) if f.code.startswith(("C", "K96"))] == ["C707"]
    (tmp_path / "arm" / "arm.urdf").write_text(HARDWARE_WITH.format(joint="elbow", name="velocity"))
    assert [f.code for f in lint(tmp_path) if f.code.startswith(("C", "K96"))] == ["K965"]


HARDWARE_WITH = """<robot name='arm'>
  <link name='base'/><link name='upper'/>
  <joint name='elbow' type='continuous'><parent link='base'/><child link='upper'/><axis xyz='0 0 1'/></joint>
  <ros2_control name='arm' type='system'>
    <hardware><plugin>own_hardware/Arm</plugin></hardware>
    <joint name='{joint}'><command_interface name='{name}'/><state_interface name='position'/></joint>
  </ros2_control>
</robot>
"""
TRAJECTORIES = """controller_manager:
  ros__parameters:
    arm_controller: {type: joint_trajectory_controller/JointTrajectoryController}
arm_controller:
  ros__parameters: {joints: [elbow], command_interfaces: [position], state_interfaces: [position]}
"""


def test_a_misspelt_interface_of_a_transmission_is_one_finding(tmp_path):
    package(tmp_path / "arm")
    part = (
        "<transmission name='t'><type>transmission_interface/SimpleTransmission</type><joint name='elbow'>"
        "<hardwareInterface>hardware_interface/{}</hardwareInterface></joint><actuator name='m'/></transmission>"
        "</robot>"
    )
    (tmp_path / "arm" / "arm.yaml").write_text(CONTROLLERS.replace("elbo", "elbow"))
    for name, code in (("PositionJointIntreface", "C703"), ("EffortJointInterface", "K963")):
        (tmp_path / "arm" / "arm.urdf").write_text(ARM.replace("</robot>", part.format(name)))
        assert [f.code for f in lint(tmp_path, target="ros1") if f.severity != "note"] == [code]
