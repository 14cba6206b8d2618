"""Robots are also linted with the xacro arguments that the launch files of their packages pass."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from urdfkit.cli import main

BOX = "<geometry><box size='0.2 0.2 0.2'/></geometry>"
INERTIAL = (
    "<inertial><mass value='2'/><inertia ixx='0.0133' iyy='0.0133' izz='0.0133' ixy='0' ixz='0' iyz='0'/></inertial>"
)
ROBOT = f"""<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="lidar" default="false"/>
  <link name="base">{INERTIAL}<visual>{BOX}</visual><collision>{BOX}</collision></link>
  <xacro:if value="$(arg lidar)">
    <link name="lidar"/>
    <joint name="lidar_joint" type="fixed"><parent link="bse"/><child link="lidar"/></joint>
  </xacro:if>
</robot>
"""
LAUNCH = """from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node


def generate_launch_description():
    path = get_package_share_directory("cart_description") + "/urdf/cart.urdf.xacro"
    description = Command(["xacro ", path, " lidar:=VALUE"])
    state = {"robot_description": description}
    return LaunchDescription([
        Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[state]),
        Node(package="ros_gz_sim", executable="create", arguments=["-topic", "robot_description"]),
    ])
"""
WITH = "lidar:=true, as launch/sim.launch.py passes"


@pytest.fixture(autouse=True)
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "cache"))
    for name, text in {
        "package.xml": "<package format='3'><name>cart_description</name></package>",
        "urdf/cart.urdf.xacro": ROBOT,
        "launch/sim.launch.py": LAUNCH.replace("VALUE", "true"),
    }.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def found(capsys: pytest.CaptureFixture[str], *words: str) -> set[tuple[str, int, str | None]]:
    main(["lint", ".", "--select", "T,M", "--format", "json", *words])
    return {(each["code"], each["line"], each["variant"]) for each in json.loads(capsys.readouterr().out)}


def test_a_defect_of_the_simulated_variant_is_found_with_its_arguments(capsys: pytest.CaptureFixture[str]) -> None:
    expected = {("T201", 6, WITH)}
    assert found(capsys) == expected
    assert found(capsys) == expected  # from the cache
    main(["lint", ".", "--select", "T"])
    assert f"= with {WITH}" in capsys.readouterr().out
    assert found(capsys, "--no-launch-arguments") == set()
    assert found(capsys, "lidar:=false") == set()
    assert found(capsys, "lidar:=true") == {("T201", 6, None)}


def test_the_stored_result_depends_on_the_launch_file_and_the_files_of_the_variant(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    launch, robot = package / "launch/sim.launch.py", package / "urdf/cart.urdf.xacro"
    launch.write_text(LAUNCH.replace("VALUE", "false"))
    assert found(capsys) == {("T201", 6, "lidar:=true")}
    launch.write_text(LAUNCH.replace("VALUE", "true"))
    part = package / "urdf/part.xacro"
    robot.write_text(ROBOT.replace('<link name="lidar"/>', '<xacro:include filename="part.xacro"/>'))
    part.write_text('<robot><link name="lidar"/></robot>')
    assert found(capsys) == {("T201", 6, WITH)}
    part.write_text('<robot><link name="lidar"/><link name="bse"/></robot>')
    assert ("T201", 6, WITH) not in found(capsys)


def test_a_file_is_right_if_it_fits_a_variant(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    upper = "${2 if '$(arg lidar)' == 'true' else 1}"
    lift = '<joint name="lift" type="revolute"><parent link="base"/><child link="mast"/><axis xyz="0 0 1"/>'
    mast = f'<link name="mast"/>{lift}<limit lower="0" upper="{upper}" effort="1" velocity="1"/></joint>'
    robot = ROBOT.replace("bse", "base").replace("  <xacro:if", f"  {mast}\n  <xacro:if")
    (package / "urdf/cart.urdf.xacro").write_text(robot)
    srdf = package / "config/cart.srdf"
    srdf.parent.mkdir()
    state = '<group_state name="{0}" group="all"><joint name="lift" value="{0}.5"/></group_state>\n'
    group = '<group name="all"><joint name="lift"/></group>\n'
    srdf.write_text(f'<robot name="cart">{group}{state.format(1)}{state.format(2)}</robot>\n')
    default = {(line, variant) for code, line, variant in found(capsys, "--no-launch-arguments") if code[0] == "M"}
    assert default == {(2, None), (3, None)}
    assert {(line, variant) for code, line, variant in found(capsys) if code[0] == "M"} == {(3, None)}


def test_an_interface_is_compared_with_the_variants_that_have_hardware(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mast = '<link name="mast"/><joint name="lift" type="continuous"><parent link="base"/><child link="mast"/></joint>'
    hardware = (
        '<ros2_control name="s" type="system"><hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>'
        '<joint name="lift"><command_interface name="velocity"/><state_interface name="velocity"/></joint>'
        "</ros2_control>"
    )
    robot = ROBOT.replace('"lidar" default="false"', '"sim" default="true"').replace("$(arg lidar)", "$(arg sim)")
    robot = robot.replace("  <xacro:if", f"  {mast}\n  <xacro:if").replace("bse", "base")
    (package / "urdf/cart.urdf.xacro").write_text(robot.replace("</xacro:if>", f"{hardware}</xacro:if>"))
    (package / "launch/sim.launch.py").unlink()
    display = LAUNCH.replace("lidar:=VALUE", "sim:=false").replace("ros_gz_sim", "rviz2").replace("create", "rviz2")
    (package / "launch/display.launch.py").write_text(display)
    config = package / "config/controllers.yaml"
    config.parent.mkdir()
    for interface, expected in (("veloctiy", ["K965"]), ("velocity", [])):
        config.write_text(
            "controller_manager:\n  ros__parameters:\n    lift_controller:\n"
            "      type: joint_trajectory_controller/JointTrajectoryController\n"
            "lift_controller:\n  ros__parameters:\n    joints: [lift]\n"
            f"    command_interfaces: [{interface}]\n    state_interfaces: [velocity]\n"
        )
        main(["lint", ".", "--target", "gz", "--select", "K962,K965", "--format", "json"])
        assert [each["code"] for each in json.loads(capsys.readouterr().out)] == expected


def test_a_topic_is_compared_with_the_variants_that_have_sensors(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sensor = '<gazebo reference="base"><sensor name="laser" type="gpu_lidar"><topic>scan</topic></sensor></gazebo>'
    robot = ROBOT.replace('"lidar" default="false"', '"sim" default="true"').replace("$(arg lidar)", "$(arg sim)")
    (package / "urdf/cart.urdf.xacro").write_text(
        robot.replace("bse", "base").replace("</xacro:if>", f"{sensor}</xacro:if>")
    )
    (package / "launch/sim.launch.py").unlink()
    display = LAUNCH.replace("lidar:=VALUE", "sim:=false").replace("ros_gz_sim", "rviz2").replace("create", "rviz2")
    (package / "launch/display.launch.py").write_text(display)
    (package / "config").mkdir()
    for topic, expected in (("laser", ["K969"]), ("scan", [])):
        (package / "config/bridge.yaml").write_text(
            f"- ros_topic_name: scan\n  gz_topic_name: {topic}\n  ros_type_name: sensor_msgs/msg/LaserScan\n"
            "  gz_type_name: gz.msgs.LaserScan\n  direction: GZ_TO_ROS\n"
        )
        main(["lint", ".", "--target", "gz", "--select", "K969", "--format", "json"])
        assert [each["code"] for each in json.loads(capsys.readouterr().out)] == expected


def test_a_consequence_in_one_variant_of_a_cause_in_another_is_left_out(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wheel = (
        f"<link name='SIDE_wheel'>{INERTIAL}<collision><geometry><cylinder radius='0.1' length='0.02'/></geometry>"
        "</collision></link><joint name='SIDE_wheel_joint' type='continuous'><parent link='base'/>"
        "<child link='SIDE_wheel'/><origin xyz='0 0.2 0'/><axis xyz='0 1 0'/></joint>"
    )
    plugin = (
        "<gazebo><plugin filename='gz-sim-diff-drive-system' name='gz::sim::systems::DiffDrive'>"
        "<left_joint>left_wheel_joint</left_joint><right_joint>right_wheel_joint</right_joint></plugin></gazebo>"
    )
    wheels = wheel.replace("SIDE", "left") + wheel.replace("SIDE", "right")
    start, _, end = ROBOT.partition('    <link name="lidar"/>')
    text = start.replace("  <xacro:if", f"{wheels}\n  <xacro:if") + plugin + end[end.index("\n  </xacro:if") :]
    (package / "urdf/cart.urdf.xacro").write_text(text)
    assert {code for code, _, _ in found(capsys, "--select", "S907,S909", "--no-launch-arguments")} == {"S909"}
    assert {code for code, _, _ in found(capsys, "--select", "S907,S909")} == {"S907"}


@pytest.mark.parametrize("default", ["true", "false"])
def test_a_package_that_one_variant_needs_is_missing_in_package_xml(
    package: Path, capsys: pytest.CaptureFixture[str], default: str
) -> None:
    plugin = '<gazebo><plugin name="c" filename="libgz_ros2_control-system.so"/></gazebo>'
    robot = ROBOT.replace('"lidar" default="false"', f'"sim" default="{default}"').replace("$(arg lidar)", "$(arg sim)")
    robot = robot.replace("bse", "base").replace("</xacro:if>", f"{plugin}</xacro:if>")
    (package / "urdf/cart.urdf.xacro").write_text(robot)
    needed = "<exec_depend>ros_gz_sim</exec_depend>"
    (package / "package.xml").write_text(f"<package format='3'><name>cart_description</name>{needed}</package>")
    (package / "launch/sim.launch.py").unlink()
    value = "false" if default == "true" else "true"
    text = LAUNCH.replace("lidar:=VALUE", f"sim:={value}")
    name = "sim" if value == "true" else "display"
    text = text if value == "true" else text.replace("ros_gz_sim", "rviz2").replace("create", "rviz2")
    (package / f"launch/{name}.launch.py").write_text(text)
    main(["lint", ".", "--select", "K956", "--format", "json"])
    rows = [(Path(each["file"]).name, each["message"]) for each in json.loads(capsys.readouterr().out)]
    message = "missing dependency on `gz_ros2_control`, whose plugin the robot loads"
    assert [row for row in rows if "plugin" in row[1]] == [("package.xml", message)]
