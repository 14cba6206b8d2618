"""The search for pairs finds those whose boxes meet, all of them, in order, and few for what is far apart."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from tests.sim.engine.worlds import piece, rover, rovers, slab
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Sphere
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene import Shape
from urdfkit.sim.engine.bodies import Body, Piece
from urdfkit.sim.engine.simulation_memory import FOUND_PAIRS, FOUND_ROWS


def turned(rng):
    q = rng.normal(size=4)
    return tuple((q / np.linalg.norm(q)).tolist())


def scatter(seed, count=40, static=12):
    rng = np.random.default_rng(seed)
    bodies = []
    for k in range(count):
        size = rng.uniform(0.05, 0.4, 3)
        kinds = (Box(tuple(size)), Sphere(size[0]), Cylinder(size[0], size[1]), Capsule(size[0], size[1]))
        at = rng.uniform((-1.0, -1.0, 2.0), (1.0, 1.0, 4.0))
        bodies.append(Body(f"b{k}", (*at, *turned(rng)), [piece(kinds[k % 4])], static=k >= count - static))
    return bodies


@pytest.mark.parametrize("seed", range(5))
def test_pairs_are_those_whose_boxes_meet(engine_of, seed):
    engine = rover(engine_of, bodies=scatter(seed), sleep=False)
    for _ in range(3):
        engine.step(1)
        a = engine.arrays
        count = int(a["counts"][FOUND_PAIRS])
        found = list(zip(a["pair_a"][:count].tolist(), a["pair_b"][:count].tolist(), strict=True))
        moving = int(a["tree_shape"][-1])
        gap = np.abs(a["shape_at"][:, None] - a["shape_at"]) - (a["shape_reach"][:, None] + a["shape_reach"])
        near = (gap <= 0.0).all(axis=2)
        owner = a["shape_owner"]
        wanted = [
            (i, j) for i, j in combinations(range(len(owner)), 2) if i < moving and near[i, j] and owner[i] != owner[j]
        ]
        assert found == wanted
        assert len(found) > 20


def test_boxes_hold_their_shapes_and_no_more(engine_of):
    rng = np.random.default_rng(3)
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    for _ in range(4):
        pose = turned(rng)
        bodies = [
            Body("box", (0.0, 0.0, 3.0, *pose), [piece(Box((0.4, 0.2, 0.6)))]),
            Body("can", (2.0, 0.0, 3.0, *pose), [piece(Cylinder(0.2, 0.6))]),
            Body("pill", (4.0, 0.0, 3.0, *pose), [piece(Capsule(0.2, 0.6))]),
            Body("ball", (6.0, 0.0, 3.0, *pose), [piece(Sphere(0.2))]),
        ]
        engine = rover(engine_of, bodies=bodies, sleep=False, gravity=(0.0, 0.0, 0.0))
        engine.step(1)
        reach = engine.arrays["shape_reach"][-4:]
        import pinocchio as pin

        R = pin.Quaternion(np.array(pose)).matrix()
        box = np.abs((corners * (0.2, 0.1, 0.3)) @ R.T).max(axis=0)
        axis = np.abs(R[:, 2])
        wheel = 0.2 * np.sqrt(1.0 - axis**2) + 0.3 * axis
        slack = 1e-4 + 1e-9
        for found, exact in zip(reach, (box, wheel, 0.2 + 0.3 * axis, np.full(3, 0.2)), strict=True):
            assert (found >= exact).all()
            assert (found <= exact + slack).all()


def test_a_wall_is_near_only_what_stands_at_it(engine_of):
    wall = slab("wall", (0.0, 2.0, 1.0), (10.0, 0.1, 2.0), static=True)
    engine = rover(engine_of, bodies=[wall])
    engine.step(1)
    assert engine.arrays["counts"][FOUND_PAIRS] == 0


def test_pairs_and_rows_of_many_robots_grow_with_their_number(engine_of):
    found = {}
    for count in (2, 50):
        engine = rovers(engine_of, count)
        engine.step(200)
        counts = engine.arrays["counts"]
        found[count] = counts[FOUND_PAIRS] / count, counts[FOUND_ROWS] / count
    assert found[50] == found[2]


def test_a_hull_off_its_origin_is_where_it_is(engine_of):
    corners = np.array([[x, y, z] for x in (4.9, 5.1) for y in (-0.1, 0.1) for z in (-0.1, 0.1)], dtype=np.float32)
    mesh = TriMesh(corners, np.array([[0, 1, 2]], dtype=np.int32), None, None, "")
    hull = Piece(Shape("collision", "hull", "collision", Mesh("hull.stl"), np.eye(4), mesh=mesh))
    engine = rover(engine_of, bodies=[Body("hull", (0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 1.0), [hull])], sleep=False)
    engine.step(1)
    assert engine.arrays["shape_at"][-1] == pytest.approx([5.0, 0.0, 3.0], abs=1e-4)
    assert engine.arrays["shape_reach"][-1] == pytest.approx([0.1] * 3, abs=1e-3)
