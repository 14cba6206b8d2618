"""Walls, and whether something went through one."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.robot import Box
from urdfkit.sim import Simulator

Array = NDArray[np.float64]


class Walls:
    """The boxes of a world that nothing can push: no middle of anything is ever in one."""

    def __init__(self, simulator: Simulator) -> None:
        into, half, self.names = [], [], []
        builder = simulator.world.builder
        for body in map(builder.body, builder.static_poses):
            frame = matrix(body.pose)
            for piece in body.pieces:
                if isinstance(piece.shape.geometry, Box):
                    into.append(np.linalg.inv(frame @ piece.shape.placement))
                    half.append(np.array(piece.shape.geometry.size) / 2)
                    self.names.append(piece.shape.name)
        self._into, self._half = np.array(into), np.array(half)
        corners = [np.linalg.inv(m)[:2, 3] for m in into]
        reach = np.array([np.abs(np.linalg.inv(m)[:2, :3]) @ h for m, h in zip(into, half, strict=True)])
        self.low, self.high = (np.array(corners) - reach).min(0), (np.array(corners) + reach).max(0)

    def crossed(self, before: Array, now: Array) -> list[tuple[int, int]]:
        """Return which points' ways from `before` to `now` (n, 3) touch which wall."""
        a = np.einsum("wij,nj->wni", self._into[:, :3, :3], before) + self._into[:, None, :3, 3]
        b = np.einsum("wij,nj->wni", self._into[:, :3, :3], now) + self._into[:, None, :3, 3]
        way = np.where(np.abs(b - a) < 1e-12, 1e-12, b - a)
        h = self._half[:, None, :]
        enter = np.minimum((-h - a) / way, (h - a) / way).max(-1)
        leave = np.maximum((-h - a) / way, (h - a) / way).min(-1)
        hit = (enter <= leave) & (leave >= 0.0) & (enter <= 1.0)
        return [(int(n), int(w)) for w, n in zip(*np.nonzero(hit), strict=True)]


def matrix(pose: Any) -> Array:
    """Return x y z [m] and a quaternion x y z w as a homogeneous matrix."""
    x, y, z, qx, qy, qz, qw = pose
    return np.array(
        [
            [1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy - qz * qw), 2 * (qx * qz + qy * qw), x],
            [2 * (qx * qy + qz * qw), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz - qx * qw), y],
            [2 * (qx * qz - qy * qw), 2 * (qy * qz + qx * qw), 1 - 2 * (qx * qx + qy * qy), z],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )
