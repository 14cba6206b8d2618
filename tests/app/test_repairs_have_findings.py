"""Each repair that `sim`, `view` and `info` report has a finding of its code at its place, over robots with one defect.

A defect is a replacement in one good robot, and each must be repaired. The codes of all repairs must be those of rules,
so a new repair without a rule fails here.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")

from urdfkit import Simulator
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.cli import main
from urdfkit.description.model_argument import model_argument
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.errors import UrdfkitError
from urdfkit.lint import lint
from urdfkit.lint.rules import RULES

INERTIAL = (
    '<inertial>\n<origin xyz="0 0 0"/>\n<mass value="1"/>\n'
    '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>\n</inertial>\n'
)
SHAPES = (
    '<visual>\n<geometry>\n<box size="0.2 0.2 0.2"/>\n</geometry>\n<origin xyz="0.1 0.1 0.1"/>\n</visual>\n'
    '<collision>\n<geometry>\n<mesh filename="part.obj" scale="1 1 1"/>\n</geometry>\n</collision>\n'
)
ROBOT = f"""<robot name="r">
<link name="base">
{INERTIAL}</link>
<link name="arm">
{INERTIAL}{SHAPES}</link>
<link name="tip">
{INERTIAL}</link>
<joint name="shoulder" type="revolute">
<origin xyz="0 0 0.5" rpy="0 0 0"/>
<parent link="base"/>
<child link="arm"/>
<axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="10" velocity="1"/>
<dynamics damping="0.1" friction="0"/>
</joint>
<joint name="wrist" type="continuous">
<parent link="arm"/>
<child link="tip"/>
<axis xyz="0 1 0"/>
<mimic joint="shoulder"/>
</joint>
<gazebo reference="tip">
<mu1>0.5</mu1>
<kp>1000</kp>
<sensor name="imu" type="imu">
<update_rate>50</update_rate>
</sensor>
</gazebo>
<gazebo>
<plugin name="joints" filename="libgazebo_ros_joint_state_publisher.so">
<joint_name>shoulder</joint_name>
</plugin>
</gazebo>
</robot>
"""

DEFECTS = {
    "no link name": ('<link name="tip">', "<link>"),
    "no joint name": ('<joint name="wrist" ', "<joint "),
    "same link name": ('<link name="tip">', '<link name="tip"/>\n<link name="tip">'),
    "same joint name": ('<joint name="wrist"', '<joint name="shoulder"'),
    "second root": ("</robot>", '<link name="stray"/>\n</robot>'),
    "unknown parent": ('<parent link="arm"/>', '<parent link="arn"/>'),
    "unknown child": ('<child link="tip"/>', '<child link="tipp"/>'),
    "child without a similar link": ('<child link="tip"/>', '<child link="lidar"/>'),
    "no parent": ('<parent link="arm"/>\n', ""),
    "no parent link": ('<parent link="arm"/>', "<parent>arm</parent>"),
    "empty parent": ('<parent link="arm"/>', '<parent link=""/>'),
    "no child": ('<child link="tip"/>\n', ""),
    "two parents": (
        "</robot>",
        '<joint name="brace" type="fixed">\n<parent link="base"/>\n<child link="tip"/>\n</joint>\n</robot>',
    ),
    "closed loop": (
        "</robot>",
        '<joint name="brace" type="fixed">\n<parent link="tip"/>\n<child link="arm"/>\n</joint>\n</robot>',
    ),
    "loop": ('<parent link="base"/>', '<parent link="tip"/>'),
    "joint of a link with itself": (
        "</robot>",
        '<joint name="itself" type="fixed">\n<parent link="tip"/>\n<child link="tip"/>\n</joint>\n</robot>',
    ),
    "no joint type": (' type="continuous"', ""),
    "joint type": ('type="continuous"', 'type="hinge"'),
    "no axis direction": ('<axis xyz="0 1 0"/>\n<limit', '<axis xyz="0 0 0"/>\n<limit'),
    "axis": ('<axis xyz="0 1 0"/>\n<limit', '<axis xyz="y"/>\n<limit'),
    "no limit": ('<limit lower="-1" upper="1" effort="10" velocity="1"/>\n', ""),
    "no effort limit": (' effort="10"', ""),
    "negative effort": ('effort="10"', 'effort="-10"'),
    "negative velocity": ('velocity="1"', 'velocity="-1"'),
    "exchanged limits": ('lower="-1" upper="1"', 'lower="1" upper="-1"'),
    "limit in degrees": ('lower="-1"', 'lower="-90deg"'),
    "damping": ('damping="0.1"', 'damping="-0.1"'),
    "mimic": ('<mimic joint="shoulder"/>', '<mimic joint="shoulderr"/>'),
    "mimic of itself": ('<mimic joint="shoulder"/>', '<mimic joint="wrist"/>'),
    "two numbers": ('xyz="0 0 0.5"', 'xyz="0 0.5"'),
    "infinite": ('rpy="0 0 0"', 'rpy="0 0 inf"'),
    "quaternion of zero": ('rpy="0 0 0"', 'quat_xyzw="0 0 0 0"'),
    "version": ('<robot name="r">', '<robot name="r" version="7.0">'),
    "no inertial": (f'<link name="arm">\n{INERTIAL}', '<link name="arm">\n'),
    "no inertial at all": (INERTIAL, ""),
    "no inertial and no shape": (f'<link name="tip">\n{INERTIAL}', '<link name="tip">\n'),
    "no mass": ('<mass value="1"/>\n', ""),
    "mass of zero": ('<mass value="1"/>', '<mass value="0"/>'),
    "mass that is no number": ('<mass value="1"/>', '<mass value="1 kg"/>'),
    "no tensor": ('<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>\n', ""),
    "no moment": (' izz="0.01"', ""),
    "impossible tensor": ('izz="0.01"', 'izz="0.1"'),
    "negative moment": ('izz="0.01"', 'izz="-0.01"'),
    "tensor of zero": (
        'ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"',
        'ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"',
    ),
    "NaN": ('ixx="0.01"', 'ixx="nan"'),
    "no geometry": ("<visual>\n<geometry>\n<box", "<visual>\n</visual>\n<visual>\n<geometry>\n<box"),
    "empty geometry": ('<box size="0.2 0.2 0.2"/>\n', ""),
    "unknown shape": ('<box size="0.2 0.2 0.2"/>', '<cone radius="0.1"/>'),
    "size of two numbers": ('size="0.2 0.2 0.2"', 'size="0.2 0.2"'),
    "negative size": ('size="0.2 0.2 0.2"', 'size="0.2 -0.2 0.2"'),
    "collision size of zero": ('<mesh filename="part.obj" scale="1 1 1"/>', '<box size="0.2 0 0.2"/>'),
    "negative collision size": ('<mesh filename="part.obj" scale="1 1 1"/>', '<sphere radius="-0.2"/>'),
    "scale of zero": ('scale="1 1 1"', 'scale="0 0 0"'),
    "flat mesh": ('scale="1 1 1"', 'scale="1 1 0"'),
    "mesh": ('filename="part.obj"', 'filename="gone.obj"'),
    "mesh of a package": ('filename="part.obj"', 'filename="package://gone/part.obj"'),
    "mesh format": ('filename="part.obj"', 'filename="part.step"'),
    "damaged mesh": ('filename="part.obj"', 'filename="broken.stl"'),
    "mesh that is not finite": ('filename="part.obj"', 'filename="nan.obj"'),
    "no mesh file name": ('filename="part.obj" ', ""),
    "friction": ("<mu1>0.5", "<mu1>rough"),
    "stiffness": ("<kp>1000", "<kp>-1000"),
    "sensor type": ('type="imu"', 'type="imuu"'),
    "no sensor type": (' type="imu"', ""),
    "sensor rate": ("<update_rate>50", "<update_rate>-50"),
    "sensor of no link": ('<gazebo reference="tip">', '<gazebo reference="tipp">'),
    "sensor without reference": ('<gazebo reference="tip">', "<gazebo>"),
    "plugin joint": ("<joint_name>shoulder", "<joint_name>shouldr"),
    "plugin library": ("libgazebo_ros_joint_state_publisher", "libgazebo_ros_joint_state_publsher"),
    "no plugin file": (' filename="libgazebo_ros_joint_state_publisher.so"', ""),
    "hardware that no plugin runs": (
        "</robot>",
        '<ros2_control name="h" type="system">\n<hardware><plugin>a/Motors</plugin></hardware></ros2_control></robot>',
    ),
    "hardware of a simulator that no plugin runs": (
        "</robot>",
        """<ros2_control name="h" type="system"><hardware>
        <plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware></ros2_control></robot>""",
    ),
    "two hardwares that no plugin runs": (
        "</robot>",
        """<ros2_control name="h" type="system"><hardware>
        <plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware></ros2_control>
        <ros2_control name="g" type="system"><hardware>
        <plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware></ros2_control></robot>""",
    ),
    "two without hardware": (
        "</robot>",
        """<ros2_control name="h" type="system"><joint name="wrist"/></ros2_control>
        <ros2_control name="g" type="system"><hardware><param name="a">1</param></hardware></ros2_control></robot>""",
    ),
    "two with empty hardware": (
        "</robot>",
        """<ros2_control name="h" type="system"><hardware><plugin/></hardware></ros2_control>
        <ros2_control name="g" type="system"><hardware/></ros2_control></robot>""",
    ),
    "mass that is not a number": ('<mass value="1"/>', '<mass value="nan"/>'),
    "visual mesh": ('<box size="0.2 0.2 0.2"/>', '<mesh filename="gone.dae"/>'),
    "empty plugin file": ('filename="libgazebo_ros_joint_state_publisher.so"', 'filename=""'),
}
"""Defect → the text of the good robot, and its replacement."""

CODES = {rule.code for rule in RULES}


def write(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    (folder / "part.obj").write_text("v 0 0 0\nv 0.2 0 0\nv 0 0.2 0\nv 0 0 0.2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    (folder / "nan.obj").write_text("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "part.step").write_text("ISO-10303-21;\n")
    (folder / "broken.stl").write_bytes(bytes(80) + b"\x09\0\0\0" + bytes(20))
    path = folder / "r.urdf"
    path.write_text(text, encoding=encoding)
    return path


def repairs_of(path: Path) -> dict[str, list[Repair]]:
    """Return the repairs of each command."""
    robot = ShownRobot.read(model_argument(path))
    return {"view": list(robot.repairs), "sim": list(Simulator(path, note=lambda _: None).repairs)}


def unreported(path: Path) -> tuple[int, list[str]]:
    """Return the number of repairs, and those without a finding of their code in their line and column.

    A robot whose repairs are warnings is refused with ``strict``, and only such a robot.
    """
    found = [*lint(path), *lint(path, target="urdfkit")]
    spans = [(one.code, span) for one in found for span in (one.span, *(each.span for each in one.related))]
    places = {(code, span.line, span.column) for code, span in spans}
    warned = {one.line for one in found if one.severity != "note"}
    count, missing = 0, []
    for command, repairs in repairs_of(path).items():
        for repair in repairs:
            count += 1
            at = repair.position
            if repair.code not in CODES or at is None or (repair.code, at.line, at.column) not in places:
                missing.append(f"{command}: {repair.code} {repair}")
            elif repair.severity == "warning" and at.line not in warned:
                missing.append(f"{command}: {repair.code} is only a note of lint: {repair}")
        is_refused = False
        try:
            ShownRobot.read(model_argument(path), strict=True) if command == "view" else Simulator(path, strict=True)
        except UrdfkitError:
            is_refused = True
        if is_refused is not any(repair.severity == "warning" for repair in repairs):
            missing.append(f"{command}: {'refused' if is_refused else 'accepted'} with strict: {repairs}")
    return count, missing


def test_the_good_robot_needs_no_repair(tmp_path: Path) -> None:
    path = write(tmp_path, ROBOT)
    assert unreported(path) == (0, [])
    assert [str(finding) for finding in lint(path) if finding.severity != "note"] == []


@pytest.mark.slow
@pytest.mark.parametrize("defect", DEFECTS)
def test_every_repair_has_a_finding_in_its_line(defect: str, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    before, after = DEFECTS[defect]
    assert before in ROBOT
    good, _, end = ROBOT.rpartition(before)
    whole = ROBOT.replace(before, after) if defect == "no inertial at all" else good + after + end
    path = write(tmp_path, whole)
    found, missing = unreported(path)
    assert missing == []
    assert found > 0
    capsys.readouterr()
    assert main(["info", str(path), "--json"]) == 0
    lines = {(finding.code, finding.line) for finding in lint(path)}
    assert {(each["code"], each["line"]) for each in json.loads(capsys.readouterr().out)["repairs"]} <= lines


def test_a_file_in_utf_16_is_a_repair_and_strict_refuses_it(tmp_path: Path) -> None:
    path = write(tmp_path, ROBOT, "utf-16")
    assert unreported(path) == (2, [])
    with pytest.raises(UrdfkitError, match="UTF-16"):
        Simulator(path, strict=True)


@pytest.mark.parametrize("kind", ["fixed", "continuous"])
def test_a_robot_of_visual_shapes_only_has_a_finding_for_its_mass(tmp_path: Path, kind: str) -> None:
    link = '<link name="{}"><visual><geometry><box size="1 1 1"/></geometry></visual></link>\n'
    joint = f'<joint name="j" type="{kind}"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>'
    text = f'<robot name="r">\n{link.format("a")}{link.format("b")}{joint}</robot>'
    assert unreported(write(tmp_path, text)) == (1, [])
