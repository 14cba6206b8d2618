"""A robot that starts inside something: a note that names link, thing and depth, and nothing else happens."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from urdfkit.sim import Simulator, Spawn

WALL = """<sdf version="1.9"><world name="w"><model name="ground_plane"><static>true</static><link name="l">
<collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
<model name="wall"><static>true</static><pose>2 0 1 0 0 0</pose><link name="l"><collision name="c"><geometry><box>
<size>0.4 6 2</size></box></geometry></collision></link></model></world></sdf>"""


@pytest.fixture
def world(tmp_path: Path) -> Path:
    path = tmp_path / "w.world"
    path.write_text(WALL)
    return path


def deep(world: Path | str, spawn: Spawn) -> list[str]:
    notes: list[str] = []
    Simulator("simpleton", world=world, spawn=spawn, note=notes.append)
    return [note for note in notes if " mm inside " in note]


def test_inside_a_wall(world: Path) -> None:
    (note,) = deep(world, Spawn(x=2.0, y=0.0))
    assert re.fullmatch(r"link `\w+` starts 200 mm inside `wall`; start the robot elsewhere \(--spawn, Spawn\)", note)


def test_below_the_ground() -> None:
    (note,) = deep("empty", Spawn(z=-0.05))
    assert " starts 50 mm inside `ground_plane`" in note


def test_models_of_the_world(tmp_path: Path) -> None:
    crates = "".join(
        f"<include><uri>model://crate</uri><name>crate_{k}</name><pose>{x} 0 {z} 0 0 0</pose></include>"
        for k, (x, z) in enumerate([(3, -0.2), (3, 5), (5, 0), (5, 0.002)])
    )
    path = tmp_path / "w.world"
    path.write_text(WALL.replace("</world>", f"{crates}</world>"))
    notes = deep(path, Spawn())
    assert len(notes) == 1
    pattern = r"model `crate_\d` starts \d+ mm inside `crate_\d`; .*<pose> \(other overlapping pairs: 1\)"
    assert re.fullmatch(pattern, notes[0])
    path.write_text(WALL.replace("</world>", f"{crates[: crates.index('</include>') + 10]}</world>"))
    assert deep(path, Spawn()) == ["model `crate_0` starts 200 mm inside `ground_plane`; change its <pose>"]


def test_nothing_is_reported_of_a_robot_that_stands_or_touches(world: Path) -> None:
    assert deep(world, Spawn(x=0.0)) == []
    assert deep("empty", Spawn(z=-0.001)) == []


def test_looking_changes_nothing(world: Path) -> None:
    simulator = Simulator("simpleton", world=world, spawn=Spawn(x=2.0), note=lambda text: None)
    before = simulator.state.q.tobytes() + simulator.state.v.tobytes()
    simulator.reset()
    assert simulator.state.q.tobytes() + simulator.state.v.tobytes() == before
    assert simulator.t == 0.0
    assert simulator.state.contacts == ()


def spawned(height: float) -> list[str]:
    notes: list[str] = []
    simulator = Simulator("simpleton", note=notes.append)
    simulator.run(0.1)
    before = simulator.state.q.tobytes()
    simulator.world.spawn("crate", (3.0, 0.0, height), name="box")
    assert simulator.state.q.tobytes() == before
    assert simulator.t == pytest.approx(0.1)
    return [note for note in notes if " mm inside " in note]


def test_a_body_that_is_put_into_the_ground() -> None:
    (note,) = spawned(-0.2)
    assert re.fullmatch(r"`box` starts 200 mm inside `ground_plane`; place `box` elsewhere", note)


def test_a_body_that_is_put_on_the_ground() -> None:
    assert spawned(0.0) == []


@pytest.mark.slow
def test_a_robot_that_is_put_into_another(world: Path) -> None:
    notes: list[str] = []
    simulator = Simulator("simpleton", world=world, note=notes.append)
    simulator.world.spawn("simpleton", Spawn(x=2.0), name="other")
    (note,) = [note for note in notes if " mm inside " in note]
    assert re.fullmatch(r"`other::\w+` starts 200 mm inside `wall`; place `other` elsewhere", note)
