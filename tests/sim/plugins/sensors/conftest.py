"""A lidar on a post in the middle of a room."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.description import load
from urdfkit.sim import Simulator, Spawn

ROBOTS = Path(__file__).parents[4] / "robots"

WALL = """<link name="{name}"><pose>{x} {y} 0 0 0 0</pose><{role} name="shape"><laser_retro>{retro}</laser_retro>
<geometry><box><size>{dx} {dy} 20</size></box></geometry></{role}></link>"""


def wall(name: str, x: float, y: float, dx: float, dy: float, *, retro: float = 0.0, role: str = "collision") -> str:
    return WALL.format(name=name, x=x, y=y, dx=dx, dy=dy, retro=retro, role=role)


ROOM = (
    wall("east", 3.05, 0, 0.1, 500, retro=120)
    + wall("north", 0, 2.05, 500, 0.1, retro=50)
    + wall("far", -60.05, 0, 0.1, 500)
)
"""Faces at x = 3, y = 2 and x = -60 m."""

SCAN = """<ray><scan><horizontal><samples>{samples}</samples><resolution>1</resolution><min_angle>{low}</min_angle>
<max_angle>{high}</max_angle></horizontal>{vertical}</scan><range><min>0.1</min><max>{far}</max></range>{noise}</ray>"""

VERTICAL = (
    """<vertical><samples>{rings}</samples><min_angle>{low}</min_angle><max_angle>{high}</max_angle></vertical>"""
)


def scan(samples=181, low=-0.5, high=1.5, *, rings=1, spread=0.0, far=30.0, noise="") -> str:
    vertical = VERTICAL.format(rings=rings, low=-spread, high=spread) if rings > 1 else ""
    return SCAN.format(samples=samples, low=low, high=high, vertical=vertical, far=far, noise=noise)


def noise(deviation: float, mean: float = 0.0) -> str:
    return f"<noise><type>gaussian</type><mean>{mean}</mean><stddev>{deviation}</stddev></noise>"


def sensor(
    plugin: str = "", *, inside: str | None = None, type: str = "ray", rate: float = 10.0, more: str = ""
) -> str:
    return (
        f'<sensor name="lidar" type="{type}"><update_rate>{rate}</update_rate>{scan() if inside is None else inside}'
        f"{more}{plugin}</sensor>"
    )


LASER = """<plugin name="laser" filename="libgazebo_ros_laser.so"><topicName>scan</topicName>
<frameName>eye</frameName></plugin>"""


@pytest.fixture
def post(tmp_path: Path) -> Callable[..., Any]:
    """Return what makes a simulator of a post that carries sensors at its top, at the room's origin."""

    def make(sensors: str, *, room: str = ROOM, note: Callable[[str], None] | None = None, **options: Any) -> Simulator:
        (tmp_path / "post.urdf").write_text(
            '<robot name="post"><link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
            'ixz="0" iyz="0"/></inertial></link><link name="eye"/><joint name="top" type="fixed"><parent link="base"/>'
            '<child link="eye"/><origin xyz="0 0 0.5"/></joint>'
            f'<gazebo reference="eye">{sensors}</gazebo></robot>'
        )
        (tmp_path / "room.sdf").write_text(
            '<sdf version="1.9"><world name="room"><model name="walls"><static>true</static>'
            f"{room}</model></world></sdf>"
        )
        spawn = options.pop("spawn", Spawn(z=0.0))
        robot = load(tmp_path / "post.urdf")
        return Simulator(
            robot, world=tmp_path / "room.sdf", fixed_base=True, spawn=spawn, note=note or (lambda _: None), **options
        )

    return make


def heard(simulator: Simulator, topic: str, seconds: float = 0.1) -> list[Any]:
    """Return what comes on a topic meanwhile."""
    kinds = {each.name: each.type for each in simulator.bus.topics}
    messages: list[Any] = []
    subscription = simulator.subscribe(topic, kinds[topic], messages.append)
    simulator.run(seconds)
    subscription.close()
    return messages
