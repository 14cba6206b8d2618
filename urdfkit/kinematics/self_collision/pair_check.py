"""Collision and distance of two links in relative placements, by coal."""

from typing import Any

import numpy as np

from urdfkit.kinematics.self_collision.collision_shapes import CollisionShape
from urdfkit.linear_algebra import Array


class PairCheck:
    """Checks of the shapes of two links.

    Args:
        first: shapes of the first link.
        second: shapes of the second link.

    Attributes:
        checks: how many pairs of triangle meshes have been checked.
    """

    def __init__(self, first: tuple[CollisionShape, ...], second: tuple[CollisionShape, ...]) -> None:
        import coal

        self.checks = 0
        self._fixed, self._moved = coal.Transform3s(), coal.Transform3s()
        self._request, self._result = coal.CollisionRequest(), coal.CollisionResult()
        self._distance_request, self._distance = coal.DistanceRequest(), coal.DistanceResult()
        self._parts = [
            (
                a,
                b,
                coal.ComputeCollision(a.convex, b.convex),
                coal.ComputeCollision(a.exact or a.convex, b.exact or b.convex) if a.exact or b.exact else None,
            )
            for a in first
            for b in second
        ]

    def collides(self, rotation: Array, translation: Array) -> bool:
        """Whether any two shapes collide, the second link placed in the frame of the first."""
        for a, b, convex, exact in self._parts:
            self._place(a, b, rotation, translation)
            self._result.clear()
            if convex(self._fixed, self._moved, self._request, self._result):
                if exact is None:
                    return True
                self.checks += 1
                self._result.clear()
                if exact(self._fixed, self._moved, self._request, self._result):
                    return True
        return False

    def distance(self, rotation: Array, translation: Array, *, convex: bool = True) -> tuple[float, Array, Array]:
        """Return the distance of the nearest shapes [m], 0 or less if they collide, its direction, and its point.

        The direction is a unit vector from the first to the second link, the point is on the second link; both in the
        frame of the first.
        """
        import coal

        best: tuple[float, Array, Array] = np.inf, np.zeros(3), np.zeros(3)
        for a, b, _, _ in self._parts:
            self._place(a, b, rotation, translation)
            self._distance.clear()
            shapes: tuple[Any, Any] = (a.convex, b.convex) if convex else (a.exact or a.convex, b.exact or b.convex)
            value = coal.distance(
                shapes[0], self._fixed, shapes[1], self._moved, self._distance_request, self._distance
            )
            if value < best[0]:
                best = float(value), np.array(self._distance.normal), np.array(self._distance.getNearestPoint2())
        return best

    def _place(self, a: CollisionShape, b: CollisionShape, rotation: Array, translation: Array) -> None:
        self._fixed.setRotation(a.rotation)
        self._fixed.setTranslation(a.translation)
        self._moved.setRotation(rotation @ b.rotation)
        self._moved.setTranslation(translation + rotation @ b.translation)
