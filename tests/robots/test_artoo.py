"""Artoo: four driven wheels that skid when it turns, a head with a topic of its own, a square to drive in."""

import math

import pytest

from urdfkit.description import load
from urdfkit.description.sdf import load_world
from urdfkit.kinematics import Kinematics
from urdfkit.messages import FLOAT, from_fields
from urdfkit.resources import find_model, robots_dir
from urdfkit.sim import Simulator

HALF_TRACK, HALF_BASE = 0.27, 0.18
TURNS = HALF_TRACK**2 / (HALF_TRACK**2 + HALF_BASE**2)
"""What Coulomb friction leaves of a turn on the spot: there the moments of four wheels that slip add up to nothing."""


@pytest.fixture(scope="module")
def robot():
    return load(find_model(["artoo"]).path)


def test_four_wheels(robot):
    for end, x in (("front", HALF_BASE), ("rear", -HALF_BASE)):
        for side, y in (("left", HALF_TRACK), ("right", -HALF_TRACK)):
            kinematics = Kinematics(robot)
            at = dict(zip(kinematics.link_names, kinematics.link_poses(kinematics.neutral()), strict=True))
            assert tuple(at[f"{end}_{side}_wheel"][:3]) == pytest.approx((x, y, 0.06))


def test_the_head_turns_by_its_own_topic(robot):
    simulator = Simulator(robot, note=lambda _: None)
    for angle in (1.0, -2.0):
        simulator.bus.publish("/artoo/head/command", FLOAT, from_fields(FLOAT, {"data": angle}))
        simulator.run(3.0)
        assert simulator.state.position("head_joint") == pytest.approx(angle, abs=1e-3)
    assert simulator.command_topics == ("/artoo/cmd_vel",)
    head = simulator.state.snapshot().placement("camera_optical", "base_footprint")
    assert math.atan2(head[0][1], head[0][0]) == pytest.approx(-2.0, abs=1e-3)


def test_it_drives_straight(robot, driven):
    run = driven(robot).drive(0.5, 0.0, seconds=5, ramp=1.0)
    distance, angle = run.off()
    assert distance < 0.01
    assert angle < 1e-6


@pytest.mark.parametrize("rate", [1.0, -0.5])
def test_it_turns_on_the_spot_as_friction_lets_it(robot, driven, rate):
    run = driven(robot).drive(0.0, rate, seconds=3, ramp=1.0)
    before = run.pose
    run.simulator.run(4.0)
    after = run.pose
    turned = math.remainder(after[2] - before[2], 2 * math.pi)
    assert turned == pytest.approx(rate * TURNS * 4.0, rel=0.01)
    assert math.hypot(after[0], after[1]) < 0.05
    assert after[4] < 1e-3


def test_it_does_not_tip_when_it_is_told_to_stop_at_once(robot, driven):
    run = driven(robot)
    worst = 0.0
    for v in (1.0, -1.0, 0.0):
        run.simulator.command((v, 0, 0), (0, 0, 0))
        for _ in range(150):
            run.simulator.step(20)
            worst = max(worst, run.pose[4])
    assert worst < 1e-3


def test_two_buildings_and_ten_objects():
    world = load_world(robots_dir() / "artoo/artoo_gazebo/worlds/town.sdf")
    names = {model.name for model in world.models} - {"ground_plane"}
    buildings = {"town_hall", "workshop"}
    assert buildings < names
    assert len(names - buildings) >= 10
