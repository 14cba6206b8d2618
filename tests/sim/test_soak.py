"""A short soak of two robots, and that what is watched would be seen."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from urdfkit.sim import Simulator

BENCH = Path(__file__).parents[2] / "tests" / "bench"
ROOM = """<sdf version="1.6"><world name="room"><include><uri>model://ground_plane</uri></include>
  <model name="room"><static>true</static><link name="link">
    {walls}
  </link></model></world></sdf>
"""
WALL = """<collision name="wall_{k}"><pose>{x} {y} 1.25 0 0 0</pose>
      <geometry><box><size>{long} {wide} 2.5</size></box></geometry></collision>"""
PLACES = ((1.075, 0.0, 0.15, 20.0), (-1.075, 0.0, 0.15, 20.0), (0.0, 1.075, 20.0, 0.15), (0.0, -1.075, 20.0, 0.15))


def module(name: str) -> Any:
    """Return a module of tests/bench/soak."""
    if str(BENCH) not in sys.path:
        sys.path.append(str(BENCH))
    return importlib.import_module(f"soak.{name}")


@pytest.mark.slow
def test_ten_seconds_of_two_robots_in_the_house() -> None:
    command = [sys.executable, str(BENCH / "soak"), "simpleton", "bot", "--minutes", "0.17", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    results = json.loads(done.stdout)
    assert [result["robot"] for result in results] == ["simpleton", "bot"]
    for result in results:
        assert result["simulated"] == 10.0
        assert result["travelled"] > 0.5
        assert result["wrong"] == {}


@pytest.mark.slow
def test_an_arm_that_its_base_drives_into_walls_stays_out_of_them(tmp_path: Path) -> None:
    # In a room of two metres, where the base is hardly ever off a wall, and its arm is often between the two.
    walls = [WALL.format(k=k, x=x, y=y, long=a, wide=b) for k, (x, y, a, b) in enumerate(PLACES)]
    path = tmp_path / "room.world"
    path.write_text(ROOM.format(walls="\n    ".join(walls)))
    simulator = Simulator("heterogeneous", world=path, note=lambda _: None)
    driver = module("driver").Driver(simulator, np.random.default_rng([3]))
    watch = module("watch").Watch(simulator, module("found").Found("heterogeneous"))
    deepest = 0.0
    for look in range(345):
        driver.drive(look * 0.05, resting=False)
        simulator.step(50)
        watch.look(quiet=False)
        deepest = max(deepest, *(contact.depth for contact in simulator.state.contacts))
    assert watch.found.wrong == {}
    assert watch.found.travelled > 3.0
    assert deepest < 2e-3  # it was 9 mm where rounds that spiral towards their goal were taken for a contradiction


@pytest.mark.slow
def test_a_humanoid_between_boards_of_18_mm_stays_on_its_side_of_them(tmp_path: Path) -> None:
    # A closet of 1.2 metres; motors of 300 N·m press its feet and fingers against the boards.
    places = (
        (0.609, 0.0, 0.018, 1.236),
        (-0.609, 0.0, 0.018, 1.236),
        (0.0, 0.609, 1.2, 0.018),
        (0.0, -0.609, 1.2, 0.018),
    )
    walls = [WALL.format(k=k, x=x, y=y, long=a, wide=b) for k, (x, y, a, b) in enumerate(places)]
    path = tmp_path / "closet.world"
    path.write_text(ROOM.format(walls="\n    ".join(walls)))
    simulator = Simulator(module("run").loaded("humanoid_42"), world=path, note=lambda _: None)
    driver = module("driver").Driver(simulator, np.random.default_rng([6]))
    watch = module("watch").Watch(simulator, module("found").Found("humanoid_42"))
    deepest = 0.0
    for look in range(160):
        driver.drive(look * 0.05, resting=False)
        simulator.step(50)
        watch.look(quiet=False)
        deepest = max(deepest, *(contact.depth for contact in simulator.state.contacts), 0.0)
    assert watch.found.wrong == {}  # a finger went through a board where rounds failed and their rest was used
    assert deepest < 3e-3  # it was 25 mm


@pytest.fixture(scope="module")
def watched() -> Any:
    simulator = Simulator("simpleton", world="house", note=lambda _: None)
    return module("watch").Watch(simulator, module("found").Found("simpleton"))


def test_a_way_through_a_wall_is_seen_and_one_through_a_door_is_not(watched: Any) -> None:
    walls = watched.walls
    inside, outside = np.array([[4.5, 0.0, 0.3]]), np.array([[5.5, 0.0, 0.3]])
    assert [walls.names[wall] for _, wall in walls.crossed(inside, outside)] == ["wall_3_1_collision"]
    assert walls.crossed(outside, outside + 1.0) == []
    corridor, room = np.array([[-2.0, -0.5, 0.3]]), np.array([[-2.0, -1.5, 0.3]])
    assert walls.crossed(corridor, room) == []
    up = np.array([0.0, 0.0, 1.9])
    assert walls.crossed(corridor + up, room + up) != []  # the lintel


def test_what_does_not_hold_is_seen(watched: Any) -> None:
    simulator = watched.simulator
    simulator.world.bodies["crate"].place((60.0, 0.0, 0.3, 0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 90.0, 0.0, 0.0, 0.0))
    watched.look(quiet=False)
    watched.check()
    assert {"through a wall", "too fast", "escaped"} <= set(watched.found.wrong)
    watched.found.wrong.clear()
    simulator.reset()
    watched.begin()
    watched.look(quiet=True)
    watched.check()
    assert watched.found.wrong == {}
    simulator.world.bodies["ball"].place((-4.0, -1.8, 0.0, 0.0, 0.0, 0.0, 1.0), (0.5, 0.0, 0.0, 0.0, 0.0, 0.0))
    watched.look(quiet=True)
    assert set(watched.found.wrong) == {"energy from nothing"}


def test_what_a_robot_pushes_that_rolls_on_by_itself_is_no_energy_from_nothing() -> None:
    # A drive of Gazebo's may hold its wheels to a speed that nobody commands any more.
    simulator = Simulator("simpleton", world="house", note=lambda _: None)
    watch = module("watch").Watch(simulator, module("found").Found("simpleton"))
    ball = simulator.world.bodies["ball"]
    x, y, _ = simulator.state.base_pose[:3]
    ball.place((x + 0.6, y, ball.pose[2], 0.0, 0.0, 0.0, 1.0))
    simulator.command((0.5, 0.0, 0.0), (0.0, 0.0, 0.0))
    fastest = 0.0
    for _ in range(40):
        simulator.step(50)
        watch.look(quiet=True)
        fastest = max(fastest, abs(ball.twist[0]))
    assert fastest > 0.3
    assert watch.found.wrong == {}
