"""Transforms of nodes against matrices."""

from __future__ import annotations

import random
from math import cos, radians, sin

import pytest

from urdfkit.description.meshes.node_transforms import AffineTransform
from urdfkit.description.meshes.points import UnusualFileError


def applied(transform: AffineTransform, point: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(sum(a * b for a, b in zip(row, (*point, 1.0), strict=True)) for row in transform.rows)


def test_a_product_applies_the_inner_transform_first() -> None:
    chance = random.Random(0)
    one, other = (
        AffineTransform.of_rows([[chance.uniform(-1, 1) for _ in range(4)] for _ in range(3)]) for _ in range(2)
    )
    point = (0.3, -0.7, 2.0)
    assert applied(one @ other, point) == pytest.approx(applied(one, applied(other, point)))
    assert one @ AffineTransform.identity() == one


@pytest.mark.parametrize("first", range(3))
def test_a_turn_about_an_axis_of_coordinates_is_right_handed(first: int) -> None:
    """It turns the next axis towards the one after it."""
    axis = tuple(float(k == first) for k in range(3))
    second, third = (first + 1) % 3, (first + 2) % 3
    point = tuple(float(k == second) for k in range(3))
    expected = {first: 0.0, second: cos(radians(30)), third: sin(radians(30))}
    assert applied(AffineTransform.turned(axis, 30), point) == pytest.approx([expected[k] for k in range(3)])


def test_a_turn_leaves_its_axis() -> None:
    axis = (0.48, -0.6, 0.64)
    assert applied(AffineTransform.turned(axis, 70), axis) == pytest.approx(axis)
    with pytest.raises(UnusualFileError):
        AffineTransform.turned((0.48, -0.6, 0.65), 70)
