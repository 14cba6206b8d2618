"""Every drive goes where it is told, to 1 % of the ideal path, in all generations of Gazebo."""

import math

import pytest

from urdfkit.description import load
from urdfkit.lint import lint
from urdfkit.resources import find_model
from urdfkit.scaffold import create
from urdfkit.sim import Simulator

RAMP, SECONDS = 0.5, 4.25
COMMANDS = {
    "diff": [(0.5, 0, 0), (0.5, 0, 0.5)],
    "skid": [(0.5, 0, 0), (0, 0, 0.5), (0.5, 0, 0.25)],
    "ackermann": [(0.5, 0, 0), (0.5, 0, 0.5)],
    "omni": [(0.4, 0.2, 0), (0.3, 0.2, 0.5)],
}
GENERATIONS = [("jazzy", "gz"), ("noetic", "classic"), ("humble", "classic")]
CASES = [
    (ros, sim, drive, command)
    for ros, sim in GENERATIONS
    for drive, commands in COMMANDS.items()
    for command in commands
    if (ros, sim, drive) != ("humble", "classic", "ackermann")
]


def made(template, folder, **given):
    """Write a robot; return its model file."""
    create(template, template.answers({"name": "scout", **given}) | {"year": "2026", "into": "."}, folder)
    return find_model([f"{folder}/scout_description"]).path


def ridden(path, command):
    """Return the simulator after a command that grows for `RAMP` and then holds, as long as `SECONDS` in all."""
    simulator = Simulator(load(path), note=lambda _: None)
    vx, vy, w = command
    while simulator.t < RAMP:
        f = min(1.0, (simulator.t + simulator.dt / 2) / RAMP)
        simulator.command((vx * f, vy * f, 0), (0, 0, w * f))
        simulator.step()
    while simulator.t < SECONDS - 1e-9:  # again and again: controllers forget
        simulator.command((vx, vy, 0), (0, 0, w))
        simulator.run(0.25)
    return simulator


def ideal(command):
    """Return x, y [m] and the angle [rad] that a body with these velocities gets to."""
    vx, vy, w = command
    t = SECONDS - RAMP / 2
    if not w:
        return vx * t, vy * t, 0.0
    s, c = math.sin(w * t) / w, (1 - math.cos(w * t)) / w
    return vx * s - vy * c, vx * c + vy * s, w * t


@pytest.mark.parametrize(("ros", "sim", "drive", "command"), CASES)
def test_goes_where_it_is_told(robot_template, tmp_path, ros, sim, drive, command):
    simulator = ridden(made(robot_template, tmp_path, ros=ros, sim=sim, drive=drive), command)
    x, y, z, *_, qz, qw = simulator.link_poses()[0]
    there = ideal(command)
    length = math.hypot(*command[:2]) * (SECONDS - RAMP / 2)
    assert math.dist((x, y), there[:2]) <= 0.01 * max(length, 0.1)
    assert 2 * math.atan2(qz, qw) == pytest.approx(there[2], rel=0.01, abs=1e-3)
    assert abs(z) < 1e-3
    assert simulator.odometry() or (ros, drive) == ("noetic", "ackermann")  # its controller publishes it


@pytest.mark.parametrize("ros", ["jazzy", "noetic", "none"])
def test_without_a_drive_it_stands(robot_template, tmp_path, ros):
    simulator = Simulator(load(made(robot_template, tmp_path, ros=ros, drive="none")), note=lambda _: None)
    simulator.run(1.0)
    assert abs(simulator.link_poses()[0, :3]).max() < 1e-4
    assert simulator.command_topics == ()


@pytest.mark.parametrize("drive", ["diff", "skid", "ackermann", "omni", "none"])
def test_without_ros_there_is_the_description_alone(robot_template, tmp_path, drive):
    made(robot_template, tmp_path, ros="none", drive=drive)
    assert [path.name for path in tmp_path.iterdir()] == ["scout_description"]
    inside = {path.name for path in (tmp_path / "scout_description").iterdir()}
    assert inside == {"urdf", "test", "README.md", "LICENSE", ".gitignore", "urdfkit-new.toml"}
    assert [str(finding) for finding in lint([tmp_path], package_path=[tmp_path])] == []


@pytest.mark.parametrize(
    ("drive", "sizes"),
    [
        ("skid", {"base_length": "0.8", "base_width": "0.5", "wheel_radius": "0.12", "mass": "30"}),
        ("ackermann", {"base_length": "1.2", "base_width": "0.7", "wheel_radius": "0.15", "mass": "60"}),
        ("omni", {"base_length": "0.5", "base_width": "0.5", "wheel_radius": "0.05", "mass": "20"}),
    ],
)
def test_other_sizes(robot_template, tmp_path, drive, sizes):
    path = made(robot_template, tmp_path, drive=drive, **sizes)
    assert [str(finding) for finding in lint([tmp_path], package_path=[tmp_path])] == []
    command = (0.4, 0, 0.2)
    x, y = ridden(path, command).link_poses()[0, :2]
    assert math.dist((x, y), ideal(command)[:2]) <= 0.016


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ros", "drive", "sensors", "command"),
    [
        ("jazzy", "diff", "lidar3d depth", (0.5, 0, 0.5)),
        ("noetic", "skid", "lidar lidar3d camera depth imu gps", (0.5, 0, 0)),
        ("jazzy", "skid", "imu gps", (0, 0, 0.5)),  # what is heavier on one side turns about that
        ("kilted", "ackermann", "lidar gps", (0.5, 0, 0.5)),
        ("noetic", "omni", "camera imu", (0.3, 0.2, 0.5)),
    ],
)
def test_drives_with_sensors_on_it(robot_template, tmp_path, ros, drive, sensors, command):
    path = made(robot_template, tmp_path, ros=ros, drive=drive, sensor=sensors)
    x, y, _, _, _, qz, qw = ridden(path, command).link_poses()[0]
    there = ideal(command)
    assert math.dist((x, y), there[:2]) < 0.02
    assert math.remainder(2 * math.atan2(qz, qw) - there[2], 2 * math.pi) == pytest.approx(0, abs=0.02)
