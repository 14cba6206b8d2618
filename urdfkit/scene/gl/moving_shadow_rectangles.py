"""Regions of the image in which shadows of moving shapes can fall; only there both shadow maps are sampled."""

from itertools import product

import numpy as np

from urdfkit.linear_algebra import Array
from urdfkit.scene.camera_model import Lens

LARGE = 0.6
"""Fraction of the image above which both maps are used for the whole image."""

Rectangle = tuple[int, int, int, int]
"""First column and row, width and height [px]."""


def shaded(
    casters: Array, towards: Array, everything: Array, turn: Array, origin: Array, lens: Lens, low: float, slack: float
) -> Rectangle:
    """Return the region of the image in which shapes and their shadows can be.

    Args:
        casters: boxes of the shapes in the world [m]; shape (n, 6), n at least 1.
        towards: unit vector towards the light in the world.
        everything: boxes of all shapes, which bound the shadows [m]; shape (shapes, 6).
        turn: rotation of the camera; shape (3, 3).
        origin: position of the camera [m].
        lens: camera model without distortion.
        low: distance of the near plane [m].
        slack: tolerance of the position of a shadow [m].
    """
    around = np.append(casters[:, :3].min(axis=0) - slack, casters[:, 3:].max(axis=0) + slack)
    near = np.array([around[[3 * x, 3 * y + 1, 3 * z + 2]] for x, y, z in product((0, 1), repeat=3)])
    # The light leaves the scene through one of its sides; the nearest side that all of it crosses bounds the shadows.
    side = np.where(towards > 0.0, everything[:, :3].min(axis=0), everything[:, 3:].max(axis=0))
    with np.errstate(divide="ignore", invalid="ignore"):
        lengths = np.where(np.abs(towards) > 1e-9, np.maximum((near - side) / towards, 0.0), np.inf)
    length = lengths[:, int(np.argmin(lengths.max(axis=0)))]
    points = (np.vstack([near, near - length[:, None] * towards]) - origin) @ turn
    # The part of their hull in front of the camera: its corners there, and its intersections with the near plane.
    first, second = (points[each] for each in np.triu_indices(len(points), 1))
    crossing = (first[:, 0] - low) * (second[:, 0] - low) < 0.0
    first, second = first[crossing], second[crossing]
    ends = first + (low - first[:, :1]) / (second[:, :1] - first[:, :1]) * (second - first)
    ahead = np.vstack([points[points[:, 0] >= low], ends])
    if not len(ahead):
        return 0, 0, 0, 0
    sides = []
    for axis, size in ((1, lens.width), (2, lens.height)):
        places = (size - 1) / 2 - lens.focal_length * ahead[:, axis] / np.maximum(ahead[:, 0], low)
        start = int(np.clip(np.floor(places.min()) - 1, 0, size))
        sides.append((start, int(np.clip(np.ceil(places.max()) + 2, 0, size)) - start))
    (column, width), (row, height) = sides
    return column, row, max(width, 0), max(height, 0)


def union(rectangles: list[Rectangle]) -> Rectangle:
    """Return the smallest rectangle that contains all others; empty rectangles are ignored."""
    kept = [each for each in rectangles if each[2] and each[3]]
    if not kept:
        return 0, 0, 0, 0
    left, top = min(each[0] for each in kept), min(each[1] for each in kept)
    right, bottom = max(each[0] + each[2] for each in kept), max(each[1] + each[3] for each in kept)
    return left, top, right - left, bottom - top
