"""A running world is saved as it is: read back it is in the same place, and the real sdformat reads it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description.sdf import load_world
from urdfkit.sim import Simulator, Spawn

Sdformat = Callable[..., list[list[str]]]

WORLD = """<sdf version="1.9"><world name="probe">
<model name="ground_plane"><static>true</static><link name="link"><collision name="c"><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision></link></model>
<model name="door"><pose>2 0 0 0 0 0.3</pose><link name="frame"/><model name="leaf"><pose>0 0.5 0 0 0 0</pose>
<link name="panel"><pose>0.4 0 1 0 0 0</pose><inertial><mass>8</mass></inertial></link></model>
<joint name="bolt" type="fixed"><parent>world</parent><child>frame</child></joint>
<joint name="hinge" type="revolute"><pose>-0.4 0 0 0 0 0</pose><parent>frame</parent><child>leaf::panel</child>
<axis><xyz>0 0 1</xyz><limit><lower>-0.1</lower><upper>1.5</upper></limit></axis></joint></model>
<model name="pair"><pose>-2 0 0.1 0 0 0</pose><link name="a"><collision name="c"><geometry><ellipsoid>
<radii>0.1 0.2 0.1</radii></ellipsoid></geometry></collision></link><link name="b"><pose>0 1 0 0 0 0</pose><collision
name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model></world></sdf>"""


@pytest.fixture
def running(tmp_path: Path) -> Simulator:
    """Return a simulation in which a door was pushed open, and things were spawned, thrown and moved."""
    path = tmp_path / "probe.world"
    path.write_text(WORLD)
    simulator = Simulator("simpleton", world=path, spawn=Spawn(x=-5.0), note=lambda _: None)
    simulator.world.spawn("crate", (0.0, 3.0, 0.5, 0.4))
    simulator.world.spawn("wall", (6.0, 0.0, 0.0))
    simulator.world.place("wall", (7.0, 0.0, 0.0, 1.0))
    cart = tmp_path / "cart.urdf"
    cart.write_text(
        '<robot name="cart"><link name="base"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" '
        'iyz="0" izz="1"/></inertial><collision><geometry><sphere radius="0.1"/></geometry></collision></link></robot>'
    )
    simulator.world.spawn(cart, (0.0, -3.0, 0.1))
    simulator.world.bodies["pair::b"].place((-1.0, 1.0, 0.1, 0.0, 0.0, 0.2, 0.9797958971132712))
    simulator.world.push("door::leaf::panel", (0.0, 5.0, 0.0), for_seconds=0.3)
    simulator.run(0.5)
    return simulator


def test_what_is_read_back_is_where_it_was(running: Simulator, tmp_path: Path) -> None:
    path = tmp_path / "after.sdf"
    running.world.save(path)
    again = Simulator("simpleton", world=path, spawn=Spawn(x=-5.0), note=lambda _: None)
    before, after = running.world.body_poses(), again.world.body_poses()
    assert set(after) == set(before)
    for name, pose in before.items():
        assert after[name] == pytest.approx(pose, abs=1e-9) or after[name][3:] == pytest.approx(
            tuple(-part for part in pose[3:]), abs=1e-9
        ), name
    opened = running.world.robots["door"].state.position("hinge")
    assert opened > 0.05
    lower, upper = again.world.robots["door"].kinematics.limits("hinge")
    assert (lower, upper) == pytest.approx((-0.1 - opened, 1.5 - opened), abs=1e-12)


@pytest.mark.slow
def test_the_real_sdformat_reads_it_and_puts_everything_there(
    running: Simulator, tmp_path: Path, sdformat: Sdformat
) -> None:
    path = tmp_path / "after.sdf"
    running.world.save(path)
    lines = sdformat(path)
    assert [line for line in lines if line[0] == "error"] == []
    theirs = {line[1]: [float(word) for word in line[2].split()] for line in lines if line[0] == "link"}
    ours = running.world.body_poses()
    for name, theirs_name in (
        ("door::leaf::panel", "door::leaf::panel"),
        ("pair::b", "pair::b"),
        ("crate", "crate::link"),
    ):
        assert theirs[theirs_name][:3] == pytest.approx(ours[name][:3], abs=1e-9)


def test_what_sdf_cannot_include_is_left_out_and_noted(tmp_path: Path) -> None:
    remarks: list[str] = []
    simulator = Simulator("simpleton", note=remarks.append)
    simulator.world.spawn("simpleton", (0.0, 3.0, 0.0))
    simulator.world.save(tmp_path / "after.sdf")
    assert load_world(tmp_path / "after.sdf").robots == ()
    assert "robot `simpleton_1` is not saved: SDF includes .urdf files, not xacro" in remarks
