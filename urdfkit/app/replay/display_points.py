"""Maps, paths, poses and markers of ROS as coloured points, which the page shows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.app.simulation.features.sensor_views import MOST_POINTS
from urdfkit.scene.pose_matrices import pose_matrices

Array = NDArray[np.float64]
OCCUPIED = 50
"""Least probability of an occupied cell [%], of 100."""
SPACING = 0.02
"""Distance of the points of a line [m]."""
CELL, PATH = (40, 40, 40), (46, 160, 67)
"""Colours of occupied cells and of paths."""
DELETE = (2, 3)
"""Actions of markers that remove markers."""

Points = tuple[Array, Array]
"""Points x y z [m], shape (n, 3), and their colours red, green, blue in 0..255, shape (n, 3)."""


def display_points(message: Any, frame: Array) -> bytes:
    """Return the points of a message in the fixed frame, as the page reads them.

    Args:
        message: OccupancyGrid, Path, PoseArray, Marker or MarkerArray.
        frame: pose of its frame in the fixed frame; shape (4, 4).
    """
    kind = message.__msgtype__.rpartition("/")[2]
    points, colors = MAKERS[kind](message)
    every = max(1, -(-len(points) // MOST_POINTS))
    points, colors = points[::every], colors[::every]
    placed = (points @ frame[:3, :3].T + frame[:3, 3]).astype("<f4")
    opaque = np.concatenate([colors.astype(np.uint8), np.full((len(colors), 1), 255, dtype=np.uint8)], axis=1)
    return bytes(np.concatenate([placed.view(np.uint8).reshape(-1, 12), opaque], axis=1).tobytes())


def _grid(message: Any) -> Points:
    """Return the centres of the occupied cells."""
    info = message.info
    cells = np.asarray(message.data).reshape(info.height, info.width)
    rows, columns = np.nonzero(cells >= OCCUPIED)
    flat = np.zeros(len(rows))
    centres = np.stack([(columns + 0.5) * info.resolution, (rows + 0.5) * info.resolution, flat], axis=-1)
    return _placed(centres, info.origin), _filled(centres, CELL)


def _path(message: Any) -> Points:
    points = _line([_xyz(each.pose.position) for each in message.poses])
    return points, _filled(points, PATH)


def _poses(message: Any) -> Points:
    points = np.array([_xyz(each.position) for each in message.poses]).reshape(-1, 3)
    return points, _filled(points, PATH)


def _marker(message: Any) -> Points:
    """Return the points or lines of a marker, or the centre of its shape."""
    if message.action in DELETE:
        return np.empty((0, 3)), np.empty((0, 3))
    corners = [_xyz(each) for each in message.points]
    if message.type == LINE_STRIP:
        points = _line(corners)
    elif message.type == LINE_LIST:
        pairs = [_line(corners[k : k + 2]) for k in range(0, len(corners) - 1, 2)]
        points = np.concatenate(pairs) if pairs else np.empty((0, 3))
    else:
        points = np.array(corners or [(0.0, 0.0, 0.0)]).reshape(-1, 3)
    color = message.color
    return _placed(points, message.pose), _filled(points, (255 * color.r, 255 * color.g, 255 * color.b))


def _markers(message: Any) -> Points:
    made = [_marker(each) for each in message.markers]
    if not made:
        return np.empty((0, 3)), np.empty((0, 3))
    return np.concatenate([points for points, _ in made]), np.concatenate([colors for _, colors in made])


LINE_STRIP, LINE_LIST = 4, 5
MAKERS: dict[str, Callable[[Any], Points]] = {
    "OccupancyGrid": _grid,
    "Path": _path,
    "PoseArray": _poses,
    "Marker": _marker,
    "MarkerArray": _markers,
}


def _xyz(point: Any) -> tuple[float, float, float]:
    return float(point.x), float(point.y), float(point.z)


def _placed(points: Array, pose: Any) -> Array:
    q = pose.orientation
    turn = (q.x, q.y, q.z, q.w) if any((q.x, q.y, q.z, q.w)) else (0.0, 0.0, 0.0, 1.0)
    matrix = pose_matrices(np.array((*_xyz(pose.position), *turn)))[0]
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])


def _filled(points: Array, color: tuple[float, float, float]) -> Array:
    return np.tile(np.array(color, dtype=float), (len(points), 1))


def _line(corners: list[tuple[float, float, float]]) -> Array:
    """Return points along the line between corners."""
    if len(corners) < 2:
        return np.array(corners, dtype=float).reshape(-1, 3)
    ends = np.array(corners)
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ends, axis=0), axis=1))])
    at = np.linspace(0.0, lengths[-1], min(MOST_POINTS, max(len(ends), int(lengths[-1] / SPACING) + 1)))
    return np.stack([np.interp(at, lengths, ends[:, k]) for k in range(3)], axis=-1)
