"""Sizes of placeholders: estimates from the other shapes of a link, its inertia and its neighbours."""

from collections.abc import Iterable

import numpy as np

from urdfkit.description.urdf.robot import Link, Robot
from urdfkit.linear_algebra import Array, matmul, symmetric_eigen, vector_norm
from urdfkit.scene.extent import shape_bounds
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.scene.scene_table import Role, Shape

ALONE = 0.1
"""Size of a placeholder without anything to estimate it from [m]."""
_THICKNESS = 0.3
"""Thickness of a link without shapes and inertia, relative to its length."""
_LEAST = 0.02
"""Least edge of a placeholder, relative to the median length of all links."""
_LARGEST = 1.2
"""Largest size by inertia, relative to the distance of the link's joints plus the median length of all links."""


class PlaceholderSizes:
    """Sizes of the placeholders of a robot.

    Args:
        robot: the robot.
        shapes: its shapes that can be shown.
    """

    def __init__(self, robot: Robot, shapes: Iterable[Shape]) -> None:
        self._robot = robot
        self._shapes: dict[tuple[str, Role], list[Shape]] = {}
        for shape in shapes:
            self._shapes.setdefault((shape.body, shape.role), []).append(shape)
        lengths = [vector_norm(joint.origin.xyz) for joint in robot.joints]
        lengths = [length for length in lengths if 0.0 < length < np.inf]
        self._length = float(np.median(lengths)) if lengths else ALONE

    def has_shapes(self, body: str, role: Role) -> bool:
        """Return whether a link has shapes of a role that can be shown."""
        return (body, role) in self._shapes

    def bounds(self, body: str, role: Role) -> Array:
        """Return the lowest and highest corner of a placeholder in the frame of its link [m]; shape (2, 3)."""
        others = self._shapes.get((body, "collision" if role == "visual" else "visual"), [])
        if others:
            corners = [corner for shape in others for corner in shape_bounds(shape, np.eye(4))]
        else:
            corners = [*self._to_joints(body), *self._inertia_box(self._robot.link_by_name[body])]
        low, high = np.min(corners, axis=0), np.max(corners, axis=0)
        least = _LEAST * self._length
        if len(corners) == 2 and not others:  # neither shapes nor inertia
            longest = float((high - low).max())
            thickness = _THICKNESS * (longest if longest > 0.1 * self._length else self._length)
            return np.array([low - thickness / 2.0, high + thickness / 2.0])
        grown = np.maximum(least - (high - low), 0.0) / 2.0
        return np.array([low - grown, high + grown])

    def _to_joints(self, body: str) -> Array:
        """Return the lowest and highest corner around the origin of a link and its child joints; shape (2, 3)."""
        below = self._robot.children_of.get(body, [])
        points = np.array([(0.0, 0.0, 0.0), *(joint.origin.xyz for joint in below)])
        return np.array([points.min(axis=0), points.max(axis=0)])

    def _inertia_box(self, link: Link) -> Array:
        """Return the corners of the solid box with the inertia of a link; none if it is missing or implausible."""
        none, own = np.zeros((0, 3)), link.inertial
        if own is None or own.inertia is None or not own.mass or own.mass < 0.0:
            return none
        moments, axes = symmetric_eigen(own.inertia.rows)
        squares = 6.0 / own.mass * (moments.sum() - 2.0 * moments)  # of a box: I₁ = m/12·(b² + c²), …
        low, high = self._to_joints(link.name)
        largest = _LARGEST * (float((high - low).max()) + self._length) if self._robot.joints else np.inf
        if not 0.0 < squares.max() <= largest**2:
            return none
        half = np.sqrt(np.maximum(squares, 0.0)) / 2.0
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
        frame = pose_matrix(own.origin)
        corners = matmul(matmul(signs * half, axes.T), frame[:3, :3].T) + frame[:3, 3]
        return corners if np.isfinite(corners).all() else none
