"""Contradictions of two places: the finding is at the wrong one, and lists the others."""

from __future__ import annotations

import json

import pytest

from urdfkit.description.xml.source import Span
from urdfkit.lint import lint
from urdfkit.lint.engine.consequences import without_consequences
from urdfkit.lint.engine.contradictions import at_wrong_side
from urdfkit.lint.engine.run import run
from urdfkit.lint.finding import Finding, Fix
from urdfkit.lint.project.entry_files import find_entries
from urdfkit.lint.project.options import Options
from urdfkit.lint.report.sarif import as_sarif

MANIFEST = """<package format="3">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>A robot for tests.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
{needed}
  <export><build_type>ament_cmake</build_type></export>
</package>
"""


def package(folder, *needed):
    folder.mkdir(parents=True, exist_ok=True)
    lines = "\n".join(f"  <exec_depend>{each}</exec_depend>" for each in needed)
    (folder / "package.xml").write_text(MANIFEST.format(name=folder.name, needed=lines))
    return folder


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def rows(folder, code):
    """Return file, line and message of the findings of a rule, and the lines of their other places."""
    return [
        (each.file.rpartition("/")[2], each.line, each.message, [one.line for one in each.related])
        for each in lint(folder)
        if each.code == code
    ]


def finding(code, line, other=None, **details):
    span = Span("a", line, 1, line, 2)
    return Finding(code, "x", "warning", f"message {line}", span, other=other, **details)


PLACE = Span("b", 7, 1, 7, 2)


def test_a_place_that_different_findings_contradict_is_reported():
    first, second, apart = (
        finding("M107", 1, PLACE, fix=Fix("unsafe", "Guess", ())),
        finding("M105", 2, PLACE),
        finding("X", 3),
    )
    moved, left = at_wrong_side([first, second, apart])
    assert (moved.span, moved.code, moved.fix, left) == (PLACE, "M105", None, apart)
    assert [each.line for each in moved.related] == [1, 2]


@pytest.mark.parametrize("cause", ["", "state"])
def test_one_finding_or_several_with_one_cause_stay(cause):
    found = [finding("M107", line, PLACE, cause=cause) for line in ((1, 2) if cause else (1,))]
    assert at_wrong_side(found) == found


def test_evidence_of_the_rule_moves_one_finding_for_each_cause():
    found = [
        finding("K956", line, PLACE, cause=cause, is_other_wrong=True) for line, cause in ((1, "a"), (2, "b"), (3, "a"))
    ]
    assert [(each.span, len(each.related)) for each in at_wrong_side(found)] == [(PLACE, 2), (PLACE, 1)]


LAUNCH = """<launch>
  <node pkg="joy" exec="joy_node"/>
  <node pkg="joy" exec="joy_node" name="again"/>
</launch>
"""


@pytest.mark.parametrize(
    ("needed", "line"),
    [(("controller_manager", "launch_xml"), 8), (("zeta", "launch_xml"), 9), (("launch_xml",), 8), ((), 10)],
)
def test_a_missing_dependency_is_reported_where_it_is_to_be_added(tmp_path, needed, line):
    cart = package(tmp_path / "cart", *needed)
    write(cart / "launch/joy.launch.xml", LAUNCH)
    found = [row for row in rows(cart, "K956") if "joy" in row[2]]
    assert found == [("package.xml", line, "missing dependency on `joy`", [2, 3])]


def test_other_places_are_in_all_formats_and_in_the_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "cache"))
    cart = package(tmp_path / "cart", "launch_xml")
    write(cart / "launch/joy.launch.xml", LAUNCH)
    for _ in range(2):
        outcome = run(find_entries([cart]), Options(select=("K956",)), cached=True)
        assert [[one["line"] for one in each.to_json()["related"]] for each in outcome.findings] == [[2, 3]]
    (result,) = json.loads(as_sarif(outcome.findings))["runs"][0]["results"]
    assert [each["physicalLocation"]["region"]["startLine"] for each in result["relatedLocations"]] == [2, 3]
    assert outcome.cached == 1


@pytest.mark.parametrize("comment", ["", "  <!-- urdfkit: ignore K956 -->"])
def test_a_comment_at_the_use_suppresses_the_finding(tmp_path, comment):
    cart = package(tmp_path / "cart", "xacro")
    link = f'<link name="base"/>\n  <xacro:property name="a" value="$(find other_description)/a"/>{comment}\n'
    write(
        cart / "urdf/cart.xacro", f'<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">\n{link}</robot>\n'
    )
    assert [row[:2] for row in rows(cart, "K956")] == ([] if comment else [("package.xml", 8)])
    assert rows(cart, "E019") == []


ARM = """<robot name="arm">
  <link name="base"/>
  <link name="hand"/>
  <joint name="elbow" type="fixed">
    <parent link="base"/><child link="hand"/><axis xyz="0 0 1"/>
    {limit}
  </joint>
  <ros2_control name="arm" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <joint name="elbow"><command_interface name="position"/><state_interface name="position"/></joint>
  </ros2_control>
</robot>
"""


@pytest.mark.parametrize("limit", ["", '<limit lower="-1" upper="1" effort="1" velocity="1"/>'])
def test_a_fixed_joint_with_limits_is_wrong_and_not_the_interface_that_commands_it(tmp_path, limit):
    write(tmp_path / "arm.urdf", ARM.format(limit=limit))
    message = "<ros2_control> `arm` commands the fixed joint `elbow`"
    assert rows(tmp_path, "C707") == [("arm.urdf", 4 if limit else 10, message, [10] if limit else [])]


CAMERA = """<robot name="cart">
  <link name="base"/>
  <gazebo reference="base">
    <sensor name="eye" type="camera">
      <topic>{topic}</topic>
    </sensor>
    <sensor name="imu" type="imu">
      <topic>{imu}</topic>
    </sensor>
  </gazebo>
</robot>
"""


def bridged(*topics):
    types = {"points": ("PointCloud2", "PointCloudPacked"), "imu": ("Imu", "IMU")}
    entries = []
    for ros, gazebo in topics:
        kinds = next((pair for word, pair in types.items() if word in ros), ("Image", "Image"))
        entry = f"- ros_topic_name: {ros}\n  gz_topic_name: {gazebo}\n  ros_type_name: sensor_msgs/msg/{kinds[0]}\n"
        entries.append(f"{entry}  gz_type_name: gz.msgs.{kinds[1]}\n  direction: GZ_TO_ROS\n")
    return "".join(entries)


def test_a_camera_below_whose_topic_bridges_read_clouds_has_the_wrong_type(tmp_path):
    cart = package(tmp_path / "cart", "ros_gz_bridge")
    write(cart / "urdf/cart.urdf", CAMERA.format(topic="eye", imu="imu"))
    write(
        cart / "config/bridge.yaml", bridged(("eye/image", "eye/image"), ("eye/points", "eye/points"), ("imu", "imu"))
    )
    message = "a sensor of type `camera` has no topic `eye/image`, which a bridge reads"
    (found,) = [each for each in lint(cart) if each.code == "K969"]
    assert (found.line, found.message, found.help) == (4, message, "write `rgbd_camera`, which has topics below `eye`")
    write(cart / "config/bridge.yaml", bridged(("eye/image", "eye/image"), ("imu", "imu")))
    assert [row[0] for row in rows(cart, "K969")] == ["bridge.yaml"]


@pytest.mark.parametrize(
    ("ros", "gazebo", "file"), [("body/imu", "body/imu", "cart.urdf"), ("imu", "body/imu", "bridge.yaml")]
)
def test_a_bridge_with_equal_names_names_the_topic_of_the_sensor(tmp_path, ros, gazebo, file):
    cart = package(tmp_path / "cart", "ros_gz_bridge")
    write(cart / "urdf/cart.urdf", CAMERA.format(topic="eye", imu="pelvis"))
    write(cart / "config/bridge.yaml", bridged(("eye", "eye"), (ros, gazebo)))
    (row,) = rows(cart, "K969")
    assert row[0] == file
    assert (row[2] == "a bridge reads `body/imu`, but this sensor publishes on `pelvis`") is (file == "cart.urdf")


@pytest.mark.parametrize(
    ("ros", "gazebo", "is_reported"), [("right/eye", "left/eye", True), ("eye", "left/eye", False)]
)
def test_a_bridge_of_topics_of_two_sides_is_wrong(tmp_path, ros, gazebo, is_reported):
    cart = package(tmp_path / "cart", "ros_gz_bridge")
    write(cart / "urdf/cart.urdf", CAMERA.format(topic="left/eye", imu="right/imu"))
    write(cart / "config/bridge.yaml", bridged(("left/eye", "left/eye"), (ros, gazebo)))
    message = "the bridge connects `right/eye` with `left/eye` on the other side; did you mean `right/eye`?"
    expected = [("bridge.yaml", 7, message, [])] if is_reported else []
    assert [row for row in rows(cart, "K969") if "other side" in row[2]] == expected


ARMS = "".join(
    f'  <link name="{side}_{part}"/>\n  <joint name="{side}_{part}_joint" type="continuous">'
    f'<parent link="base"/><child link="{side}_{part}"/></joint>\n'
    for side in ("left", "right")
    for part in ("shoulder", "elbow")
)
SIDED = """controller_manager:
  ros__parameters:
    NAME:
      type: joint_trajectory_controller/JointTrajectoryController
NAME:
  ros__parameters:
    joints: [left_shoulder_joint, JOINT]
    command_interfaces: [position]
    state_interfaces: [position]
    constraints:
      left_elbow_joint: {goal: 0.1}
"""


@pytest.mark.parametrize(
    ("name", "joint", "is_reported"),
    [
        ("left_arm", "left_elbow_joint", False),
        ("left_arm", "right_elbow_joint", True),
        ("arms", "right_elbow_joint", False),
    ],
)
def test_a_joint_of_the_other_side_is_reported_in_the_list_of_its_controller(tmp_path, name, joint, is_reported):
    cart = package(tmp_path / "cart", "joint_trajectory_controller")
    write(cart / "urdf/cart.urdf", f'<robot name="cart">\n  <link name="base"/>\n{ARMS}</robot>\n')
    write(cart / "config/arm.yaml", SIDED.replace("NAME", name).replace("JOINT", joint))
    message = "`joints` of controller `left_arm` lists `right_elbow_joint`, which is on the other side"
    message += "; did you mean `left_elbow_joint`?"
    found = rows(cart, "K976")
    sides = [row for row in found if "on the other side" in row[2]]
    assert sides == ([("arm.yaml", 7, message, [])] if is_reported else [])
    assert found == sides or name != "left_arm"


@pytest.mark.parametrize(
    ("cause", "kind", "consequence"),
    [("K976", "side", "M112"), ("K976", "side", "K971"), ("K965", "joint", "M112"), ("K971", "", "K982")],
)
def test_consequences_of_a_wrong_joint_and_of_a_wrong_speed_are_left_out(cause, kind, consequence):
    line = 1 if cause == "K971" else 2
    first, second = finding(cause, 1, names=("elbow",), kind=kind), finding(consequence, line, names=("elbow",))
    assert without_consequences([first, second]) == [first]
    assert without_consequences([second]) == [second]


INCLUDED = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("server_only", default_value="false"),
        Node(package="joy", executable="joy_node", condition=IfCondition(LaunchConfiguration("headless"))),
    ])
"""
INCLUDING = """<launch>
  <arg name="headless" default="true"/>
  <include file="$(find-pkg-share cart)/launch/sim.launch.py">
    <arg name="headless" value="$(var headless)"/>
  </include>
</launch>
"""


def test_the_unused_declaration_stands_for_the_argument_without_one(tmp_path):
    cart = package(tmp_path / "cart", "joy", "launch", "launch_ros", "launch_xml")
    write(cart / "launch/sim.launch.py", INCLUDED)
    write(cart / "launch/cart.launch.xml", INCLUDING)
    (found,) = [each for each in lint(cart) if each.code == "L101"]
    assert found.message == "launch argument `server_only` is declared but not used, and `headless` is not declared"
    assert (found.line, found.help) == (10, "declare `headless` instead, or in addition")
    write(cart / "launch/sim.launch.py", INCLUDED.replace('"false"),', '"false"), DeclareLaunchArgument("more"),'))
    assert [row[1] for row in rows(cart, "L101")] == [11]


HANDLERS = """from launch import LaunchDescription
from launch.actions import RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node


def generate_launch_description():
    first = Node(package="joy", executable="joy_node", name="first")
    second = Node(package="joy", executable="joy_node", name="second")
    third = Node(package="joy", executable="joy_node", name="third")
    return LaunchDescription([
        first,
        RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[{started}])),
        RegisterEventHandler(OnProcessExit(target_action=second, on_exit=[third])),
    ])
"""


def test_an_action_in_the_place_of_another_one_gives_one_finding(tmp_path):
    cart = package(tmp_path / "cart", "joy", "launch", "launch_ros")
    text = HANDLERS.format(started="second").replace("on_exit=[third]", "on_exit=[second]")
    write(cart / "launch/cart.launch.py", text)
    write(cart / "urdf/cart.urdf", '<robot name="cart"><link name="base"/></robot>')
    (found,) = [each for each in lint(cart) if each.code in ("L106", "L107")]
    assert (found.code, found.line) == ("L107", 14)
    assert found.help == "`second` waits for its own exit; `third` is probably intended"


LISTS = """from launch import LaunchDescription
from launch.actions import OpaqueFunction
from launch_ros.actions import Node


def setup(context):
    first = Node(package="joy", executable="joy_node", name="first")
    second = Node(package="joy", executable="joy_node", name="second")
    third = Node(package="joy", executable="joy_node", name="third")
    {statement}


def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=setup)])
"""


@pytest.mark.parametrize(
    ("statement", "line"),
    [
        ("return [\n        first,\n        second,\n    ]", 12),
        ("nodes = [\n        first,\n        second,\n    ]\n    return LaunchDescription(nodes)", 12),
        ("return [\n        second\n    ] + list(context)", 11),
        ("return [first, second] if context else [second]", 9),
    ],
)
def test_an_unused_action_is_reported_at_the_returned_list(tmp_path, statement, line):
    cart = package(tmp_path / "cart", "joy", "launch", "launch_ros")
    write(cart / "launch/cart.launch.py", LISTS.format(statement=statement))
    (found,) = [each for each in lint(cart) if each.code == "L107" and "`third`" in each.message]
    assert found.line == line


@pytest.mark.parametrize(("started", "line"), [("first", 13), ("third", 12)])
def test_a_handler_that_starts_an_action_again_is_wrong(tmp_path, started, line):
    cart = package(tmp_path / "cart", "joy", "launch", "launch_ros")
    write(cart / "launch/cart.launch.py", HANDLERS.format(started=started))
    (found,) = [each for each in lint(cart) if each.code == "L107"]
    assert (found.line, found.help) == (line, "`first` is started twice" if line == 13 else None)


TWINS = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="base"/>
  <xacro:macro name="hinge" params="name side axis">
    <link name="${name}_link"/>
    <joint name="${name}_joint" type="revolute">
      <parent link="base"/><child link="${name}_link"/>
      <origin xyz="0 ${side} 0"/>
      <axis xyz="${axis}"/>
      <limit lower="-0.1" upper="1.6" effort="1" velocity="1"/>
    </joint>
  </xacro:macro>
  <xacro:macro name="wing" params="prefix side">
    <xacro:hinge name="${prefix}_wing" side="${side}" axis="AXIS"/>
  </xacro:macro>
  <xacro:wing prefix="left" side="1"/>
  <xacro:wing prefix="right" side="-1"/>
</robot>
"""


def test_a_value_of_both_twins_is_reported_where_it_is_common_to_them(tmp_path):
    write(tmp_path / "cart.xacro", TWINS.replace("AXIS", "0 ${side} 0"))
    (found,) = [each for each in lint(tmp_path) if each.code == "S919"]
    assert found.line == 13
    write(tmp_path / "cart.xacro", TWINS.replace("AXIS", "${side} 0 0"))
    assert "S919" not in {each.code for each in lint(tmp_path)}


INERTIA = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="inertial_cylinder" params="m r h rpy:='0 0 0'">
    <inertial>
      <origin xyz="0 0 0" rpy="${rpy}"/>
      <mass value="${m}"/>
      <inertia ixx="${m*(3*r*r+h*h)/12}" ixy="0" ixz="0" iyy="${m*(3*r*r+h*h)/12}" iyz="0" izz="${m*r*r/2}"/>
    </inertial>
  </xacro:macro>
  <link name="base">
    <xacro:inertial_cylinder m="10" r="0.2" h="0.05"/>
    <collision><geometry><cylinder radius="0.2" length="0.05"/></geometry></collision>
  </link>
  <link name="wheel">
    <xacro:inertial_cylinder m="2" r="0.1" h="0.02"/>
    <collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="0.1" length="0.02"/></geometry></collision>
  </link>
  <joint name="wheel_joint" type="continuous"><parent link="base"/><child link="wheel"/><axis xyz="0 1 0"/></joint>
</robot>
"""


def test_a_macro_that_is_right_elsewhere_is_called_wrongly(tmp_path):
    write(tmp_path / "cart.xacro", INERTIA)
    assert [row[1] for row in rows(tmp_path, "I519")] == [14]
