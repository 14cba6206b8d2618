"""What rows do where guesses lead nowhere: robots that are stuck, knocked stacks, heaps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.bench import towers
from tests.bench.contact_rich.scenes import cases
from tests.bench.peers.engine_scene import InUrdfkit
from tests.sim.engine.worlds import cube, rover, slab
from urdfkit.sim import Simulator
from urdfkit.sim.engine.island_solver.augmented_lagrangian import BALANCE, HARDNESS, HEAP_ROUNDS, MORE_ROUNDS
from urdfkit.sim.engine.simulation_memory import GUESSES

X = 3.0
"""Where things are, away from the robot [m]."""
IN_VAIN = -(MORE_ROUNDS + 1)


def test_every_round_has_its_stiffness_and_balance():
    assert MORE_ROUNDS >= len(HARDNESS) == len(BALANCE) >= HEAP_ROUNDS


def test_a_robot_stalled_against_a_pillar_is_solved_as_quickly_as_one_that_drives():
    simulator = Simulator("artoo", world="cylinders")
    engine = simulator.world.builder.engine
    for _ in range(80):
        simulator.command((0.5, 0.0, 0.0), (0.0, 0.0, 0.3))
        simulator.step(100)
    before, place = engine.iterated, engine.q[:3].copy()
    for _ in range(10):
        simulator.command((0.5, 0.0, 0.0), (0.0, 0.0, 0.3))
        simulator.step(100)
    # It is stuck, its wheels still turning, and yet what rows do is known from the step before.
    assert np.abs(engine.q[:3] - place).max() < 1e-3
    assert np.abs(engine.v[7:]).max() > 5.0
    assert engine.iterated - before < 100


def test_a_knocked_stack_is_never_only_nearly_solved(engine_of):
    engine = rover(engine_of, bodies=[cube(f"box{k}", (X, 0.0, 0.1 + 0.2 * k)) for k in range(5)], sleep=False)
    engine.step(50)
    for sign in (1.0, -1.0, 1.0, -1.0):
        top = engine.bodies["box4"]
        top.place(top.pose, (0.02 * sign, 0.0, 0.0, 0.0, 0.0, 0.0))
        guesses = []
        for _ in range(30):
            engine.step()
            guesses.append(int(engine.arrays["counts"][GUESSES]))
        assert min(guesses) > IN_VAIN
        assert sum(each < 0 for each in guesses) <= 6
        assert set(guesses[15:]) == {1}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["tower-24", "tower-24-turned-10", "wall-8x8"])
def test_a_nudged_tower_or_wall_comes_to_rest_and_sleeps(name):
    engine = towers.nudged(name, 0.02)
    engine.step(700)
    assert all(body.asleep for body in engine.bodies.values())
    assert towers.displacement(name, engine) < 1e-4


@pytest.mark.slow
def test_columns_of_boxes_that_fell_and_lean_on_each_other_come_to_rest():
    case = next(each for each in cases() if each.scene.name == "heap-200")
    running = InUrdfkit(case.scene, sleep=True)
    running.advance(1200)
    # With sixty sweeps in each step, half of the boxes swayed at 20 mm/s for ever.
    assert running.asleep() == 200
    assert all(check.ok for check in case.scene.check(running))


@pytest.mark.slow
def test_thirty_tumbled_boxes_in_a_tray_come_to_rest(engine_of):
    rng = np.random.default_rng(0)
    walls = [
        slab(f"wall{k}", (X + 0.325 * x, 0.325 * y, 0.25), (0.05 if x else 0.7, 0.05 if y else 0.7, 0.5), static=True)
        for k, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1)))
    ]
    things = []
    for k in range(30):
        side, along = 0.02 * rng.normal(size=2)
        at = (X - 0.15 + 0.15 * (k % 3) + side, -0.15 + 0.15 * (k // 3 % 3) + along, 0.15 + 0.2 * (k // 9))
        turned = rng.normal(size=4)
        turned /= np.linalg.norm(turned)
        things.append(replace(cube(f"b{k}", at, side=0.12), pose=(*at, *turned)))
    engine = rover(engine_of, bodies=[*walls, *things])
    engine.step(3000)
    assert all(body.asleep for body in engine.bodies.values())
    assert max(contact.depth for contact in engine.contacts()) < 1e-4
