"""Heaps of more trees than are solved in blocks: bounded work, impulses inside their cones, no sinking, and sleep."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.sim.engine.worlds import ball, can, cube, rover, slab
from urdfkit.description import load
from urdfkit.errors import SimulationError
from urdfkit.kinematics import Kinematics
from urdfkit.scene import scene_of
from urdfkit.sim.engine import Engine
from urdfkit.sim.engine.island_solver.block_matrix import MOST_TREES
from urdfkit.sim.engine.island_solver.gauss_seidel import SWEEPS
from urdfkit.sim.engine.layout.world_arrays import MOST_DENSE
from urdfkit.sim.engine.simulation_memory import FOUND_CONTACTS, FOUND_ROWS, GUESSES, allocate

X = 3.0
"""Where things are, away from the robot [m]."""


def box(name, at):
    return cube(name, at, side=0.12)


def tray(count, half, *, seed=0, top=2.5, makers=(box,)):
    """Return the walls of a tray, and bodies, boxes at first, tumbled above it."""
    rng = np.random.default_rng(seed)
    at, long = half + 0.025, 2.0 * half + 0.1
    things = [
        slab(f"wall{k}", (X + at * x, at * y, 0.25), (0.05 if x else long, 0.05 if y else long, top), static=True)
        for k, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1)))
    ]
    side = int(2.0 * half / 0.18)
    for k in range(count):
        row, column, layer = k % side - (side - 1) / 2.0, k // side % side - (side - 1) / 2.0, k // side**2
        place = (X + 0.18 * row, 0.18 * column, 0.15 + 0.21 * layer)
        turned = rng.normal(size=4)
        body = makers[k % len(makers)](f"b{k}", place)
        things.append(replace(body, pose=(*place, *(turned / np.linalg.norm(turned)))))
    return things


def heights(engine):
    return np.array([body.pose[2] for body in engine.bodies.values()])


def cone_excess(engine):
    """Return by how much the impulses of all contacts leave their cones, over the largest of them."""
    a = engine.arrays
    n = int(a["counts"][FOUND_CONTACTS])
    first, second, normal = a["contact_impulse"][:n].T
    excess = np.maximum(np.hypot(first, second) - a["contact_mu"][:n] * normal, -normal)
    return excess.max() / max(normal.max(), 1e-12)


def all_asleep(engine, seconds):
    """Advance until all bodies sleep, or for so long; return whether they do."""
    while engine.t < seconds and not all(body.asleep for body in engine.bodies.values()):
        engine.step(100)
    return all(body.asleep for body in engine.bodies.values())


@pytest.mark.slow
def test_sweeps_are_bounded_and_leave_impulses_in_their_cones(engine_of):
    engine = rover(engine_of, bodies=tray(80, 0.4))
    counts = engine.arrays["counts"]
    swept = 0
    for _ in range(80):
        engine.step(10)
        guesses = int(counts[GUESSES])
        if int(counts[FOUND_ROWS]) > 600:
            swept += 1
            # Never the matrix of all rows, and no more sweeps than so many.
            assert -SWEEPS - 1 <= guesses != 0
            assert cone_excess(engine) < 1e-9
    assert swept > 20


# With sweeps alone the second crept on at 1 mm/s, and in the third a column of four boxes swayed at 4 mm/s.
# In the last, boxes crept on at 0.7 mm/s. In the one before, a box swung between two corners of its neighbours.
@pytest.mark.slow
@pytest.mark.parametrize(
    ("count", "half", "seed"),
    [(30, 0.3, 4), (80, 0.4, 2), (80, 0.4, 3), (200, 0.55, 3), (200, 0.55, 0)],
)
def test_a_heap_of_boxes_sleeps_within_six_seconds(engine_of, count, half, seed):
    engine = rover(engine_of, bodies=tray(count, half, seed=seed, top=4.0))
    assert all_asleep(engine, 6.0)
    assert max(contact.depth for contact in engine.contacts()) < 1e-4
    # It lies inside the walls, and no box in another or in the ground.
    places = np.array([body.pose[:3] for body in engine.bodies.values()])
    assert np.abs(places[:, :2] - (X, 0.0)).max() < half - 0.06 + 1e-4
    assert places[:, 2].min() > 0.06 - 1e-4


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 5])
def test_a_heap_of_boxes_balls_and_cans_sleeps_within_six_seconds(engine_of, seed):
    makers = (
        box,
        lambda name, at: ball(name, at, radius=0.06),
        lambda name, at: can(name, at, radius=0.06, length=0.12),
    )
    engine = rover(engine_of, bodies=tray(60, 0.4, seed=seed, top=4.0, makers=makers))
    assert all_asleep(engine, 6.0)
    assert max(contact.depth for contact in engine.contacts()) < 1e-4


@pytest.mark.slow
def test_a_heap_that_stays_awake_does_not_sink(engine_of):
    engine = rover(engine_of, bodies=tray(MOST_TREES + 3, 0.55), sleep=False)
    engine.step(2500)
    before = heights(engine)
    for _ in range(10):
        engine.step(100)
        assert max(contact.depth for contact in engine.contacts()) < 1e-4
    assert (before - heights(engine)).mean() < 1e-4


def test_what_touches_with_another_feature_goes_on_with_its_impulse(engine_of):
    engine = rover(engine_of, bodies=[cube(f"box{k}", (X, 0.0, 0.1 + 0.2 * k)) for k in range(3)], sleep=False)
    engine.step(50)
    arrays = engine.arrays
    loads = np.array([contact.force for contact in engine.contacts() if contact.b.startswith("box")])
    assert len(loads) == 8
    arrays["last_feature"][:8] += 1000
    engine.step()
    assert arrays["counts"][GUESSES] == 1
    again = np.array([contact.force for contact in engine.contacts() if contact.b.startswith("box")])
    assert again == pytest.approx(loads, abs=1e-9)


def test_an_island_of_more_rows_than_have_room_for_their_matrix_is_swept(engine_of):
    grid = [cube(f"c{k}", (X + 0.25 * (k % 11), 0.25 * (k // 11), 0.1)) for k in range(121)]
    plate = slab("plate", (X + 1.25, 1.25, 0.21), (2.8, 2.8, 0.02))
    engine = rover(engine_of, bodies=[*grid, plate], sleep=False)
    engine.step(60)
    assert int(engine.arrays["counts"][FOUND_ROWS]) > MOST_DENSE
    assert engine.bodies["plate"].pose[2] == pytest.approx(0.21, abs=1e-4)
    assert max(contact.depth for contact in engine.contacts()) < 1e-4
    on_plate = sum(contact.force[2] * (1 if contact.a == "plate" else -1) for contact in engine.contacts()
                   if "plate" in (contact.a, contact.b))  # fmt: skip
    assert on_plate == pytest.approx(9.81 * plate.mass, rel=0.05)


def test_a_robot_that_lies_on_hundreds_of_points_lies(tmp_path):
    boxes = "".join(
        f'<collision><origin xyz="{0.1 * (k % 15)} {0.1 * (k // 15)} 0.05"/><geometry><box size="0.09 0.09 0.1"/>'
        "</geometry></collision>"
        for k in range(150)
    )
    inertial = (
        '<inertial><origin xyz="0.7 0.45 0.05"/><mass value="5"/>'
        '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    )
    (tmp_path / "bed.urdf").write_text(f'<robot name="bed"><link name="bed">{inertial}{boxes}</link></robot>')
    kinematics = Kinematics(load(tmp_path / "bed.urdf"), floating_base=True)
    engine = Engine(kinematics, scene_of(kinematics.robot).shapes)
    engine.step(20)
    counts = engine.arrays["counts"]
    assert (counts[FOUND_CONTACTS], counts[FOUND_ROWS]) == (600, 1800)
    assert engine.q[:3] == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    assert sum(contact.force[2] for contact in engine.contacts()) == pytest.approx(5 * 9.81, rel=1e-6)
    assert {contact.a_shape for contact in engine.contacts()} == set(range(150))


def test_a_world_that_takes_more_memory_than_there_is_is_refused_in_a_line():
    with pytest.raises(SimulationError, match=r"a world of 1 robots .* needs 1.6e\+06 GB"):
        allocate([1, 6, 7, 0, 0, 0, 0, 1, 0, 1, 36, 6, 10**14, 0, 0, 0, 0, 0], width=6)
