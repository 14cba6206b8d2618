"""Sensors that make no sense: one line with the place and the nearest right thing, and the rest runs."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.sim.plugins.sensors.conftest import LASER, heard, scan, sensor
from tests.suggestions import contains
from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.lint import lint
from urdfkit.sim import Simulator

GOOD = sensor(LASER)
BLOCK = '<gazebo reference="eye">{}</gazebo>'


@pytest.fixture
def robot(tmp_path: Path) -> Callable[[str], Path]:
    """Return what writes a robot with gazebo blocks, and a good laser next to them."""

    def write(blocks: str) -> Path:
        file = tmp_path / "post.urdf"
        file.write_text(
            '<robot name="post"><link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
            'ixz="0" iyz="0"/></inertial></link><link name="eye"/><joint name="top" type="fixed"><parent link="base"/>'
            f'<child link="eye"/></joint>{BLOCK.format(GOOD)}\n{blocks}</robot>'
        )
        return file

    return write


VELODYNE = '<plugin name="v" filename="libgazebo_ros_velodyne_laser.so"><topicName>v</topicName>{}</plugin>'
KINECT = (
    '<plugin name="k" filename="libgazebo_ros_openni_kinect.so"><cameraName>k</cameraName>'
    "<pointCloudCutoff>4</pointCloudCutoff><pointCloudCutoffMax>2</pointCloudCutoffMax></plugin>"
)
CAMERA = "<camera><image><width>8</width><height>6</height></image></camera>"

WRONG = [
    (BLOCK.format(sensor(LASER, type="raay")), "unknown sensor type `raay`; did you mean `ray`?"),
    (
        BLOCK.format(sensor(type="rgbd_camra", inside="")),
        "unknown sensor type `rgbd_camra`; did you mean `rgbd_camera`?",
    ),
    (BLOCK.format(sensor(LASER, type="")), "a sensor has no type"),
    (
        BLOCK.format(sensor(type="thermal", inside="")),
        'sensors of type `thermal` are not simulated: use type="camera"',
    ),
    (
        BLOCK.format(sensor(type="dvl", inside="")),
        "sensors of type `dvl` are not simulated yet; sensor `lidar` is ignored",
    ),
    (
        BLOCK.format(sensor(type="sonar", inside="")),
        '`sonar` are not simulated: write type="ray" and a plugin that publishes the nearest range',
    ),
    (
        BLOCK.format(sensor(type="infrared", inside="")),
        "with infrared as the kind of radiation; sensor `lidar` is ignored",
    ),
    (BLOCK.format(sensor(LASER, inside=scan(10.7))), "<samples> is 10.7; it must be a whole number; sensor `lidar`"),
    (
        BLOCK.format(sensor(LASER, inside=scan().replace("resolution>1<", "resolution>0<"))),
        "<resolution> is 0; it must be greater than zero: it is multiplied by <samples>; sensor `lidar`",
    ),
    (BLOCK.format(sensor(LASER.replace(">scan<", ">my scan!<"))), "`/my scan!` is not a valid topic name"),
    (
        BLOCK.format(sensor(VELODYNE.format("<min_range>9</min_range><max_range>2</max_range>"))),
        (
            "the range from <min_range> 9 m to <max_range> 2 m is empty: "
            "<min_range> must be less than <max_range>; sensor `lidar`"
        ),
    ),
    (
        BLOCK.format(sensor(KINECT, type="depth", inside=CAMERA)),
        "the range from <pointCloudCutoff> 4 m to <pointCloudCutoffMax> 2 m is empty",
    ),
    (f"<gazebo>{GOOD}</gazebo>", "of a link; this <gazebo> has no reference"),
    (f'<gazebo reference="eyes">{GOOD}</gazebo>', "`eyes` is not a link; did you mean `eye`?"),
    (f'<gazebo reference="top">{sensor(type="imu", inside="")}</gazebo>', "of a link; `top` is not a link"),
    (BLOCK.format(sensor(LASER, rate=-1.0)), "<update_rate> is `-1.0`; it must be a finite number, 0 or greater"),
    (BLOCK.format(sensor(LASER, inside=scan(0))), "<horizontal> has 0 samples; it must have at least one"),
    (BLOCK.format(sensor(LASER, inside=scan(9, 1, -1))), "<horizontal> goes from 1 to -1 rad"),
    (BLOCK.format(sensor(LASER, inside=scan(far=0.01))), "the range of the lidar, 0.1 m to 0.01 m, is empty"),
    (
        BLOCK.format(sensor(LASER, inside=scan(noise="<noise><type>gaussian</type><stddev>-2</stddev></noise>"))),
        "<stddev> is `-2`",
    ),
    (
        BLOCK.format(sensor(LASER, inside=scan(noise='<noise type="gausian"/>'))),
        "sensor `lidar` is ignored; did you mean `gaussian`?",
    ),
    (
        BLOCK.format(sensor(LASER.replace("ros_laser", "ros_block_laser"))),
        "topic `/scan` has type sensor_msgs/msg/LaserScan, not sensor_msgs/msg/PointCloud; sensor `lidar` is ignored",
    ),
    (
        BLOCK.format(sensor(LASER.replace("ros_laser", "ros_lazer"))),
        "no plugin `libgazebo_ros_lazer.so`; sensor `lidar` is ignored; did you mean `libgazebo_ros_laser.so`?",
    ),
    (BLOCK.format(LASER), "this plugin must be in a <sensor>"),
]


@pytest.mark.parametrize(("blocks", "reported"), WRONG)
def test_a_line_says_what_is_wrong_and_where_and_the_rest_runs(robot, blocks: str, reported: str) -> None:
    notes: list[str] = []
    file = robot(blocks)
    simulator = Simulator(load(file), world="void", note=notes.append)
    (note,) = notes
    (repair,) = simulator.repairs
    assert str(repair) == note
    found = [(each.code, each.span.start.line) for each in lint(file, target="urdfkit")]
    assert repair.position is not None
    assert repair.position.line in [line for _, line in found]
    assert repair.code is None or (repair.code, repair.position.line) in found
    assert contains(note, reported)
    assert "\n" not in note
    assert re.search(r"/post\.urdf:[4-9]:\d+: ", note)  # the good one ends on line 3
    assert heard(simulator, "/scan")


def test_a_rate_of_zero_is_every_step_as_in_gazebo(robot) -> None:
    simulator = Simulator(load(robot(BLOCK.format(sensor(LASER.replace("scan<", "s<"), rate=0.0)))), world="void")
    assert len(heard(simulator, "/s", 0.01)) == 10


def test_the_command_says_it_in_one_line_and_goes_on(robot, capsys: Any) -> None:
    file = robot(WRONG[0][0])
    assert main(["sim", "run", str(file), "--world", "void", "--for", "0.01"]) == 0
    reported = capsys.readouterr().err.splitlines()
    assert [line for line in reported if "raay" in line] == [
        f"urdfkit: warning: {file}:4:46: unknown sensor type `raay`; sensor `lidar` is ignored; did you mean `ray`?"
    ]


BESIDE = sensor(LASER.replace(">scan<", ">beside<")).replace('name="lidar"', 'name="beside"')
REMARKED = [
    (
        BLOCK.format(
            sensor(type="camera", inside=CAMERA.replace("<image>", "<horisontal_fov>1</horisontal_fov><image>"))
        ),
        "unknown element <horisontal_fov> in <camera> is ignored; did you mean <horizontal_fov>?",
    ),
    (
        BLOCK.format(BESIDE.replace("samples>", "sample>")),
        "unknown element <sample> in <horizontal> is ignored; did you mean <samples>?",
    ),
    (
        BLOCK.format(BESIDE.replace("frameName>", "frameNam>")),
        "unknown parameter <frameNam> of `libgazebo_ros_laser.so` is ignored; did you mean <frameName>?",
    ),
    (
        '<gazebo reference="base"><material>Gazebo/Oragne</material></gazebo>',
        "no material `Gazebo/Oragne`; did you mean `Gazebo/Orange`?",
    ),
    (
        BLOCK.format(sensor(LASER).replace('name="lidar"', 'name="other"')),
        "sensors `lidar` and `other` both publish on `/scan`",
    ),
    (
        BLOCK.format(
            sensor(
                '<plugin name="r" filename="libgazebo_ros_range.so"><radiation>ultrasonic</radiation></plugin>',
                inside=scan(3),
            )
        ),
        "<radiation> is `ultrasonic`, which is treated as infrared; did you mean `ultrasound`?",
    ),
    (
        BLOCK.format(
            sensor(type="camera", inside=CAMERA.replace("<image>", "<distortion><k1>-50</k1></distortion><image>"))
        ),
        "with this distortion, 9",
    ),
]


@pytest.mark.parametrize(
    ("file", "code"), [("libmy_own.so", "Z833"), ("libgazebo_ros_lazer.so", "Z825"), ("", "Z809"), (" ", "Z809")]
)
def test_the_code_of_a_plugin_without_a_simulation_depends_on_its_library(robot, file: str, code: str) -> None:
    blocks = f'<gazebo><plugin name="p" filename="{file}"/></gazebo>'
    simulator = Simulator(load(robot(blocks)), world="void", note=lambda _: None)
    assert [repair.code for repair in simulator.repairs] == [code]


@pytest.mark.parametrize(("blocks", "reported"), REMARKED)
def test_what_is_ignored_is_reported_once_and_the_sensor_works(robot, blocks: str, reported: str) -> None:
    notes: list[str] = []
    simulator = Simulator(load(robot(blocks)), world="void", note=notes.append)
    (note,) = notes
    assert contains(note, reported)
    assert "sensor `" not in note
    assert re.search(r"/post\.urdf:[4-9]:\d+: ", note)
    assert heard(simulator, "/scan")


def test_an_ordinary_distortion_gets_to_the_whole_picture(robot) -> None:
    inside = CAMERA.replace("<image>", "<distortion><k1>-0.25</k1><k2>0.05</k2></distortion><image>")
    notes: list[str] = []
    Simulator(load(robot(BLOCK.format(sensor(type="camera", inside=inside)))), world="void", note=notes.append)
    assert not notes
