"""Lidars of the robots that come along, and things that move."""

from __future__ import annotations

import re

import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import LASER, ROBOTS, heard, scan, sensor, wall
from urdfkit.description import load
from urdfkit.description.plugins.sensors.table import SENSORS
from urdfkit.sim import Simulator, Spawn

FILENAME = re.compile(r'filename="lib([a-z_0-9]+)[.]so"')

BALL = """</model><model name="ball"><pose>2 0 5 0 0 0</pose><link name="link"><collision name="c"><geometry><sphere>
<radius>0.5</radius></sphere></geometry></collision></link></model><model name="rest"><static>true</static>"""


def test_a_falling_ball_is_seen_where_it_is(post) -> None:
    simulator = post(sensor(LASER, inside=scan(1, 0, 0), rate=1000), room=BALL)
    messages = heard(simulator, "/scan", 1.2)
    seen = [k for k, m in enumerate(messages) if np.isfinite(m.ranges[0])]
    fall = [5 - 0.5 * 9.8 * ((k + 1) * 1e-3) ** 2 for k in range(len(messages))]
    expected = [k for k, z in enumerate(fall) if abs(z - 0.5) < 0.5]
    assert abs(seen[0] - expected[0]) <= 1
    assert abs(seen[-1] - expected[-1]) <= 1
    middle = min(expected, key=lambda k: abs(fall[k] - 0.5))
    assert messages[middle].ranges[0] == pytest.approx(1.5, abs=1e-3)


@pytest.mark.parametrize(
    ("robot", "arguments", "topics"),
    [
        ("heterogeneous", {}, {"/scan1": 720, "/scan2": 720}),
        ("diff_wheeled_robot_with_laser", {}, {"/scan": 720}),
        ("gem_e2", {"gazebo": "classic"}, {"/velodyne_points": 2000}),
        ("gem_e2", {"gazebo": "gz"}, {"/velodyne": 100, "/velodyne/points": 2000}),
    ],
)
def test_lidars_of_robots_see_the_cylinders(robot: str, arguments: dict[str, str], topics: dict[str, int]) -> None:
    notes: list[str] = []
    (file,) = ROBOTS.glob(f"*/*_description/urdf/{robot}.urdf.xacro")
    simulator = Simulator(
        load(file, arguments=arguments, package_path=[file.parents[2]]), world="cylinders", note=notes.append
    )
    simulator.run(0.1)
    for topic, least in topics.items():
        message = simulator.bus.latest(topic)
        assert (message.width * message.height if hasattr(message, "width") else len(message.ranges)) >= least
        if hasattr(message, "ranges"):
            assert np.isfinite(message.ranges).any() or robot == "gem_e2"  # whose middle ring looks over everything
            assert (message.ranges > 0.09).all()
    assert not [note for note in notes if "laser" in note or "velodyne" in note]


def test_every_lidar_that_comes_along_is_simulated() -> None:
    plugins = ROBOTS.glob("*/*_description/urdf/*.xacro")
    named = {
        name for file in plugins for name in FILENAME.findall(file.read_text()) if "laser" in name or "ray" in name
    }
    assert named
    known = {name for spec in SENSORS for name in spec.filenames}
    assert named <= known


def test_what_comes_and_goes_is_seen_as_long_as_it_is_there(post) -> None:
    simulator = post(sensor(LASER, inside=scan(1, 0, 0), rate=100), room="")
    assert np.isinf(heard(simulator, "/scan", 0.05)[-1].ranges[0])
    simulator.world.spawn("unit_box", (4.0, 0.0, 0.5), name="thing")
    assert heard(simulator, "/scan", 0.05)[-1].ranges[0] == pytest.approx(3.5, abs=1e-3)
    simulator.world.place("thing", (6.0, 0.0, 0.5))
    assert heard(simulator, "/scan", 0.05)[-1].ranges[0] == pytest.approx(5.5, abs=1e-3)
    simulator.world.remove("thing")
    assert np.isinf(heard(simulator, "/scan", 0.05)[-1].ranges[0])


def test_another_robot_is_seen_and_sees(post) -> None:
    simulator = post(sensor(LASER, inside=scan(1, 0, 0), rate=100), room="")
    simulator.world.spawn("rrbot", (5.0, 0.0, 0.0, np.pi), name="other")
    mine = heard(simulator, "/scan", 0.05)[-1].ranges[0]
    assert 4.5 < mine < 5.0  # the foot of the other robot
    assert heard(simulator, "/rrbot/laser/scan", 0.05)


def test_a_lidar_of_a_model_in_the_world_is_simulated(post) -> None:
    sdf = sensor(inside=scan(1, 0, 0).replace("ray>", "lidar>"), type="gpu_lidar", more="<topic>tower</topic>")
    room = f"""</model><model name="tower"><link name="l"><pose>0 0 0.2 0 0 0</pose>{sdf}<collision name="c"><geometry>
    <box><size>0.1 0.1 0.4</size></box></geometry></collision></link></model><model name="wall"><static>true</static>
    {wall("w", 7.05, 0, 0.1, 20, role="visual")}"""
    simulator = post(sensor(LASER, inside=scan(1, 0, 0)), room=room, spawn=Spawn(x=-3.0, z=0.0))
    assert heard(simulator, "/tower", 0.1)[-1].ranges[0] == pytest.approx(7.0, abs=1e-3)


TOWER = """<robot name="tower"><link name="base">{inertial}</link><link name="arm">{shape}</link>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.5"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""


@pytest.mark.parametrize("static", [True, False])
def test_a_robot_that_the_world_includes_is_seen(post, tmp_path, static: bool) -> None:
    box = '<geometry><box size="0.4 0.4 0.4"/></geometry>'
    inertial = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
    shape = f"{inertial}<visual>{box}</visual><collision>{box}</collision>"
    file = tmp_path / "tower.urdf"
    file.write_text(TOWER.format(shape=shape, inertial=inertial))
    included = f"<include><uri>{file}</uri><static>{str(static).lower()}</static><pose>3 0 0 0 0 0</pose></include>"
    visual = sensor(inside=scan(1, 0, 0).replace("ray>", "lidar>"), type="gpu_lidar", more="<topic>seen</topic>")
    lidars = sensor(LASER, inside=scan(1, 0, 0)) + visual.replace('"lidar"', '"other"')
    simulator = post(lidars, room=f"</model>{included}<model name='rest'><static>true</static><link name='l'/>")
    assert heard(simulator, "/scan")[-1].ranges[0] == pytest.approx(2.8, abs=0.02)
    assert heard(simulator, "/seen")[-1].ranges[0] == pytest.approx(2.8, abs=0.02)
    assert {shape.body for shape in simulator.world.body_shapes()} >= {"tower::arm"}
    if static:
        simulator.world.place("tower", (5.0, 0.0, 0.0))
        assert heard(simulator, "/scan")[-1].ranges[0] == pytest.approx(4.8, abs=1e-3)
        simulator.world.remove("tower")
        assert np.isinf(heard(simulator, "/seen")[-1].ranges[0])
