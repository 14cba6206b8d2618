"""Bounding boxes of labelled objects: 2D around the visible part or the whole object, and oriented 3D.

Source: gz-rendering, Ogre2BoundingBoxCamera.cc. An object gets a box if it is visible in at least one pixel. A 3D box
has the axes of the object's shape if the object has one shape, else the principal axes of its vertices (gz-math,
eigen3/Util.hh, verticesToOrientedBox).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array, matmul
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.gl.triangle_models import triangles_of
from urdfkit.scene.rays.ray_scene import RayTable

Numbers = NDArray[np.int64]

AHEAD = 1e-3
"""Depth at which geometry is clipped before projection [m]."""

EDGES = ((0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7), (6, 7))
"""Edges of a box, as pairs of indices into `Box3D.corners`."""


@dataclass(frozen=True)
class Box2D:
    """2D box in pixel coordinates with the origin at the upper left; the last column and row are inside the box.

    Attributes:
        label: label of the object.
        left: first column [px].
        top: first row [px].
        right: last column [px].
        bottom: last row [px].
    """

    label: int
    left: int
    top: int
    right: int
    bottom: int


@dataclass(frozen=True, eq=False)
class Box3D:
    """Oriented 3D box in the camera's frame: x forward, y left, z up.

    Attributes:
        label: label of the object.
        centre: centre of the box [m]; shape (3,).
        axes: rotation whose columns are the axes of the box; shape (3, 3).
        size: edge lengths along its axes [m]; shape (3,).
    """

    label: int
    centre: Array
    axes: Array
    size: Array

    @property
    def corners(self) -> Array:
        """Corners of the box [m]; shape (8, 3)."""
        signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        found: Array = self.centre + matmul(signs * self.size / 2, self.axes.T)
        return found


def visible_box(label: int, where: NDArray[np.bool_]) -> Box2D:
    """Return the box around the pixels in which an object is visible; mask of shape (height, width)."""
    row, column = np.nonzero(where)
    return Box2D(label, int(column.min()), int(row.min()), int(column.max()), int(row.max()))


def full_box(label: int, table: RayTable, shapes: list[int], frame: Array, lens: Lens) -> Box2D:
    """Return the 2D box around a whole object, occluded parts included, clipped to the picture.

    Args:
        label: label of the object.
        table: the shapes of the scene with their placements.
        shapes: indices of the shapes of the object.
        frame: placement of the camera in the world; shape (4, 4).
        lens: lens of the camera.
    """
    faces = np.concatenate([_in_camera(table, shape, frame) for shape in shapes])
    points = faces.reshape(-1, 3)
    start, end = (faces[:, order].reshape(-1, 3) for order in ([0, 1, 2], [1, 2, 0]))
    crossing = (start[:, 0] - AHEAD) * (end[:, 0] - AHEAD) < 0.0
    start, end = start[crossing], end[crossing]
    part = (AHEAD - start[:, :1]) / (end[:, :1] - start[:, :1])
    points = np.vstack([points[points[:, 0] >= AHEAD], start + part * (end - start)])
    column, row = project(points, lens)
    sides = (column.min(), row.min(), column.max(), row.max())
    most = (lens.width - 1, lens.height - 1) * 2
    return Box2D(label, *(int(np.clip(np.rint(side), 0, limit)) for side, limit in zip(sides, most, strict=True)))


def space_box(label: int, table: RayTable, shapes: list[int], frame: Array) -> Box3D:
    """Return the oriented 3D box around a whole object; arguments as for `full_box`."""
    if len(shapes) == 1:
        (shape,) = shapes
        corners = triangles_of(table, shape).reshape(-1, 3)
        placed = table.frames[shape]
        axes, origin = (
            matmul(frame[:3, :3].T, placed[:9].reshape(3, 3)),
            matmul(frame[:3, :3].T, placed[9:] - frame[:3, 3]),
        )
    else:
        corners = np.concatenate([_in_camera(table, shape, frame) for shape in shapes]).reshape(-1, 3)
        corners = np.unique(corners, axis=0)
        origin = corners.mean(axis=0)
        spread = corners - origin
        axes = _eigenvectors(matmul(spread.T, spread))
        axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
        corners = matmul(corners - origin, axes)
    low, high = corners.min(axis=0), corners.max(axis=0)
    return Box3D(label, origin + matmul(axes, (low + high) / 2), axes, high - low)


def _eigenvectors(matrix: Array) -> Array:
    """Return the eigenvectors of a symmetric matrix as columns; Eigen's, as LAPACK's depend on the processor."""
    import eigenpy  # type: ignore[import-untyped]

    return np.array(eigenpy.SelfAdjointEigenSolver(matrix).eigenvectors())


def project(points: Array, lens: Lens) -> tuple[Array, Array]:
    """Return column and row [px] of points in front of the camera; points of shape (n, 3)."""
    x, y = -points[:, 1] / points[:, 0], -points[:, 2] / points[:, 0]
    if lens.distortion:
        x, y = lens.distortion.distort(x, y)
    return x * lens.focal_length + (lens.width - 1) / 2, y * lens.focal_length + (lens.height - 1) / 2


def draw(picture: NDArray[np.uint8], box: Box2D | Box3D, lens: Lens, color: tuple[int, int, int]) -> None:
    """Draw a box into a picture; a 3D box only if all of it is in front of the camera, as in gz-rendering."""
    if isinstance(box, Box2D):
        picture[[box.top, box.bottom], box.left : box.right + 1] = color
        picture[box.top : box.bottom + 1, [box.left, box.right]] = color
        return
    corners = box.corners
    if (corners[:, 0] < AHEAD).any():
        return
    part = np.linspace(0.0, 1.0, 2 * (lens.width + lens.height))[:, None]
    lines = np.concatenate([corners[a] + part * (corners[b] - corners[a]) for a, b in EDGES])
    column, row = (np.rint(each) for each in project(lines, lens))
    seen = (column >= 0) & (column < lens.width) & (row >= 0) & (row < lens.height)
    picture[row[seen].astype(np.int64), column[seen].astype(np.int64)] = color


def _in_camera(table: RayTable, shape: int, frame: Array) -> Array:
    """Return the triangles of a shape in the camera's frame [m]; shape (n, 3, 3)."""
    placed = table.frames[shape]
    world = matmul(triangles_of(table, shape), placed[:9].reshape(3, 3).T) + placed[9:]
    found: Array = matmul(world - frame[:3, 3], frame[:3, :3])
    return found
