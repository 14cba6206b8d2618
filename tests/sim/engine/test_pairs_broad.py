"""The broad phase finds exactly the pairs whose boxes meet."""

from __future__ import annotations

import math

import numpy as np
import pytest

from urdfkit.sim.engine.pairs.broad import find_pairs, shape_bounds
from urdfkit.sim.engine.pairs.shapes import BOX, CYLINDER, PLANE
from urdfkit.sim.engine.spatial import IDENTITY


def pairs_of(
    low: np.ndarray, high: np.ndarray, body: np.ndarray, static: np.ndarray, excluded: list[int], order: np.ndarray
) -> list[tuple[int, int]]:
    count = len(body)
    room = count * count
    a, b = np.zeros(room, dtype=np.int64), np.zeros(room, dtype=np.int64)
    active = np.zeros(count, dtype=np.int64)
    keys = np.array(sorted(excluded), dtype=np.int64)
    found = find_pairs(
        count, 0, low.ravel(), high.ravel(), body, static, int(body.max()) + 1, keys, order, active, a, b
    )
    return list(zip(a[:found].tolist(), b[:found].tolist(), strict=True))


def test_finds_the_pairs_that_meet_and_no_others_as_boxes_move() -> None:
    rng = np.random.default_rng(1)
    count = 200
    middle = rng.uniform(-2.0, 2.0, (count, 3))
    half = rng.uniform(0.05, 0.4, (count, 3))
    body = np.arange(count) // 2
    static = (body % 3 == 0).astype(np.int64)
    bodies = int(body.max()) + 1
    excluded = [a * bodies + b for a in range(0, bodies, 7) for b in range(a + 1, bodies, 2)]
    order = np.arange(count)
    for _ in range(20):
        middle += rng.normal(scale=0.05, size=(count, 3))
        low, high = middle - half, middle + half
        expected = {
            (i, j)
            for i in range(count)
            for j in range(i + 1, count)
            if body[i] != body[j]
            and not (static[i] and static[j])
            and body[i] * bodies + body[j] not in excluded
            and np.all(low[i] <= high[j])
            and np.all(low[j] <= high[i])
        }
        found = pairs_of(low, high, body, static, excluded, order)
        assert len(found) == len(set(found))
        assert set(found) == expected
        # What was sorted before makes no difference to what is found, or in which order.
        assert found == pairs_of(low, high, body, static, excluded, rng.permutation(count))


def test_says_how_much_room_it_lacks() -> None:
    low, high = np.zeros(30), np.ones(30)
    body = np.arange(10)
    a, b = np.zeros(4, dtype=np.int64), np.zeros(4, dtype=np.int64)
    none = np.zeros(0, dtype=np.int64)
    static = np.zeros(10, dtype=np.int64)
    active = np.zeros(10, dtype=np.int64)
    assert find_pairs(10, 0, low, high, body, static, 10, none, np.arange(10), active, a, b) == 45
    assert a.tolist() == [0, 0, 1, 0]
    assert b.tolist() == [1, 2, 2, 3]


def test_boxes_hold_their_shapes() -> None:
    low, high = np.zeros(9), np.zeros(9)
    numbers, indices = np.zeros(1), np.zeros(1, dtype=np.int64)
    c, s = math.cos(0.3), math.sin(0.3)
    turned = (c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
    shape_bounds(0, BOX, (1.0, 2.0, 3.0), turned, (5.0, 0.0, 0.0), 0, numbers, indices, 0.1, low, high)
    assert high[:3] == pytest.approx([5.0 + c + 2.0 * s + 0.1, s + 2.0 * c + 0.1, 3.1])
    assert low[:3] == pytest.approx([5.0 - c - 2.0 * s - 0.1, -s - 2.0 * c - 0.1, -3.1])
    shape_bounds(1, CYLINDER, (0.5, 1.0, 0.0), IDENTITY, (0.0, 0.0, 0.0), 0, numbers, indices, 0.0, low, high)
    assert high[3:6] == pytest.approx([0.5, 0.5, 1.0])
    shape_bounds(2, PLANE, (0.0, 0.0, 0.0), IDENTITY, (0.0, 0.0, 2.0), 0, numbers, indices, 0.1, low, high)
    assert high[6:].tolist() == [math.inf, math.inf, 2.1]
    assert np.all(low[6:] == -math.inf)
