"""Trees as packets walk them: what is in the tree with two children a node is in the one with eight, once."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scene.rays.test_bvh import build
from urdfkit.scene.rays.ray_packet import CHILDREN, FAR
from urdfkit.scene.rays.ray_scene import widened
from urdfkit.scene.rays.wide_bvh import NONE


def some_boxes(count):
    low = np.random.default_rng(count).uniform(-1, 1, (count, 3))
    return np.hstack([low, low + 0.2])


@pytest.mark.parametrize("count", [1, 2, 3, 8, 9, 500])
def test_every_leaf_is_the_child_of_one_node(count: int) -> None:
    _, bounds, links = build(some_boxes(count), leaf=1)
    _, children = widened(bounds, links)
    taken = [row for row in children.reshape(-1, 3).tolist() if row[2] != NONE]
    assert sorted(first for first, size, _ in taken if size) == list(range(count))
    assert sorted(first for first, size, _ in taken if not size) == list(range(1, len(children)))
    for first, size, inner in taken:
        assert (links[inner, 1], links[inner, 0] if size else links[inner, 1]) == (size, first if size else 0)


def test_boxes_of_children_lie_side_by_side_and_nobody_enters_what_is_not_there() -> None:
    _, bounds, links = build(some_boxes(60), leaf=1)
    boxes, children = widened(bounds, links)
    there = children[..., 2] != NONE
    assert not there.all()
    by_child = boxes.reshape(-1, 6, CHILDREN).transpose(0, 2, 1)
    assert np.array_equal(by_child[there], bounds[children[..., 2][there]])
    assert (by_child[~there] == [FAR] * 3 + [-FAR] * 3).all()


def test_nodes_are_full_where_there_is_enough_below() -> None:
    _, bounds, links = build(some_boxes(4096), leaf=1)
    _, children = widened(bounds, links)
    there = (children[..., 2] != NONE).sum(axis=1)
    inner = (children[..., 1] == 0) & (children[..., 2] != NONE)
    assert (there[inner.any(axis=1)] == CHILDREN).all()
    assert len(children) < len(links) / 4
