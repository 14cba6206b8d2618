"""Interfaces that the hardware lacks for several controllers are reported at the hardware, once."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license>
  <export><build_type>ament_cmake</build_type></export></package>"""
JOINT = """  <link name="lN"/>
  <joint name="jN" type="revolute"><parent link="lM"/><child link="lN"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="5" velocity="1"/></joint>
"""
ROBOT = f"""<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="driven" params="name">
    <joint name="${{name}}">
      <command_interface name="position"/>
      <state_interface name="position"/>
      <state_interface name="velocity"/>
    </joint>
  </xacro:macro>
  <link name="l0"/>
{"".join(JOINT.replace("N", str(n)).replace("M", str(n - 1)) for n in (1, 2))}
  <ros2_control name="arm" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <xacro:driven name="j1"/>
    <xacro:driven name="j2"/>
  </ros2_control>
</robot>"""
SETTINGS = """NAME:
  ros__parameters:
    joints: [JOINT]
    command_interfaces: [position]
    state_interfaces: [position, velocity]
"""
KIND = "      type: joint_trajectory_controller/JointTrajectoryController\n"


def found(folder, robot, names):
    (folder / "config").mkdir()
    manager = "controller_manager:\n  ros__parameters:\n" + "".join(f"    {name}:\n{KIND}" for name in names)
    sections = "".join(SETTINGS.replace("NAME", name).replace("JOINT", f"j{n}") for n, name in enumerate(names, 1))
    for name, text in {
        "package.xml": MANIFEST,
        "arm.urdf.xacro": robot,
        "config/controllers.yaml": manager + sections,
    }.items():
        (folder / name).write_text(text)
    findings = lint(folder, select=("K965",))
    return [(one.file.rpartition("/")[2], one.line, one.help) for one in findings]


def test_hardware_with_the_interfaces_of_its_controllers_has_no_finding(tmp_path):
    assert found(tmp_path, ROBOT, ["first", "second"]) == []


def test_an_interface_in_place_of_that_of_two_controllers_is_reported_at_the_hardware(tmp_path):
    findings = found(tmp_path, ROBOT.replace('name="velocity"', 'name="effort"'), ["first", "second"])
    assert findings == [("arm.urdf.xacro", 6, "the controllers use another interface")]


def test_an_interface_that_one_controller_misses_is_reported_at_the_controller(tmp_path):
    ((file, _, _),) = found(tmp_path, ROBOT.replace('name="velocity"', 'name="effort"'), ["first"])
    assert file == "controllers.yaml"


CORNERS = ("front_left", "front_right", "rear_right", "rear_left")


@pytest.mark.parametrize(
    ("commanded", "read", "interface"),
    [
        ("velocity", "velocity", ""),
        ("effort", "velocity", "commands the velocity interface"),
        ("velocity", "position", "reads the velocity interface"),
    ],
)
def test_a_mecanum_drive_commands_and_reads_the_velocity_of_its_wheels(tmp_path, commanded, read, interface):
    wheel = JOINT.replace("M", "0").replace("revolute", "continuous")
    joints = "".join(wheel.replace("N", str(n)) for n in range(1, 5))
    robot = ROBOT[: ROBOT.index("  <link")] + '  <link name="l0"/>\n' + joints + ROBOT[ROBOT.index("  <ros2_control") :]
    robot = robot.replace('<command_interface name="position"', f'<command_interface name="{commanded}"')
    robot = robot.replace('<state_interface name="velocity"', f'<state_interface name="{read}"')
    robot = robot.replace('<xacro:driven name="j2"/>', "".join(f'<xacro:driven name="j{n}"/>' for n in (2, 3, 4)))
    names = "".join(f"    {corner}_wheel_command_joint_name: j{n}\n" for n, corner in enumerate(CORNERS, 1))
    kind = "      type: mecanum_drive_controller/MecanumDriveController\n"
    (tmp_path / "config").mkdir()
    for name, text in {
        "package.xml": MANIFEST,
        "arm.urdf.xacro": robot,
        "config/controllers.yaml": "controller_manager:\n  ros__parameters:\n    base:\n"
        f"{kind}base:\n  ros__parameters:\n{names}",
    }.items():
        (tmp_path / name).write_text(text)
    messages = [one.message for one in lint(tmp_path, select=("K965",))]
    assert [interface in message for message in messages] == [True] * bool(interface)


def test_a_joint_that_the_hardware_lacks_is_reported_at_the_entry_before_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    robot = ROBOT.replace("</robot>", JOINT.replace("N", "3").replace("M", "2") + "</robot>")
    settings = "controller_manager:\n  ros__parameters:\n    arm:\n" + KIND
    settings += SETTINGS.replace("NAME", "arm").replace("JOINT", "j1, j2, j3")
    for name, text in {"package.xml": MANIFEST, "arm.urdf.xacro": robot, "arm.yaml": settings}.items():
        (tmp_path / name).write_text(text)
    (found,) = lint("arm.urdf.xacro", select=("K965",))
    assert robot.splitlines()[found.line - 1].strip() == '<xacro:driven name="j2"/>'
    assert [each.file for each in found.related] == ["arm.yaml"]


TRANSMISSION = """<transmission name="t{0}"><type>transmission_interface/SimpleTransmission</type><joint name="j{0}">
  <hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface></joint></transmission>
"""


@pytest.mark.parametrize(("driven", "file"), [((1, 2), "arm.urdf"), ((1,), "arm.yaml")])
def test_a_joint_without_transmission_is_reported_where_the_robot_has_the_others(driven, file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    joints = "".join(JOINT.replace("N", str(n)).replace("M", str(n - 1)) for n in (1, 2, 3))
    plugin = '<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>'
    transmissions = "".join(TRANSMISSION.format(n) for n in driven)
    kind = "type: position_controllers/JointPositionController"
    for name, text in {
        "package.xml": MANIFEST.replace("ament_cmake", "catkin"),
        "arm.urdf": f'<robot name="arm">\n<link name="l0"/>\n{joints}{plugin}{transmissions}</robot>',
        "arm.yaml": f"wrist:\n  {kind}\n  joint: j3\n",
    }.items():
        (tmp_path / name).write_text(text)
    (found,) = lint("arm.urdf", select=("K963",), target="ros1")
    assert found.file == file
