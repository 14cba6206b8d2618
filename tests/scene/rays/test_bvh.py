"""Many shapes through the tree: the same hits as one by one, also after they have moved."""

from __future__ import annotations

import numpy as np

from tests.scene.rays.conftest import random_geometry, random_poses, rotations, scene_of_shapes, shape, units
from tests.scene.rays.truth import nearest
from urdfkit.scene.rays import RayTable
from urdfkit.scene.rays.bvh import SCRATCH
from urdfkit.scene.rays.kernels import kernel

KINDS = ("box", "sphere", "cylinder", "capsule", "ellipsoid", "cone")


def crowd(random, count):
    return [shape(random_geometry(random, KINDS[k % len(KINDS)]), f"s{k}") for k in range(count)]


def one_by_one(shapes, poses, origins, directions):
    """Return the nearest hit of tables that hold one shape each."""
    best = np.full(len(directions), np.inf)
    for each, pose in zip(shapes, poses, strict=True):
        table = RayTable(scene_of_shapes([each]), [each])
        table.place(pose)
        best = np.minimum(best, table.cast(origins, directions).distances)
    return best


def test_the_nearest_of_many_is_found() -> None:
    random = np.random.default_rng(1)
    shapes = crowd(random, 300)
    poses = random_poses(random, 300, spread=20.0)
    table = RayTable(scene_of_shapes(shapes), shapes)
    table.place(poses)
    origins, directions = random.uniform(-20, 20, (3000, 3)), units(random, 3000)
    hits = table.cast(origins, directions)
    assert np.array_equal(hits.distances, one_by_one(shapes, poses, origins, directions))
    R = rotations(poses)
    for k in random.choice(np.flatnonzero(hits.shapes >= 0), 200):
        s = hits.shapes[k]
        true = nearest(shapes[s].geometry, R[s], poses[s, :3], origins[k], directions[k])
        assert abs(hits.distances[k] - true) < 1e-9


def test_shapes_that_move_are_found_where_they_are() -> None:
    random = np.random.default_rng(2)
    shapes = crowd(random, 60)
    poses = random_poses(random, 60)
    table = RayTable(scene_of_shapes(shapes), shapes)
    origins, directions = random.uniform(-6, 6, (500, 3)), units(random, 500)
    for _ in range(10):  # far enough that the tree is refitted at first and built anew at last
        poses = poses + np.hstack([random.normal(0.0, 1.0, (60, 3)), np.zeros((60, 4))])
        table.place(poses)
        fresh = RayTable(scene_of_shapes(shapes), shapes)
        fresh.place(poses)
        moved, new = table.cast(origins, directions), fresh.cast(origins, directions)
        assert np.array_equal(moved.distances, new.distances)
        assert np.array_equal(moved.shapes, new.shapes)


def test_a_packet_of_rays_from_everywhere_finds_what_single_rays_find() -> None:
    random = np.random.default_rng(3)
    shapes = crowd(random, 50)
    table = RayTable(scene_of_shapes(shapes), shapes)
    table.place(random_poses(random, 50))
    origins, directions = random.uniform(-6, 6, (333, 3)), units(random, 333)
    together = table.cast(origins, directions, normals=True)
    for k in range(333):
        alone = table.cast(origins[k], directions[k], normals=True)
        assert alone.distances[0] == together.distances[k]
        assert alone.shapes[0] == together.shapes[k]
        assert np.array_equal(alone.normals[0], together.normals[k])


def test_a_frame_turns_and_moves_rays() -> None:
    random = np.random.default_rng(4)
    shapes = crowd(random, 20)
    table = RayTable(scene_of_shapes(shapes), shapes)
    table.place(random_poses(random, 20))
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = rotations(random_poses(random, 1))[0], (1.0, -2.0, 0.5)
    directions = units(random, 100)
    inside = table.cast((0.1, 0.2, 0.3), directions, frame=frame)
    outside = table.cast(frame[:3, :3] @ (0.1, 0.2, 0.3) + frame[:3, 3], directions @ frame[:3, :3].T)
    assert np.allclose(inside.distances, outside.distances, atol=1e-12, rtol=0)


def test_a_scene_without_shapes_is_empty() -> None:
    table = RayTable(scene_of_shapes([]), [])
    table.place(np.empty((0, 7)))
    assert np.isinf(table.cast((0, 0, 0), [[1.0, 0, 0]]).distances).all()
    assert table.cast((0, 0, 0), np.empty((0, 3))).distances.shape == (0,)


def build(boxes, leaf=2):
    count = len(boxes)
    order, bounds = np.empty(count, np.int64), np.empty((2 * count - 1, 6))
    links = np.empty((2 * count - 1, 2), np.int64)
    nodes = kernel("build")(np.ascontiguousarray(boxes, dtype=float), order, bounds, links, leaf, np.empty(SCRATCH))
    return order, bounds[:nodes], links[:nodes]


def depth(links, node=0):
    first, size = links[node]
    return 1 if size else 1 + max(depth(links, first), depth(links, first + 1))


def test_every_box_is_in_one_leaf_and_every_node_holds_what_is_below() -> None:
    random = np.random.default_rng(5)
    low = random.uniform(-1, 1, (500, 3))
    boxes = np.hstack([low, low + random.uniform(0, 0.3, (500, 3))])
    order, bounds, links = build(boxes)
    assert sorted(order.tolist()) == list(range(500))
    held = []
    for node, (first, size) in enumerate(links):
        if size:
            held.extend(range(first, first + size))
            below = boxes[order[first : first + size]]
        else:
            assert first > node
            below = bounds[first : first + 2]
        assert np.array_equal(bounds[node], [*below[:, :3].min(axis=0), *below[:, 3:].max(axis=0)])
    assert sorted(held) == list(range(500))


def test_no_input_makes_a_tree_too_deep_for_the_stack() -> None:
    ever_smaller = 0.5 ** np.arange(900.0)[:, None]
    boxes = np.hstack([np.repeat(ever_smaller, 3, axis=1)] * 2)
    assert depth(build(boxes)[2]) < 60
    assert depth(build(np.zeros((1000, 6)))[2]) < 12
