"""Drawings of messages: lines, arrows, ellipsoids, maps and points in the frame of the header, as JSON values."""

import base64
import io
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from urdfkit.linear_algebra import Array
from urdfkit.messages.point_cloud import colors_of, read_points, scan_points
from urdfkit.sim.state.quaternion import from_matrix

Item = dict[str, Any]
MOST_POINTS = 40_000
"""Maximum points of a cloud; larger ones are subsampled."""
MOST_CELLS = 4_000_000
"""Maximum cells of the picture of a map; of larger ones, every second or third row and column is shown."""
MOST_POSES = 2000
"""Maximum arrows of a display."""
LENGTH = 0.3
"""Length of the arrow of a pose [m]."""
COLORS = {"free": (238, 240, 243, 255), "unknown": (150, 158, 168, 110), "occupied": (24, 28, 34, 255)}


def drawing(message: Any, kind: str, field: str = "") -> list[Item]:
    """Return the items of a message's drawing.

    Args:
        message: a message of one of `KINDS`.
        kind: its type.
        field: field of a PointCloud2 or LaserScan that colours its points.
    """
    if kind in CLOUDS:
        return CLOUDS[kind](message, field)
    return KINDS[kind](message)


def path(message: Any) -> list[Item]:
    """Return the line through the poses of a Path."""
    return [{"line": [x for each in message.poses for x in xyz_of(each.pose.position)]}]


def pose(message: Any) -> list[Item]:
    """Return the arrow of a PoseStamped."""
    return [_arrow(message.pose)]


def poses(message: Any) -> list[Item]:
    """Return the arrows of a PoseArray."""
    return [_arrow(each) for each in message.poses[:MOST_POSES]]


def pose_with_covariance(message: Any) -> list[Item]:
    """Return arrow and covariance of a PoseWithCovarianceStamped or Odometry."""
    return [_arrow(message.pose.pose), *covariance(message.pose)]


def covariance(value: Any) -> list[Item]:
    """Return the ellipsoid of one standard deviation of the position, and that of the yaw [rad], if there is any."""
    matrix = np.array(value.covariance, dtype=float).reshape(6, 6)
    if not np.isfinite(matrix).all() or not matrix.any():
        return []
    squares, axes = np.linalg.eigh((matrix[:3, :3] + matrix[:3, :3].T) / 2)
    if np.linalg.det(axes) < 0:
        axes[:, 2] *= -1
    place = [*xyz_of(value.pose.position), *from_matrix(axes).tolist()]
    found: list[Item] = [{"ellipsoid": place, "axes": np.sqrt(np.maximum(squares, 0.0)).tolist()}]
    if matrix[5, 5] > 0:
        found.append({"sector": seven(value.pose), "angle": min(math.sqrt(matrix[5, 5]), math.pi), "length": LENGTH})
    return found


def point(message: Any) -> list[Item]:
    """Return the ball of a PointStamped."""
    return [{"shape": "sphere", "pose": [*xyz_of(message.point), 0, 0, 0, 1], "scale": [0.1, 0.1, 0.1]}]


def wrench(message: Any) -> list[Item]:
    """Return the arrows of a WrenchStamped: force [N], and torque [N·m]."""
    force, torque = xyz_of(message.wrench.force), xyz_of(message.wrench.torque)
    return [{"vector": force, "unit": "N"}, {"vector": torque, "unit": "N·m", "about": True}]


def polygon(message: Any) -> list[Item]:
    """Return the closed line of a PolygonStamped."""
    points = [xyz_of(each) for each in message.polygon.points]
    return [{"line": [x for each in (*points, *points[:1]) for x in each]}]


def twist(message: Any) -> list[Item]:
    """Return the arrows of a TwistStamped: linear [m/s] and angular velocity [rad/s]."""
    return _motion(message.twist, "m/s", "rad/s")


def acceleration(message: Any) -> list[Item]:
    """Return the arrows of an AccelStamped: linear [m/s²] and angular acceleration [rad/s²]."""
    return _motion(message.accel, "m/s²", "rad/s²")


def _motion(value: Any, linear: str, angular: str) -> list[Item]:
    about = {"vector": xyz_of(value.angular), "unit": angular, "about": True}
    return [{"vector": xyz_of(value.linear), "unit": linear}, about]


def range_cone(message: Any) -> list[Item]:
    """Return the cone of a Range along x, empty when nothing was measured."""
    if not math.isfinite(message.range):
        return []
    return [{"cone": float(message.range), "angle": float(message.field_of_view)}]


def grid_cells(message: Any) -> list[Item]:
    """Return the rectangles of GridCells."""
    cells = [x for each in message.cells[:MOST_POINTS] for x in xyz_of(each)]
    return [{"cells": cells, "size": [float(message.cell_width), float(message.cell_height)]}]


def occupancy_grid(message: Any) -> list[Item]:
    """Return the picture of an OccupancyGrid: occupied cells dark, unknown ones transparent."""
    from PIL import Image

    info = message.info
    values = np.asarray(message.data, dtype=np.int16).reshape(info.height, info.width)
    if not values.size:
        return []
    every = math.ceil(math.sqrt(values.size / MOST_CELLS))
    values = values[::every, ::every]
    share = np.clip(values, 0, 100)[..., None] / 100.0
    free, occupied = (np.array(COLORS[name], dtype=float) for name in ("free", "occupied"))
    pixels = np.where((values < 0)[..., None], np.array(COLORS["unknown"]), free + (occupied - free) * share)
    file = io.BytesIO()
    Image.fromarray(pixels[::-1].astype(np.uint8), "RGBA").save(file, format="PNG")
    size = [info.width * float(info.resolution), info.height * float(info.resolution)]
    return [{"map": _base64(file.getvalue()), "pose": seven(info.origin), "size": size}]


def scan(message: Any, field: str) -> list[Item]:
    """Return the points of a LaserScan, coloured by ``intensity`` or ``range`` [m]."""
    ranges = np.asarray(message.ranges, dtype=float)
    seen = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= message.range_max)
    xyz = scan_points(message)[seen]
    intensities = np.asarray(message.intensities, dtype=float)
    values = intensities[seen] if field == "intensity" and len(intensities) == len(ranges) else ranges[seen]
    return [_points(xyz, values, ["range", *(["intensity"] if len(intensities) else [])])]


def cloud(message: Any, field: str) -> list[Item]:
    """Return the points of a PointCloud2 with the values of a field, or by default the colours of ``rgb``."""
    if not message.point_step:
        return []
    rows = read_points(message)
    names = list(rows.dtype.names)
    if any(axis not in names for axis in "xyz"):
        return []
    xyz = np.stack([rows[axis].astype(float) for axis in "xyz"], axis=-1)
    finite = np.isfinite(xyz).all(axis=1)
    packed = next((name for name in ("rgb", "rgba") if name in names and rows[name].dtype.itemsize == 4), None)
    if packed is not None and field in ("", packed):
        return [_points(xyz[finite], None, names, colors_of(rows[packed][finite])[:, :3])]
    return [_points(xyz[finite], rows[field][finite].astype(float) if field in names else None, names)]


def _points(xyz: Array, values: Array | None, fields: list[str], colors: Any = None) -> Item:
    every = max(1, -(-len(xyz) // MOST_POINTS))
    item: Item = {"points": _floats(xyz[::every]), "count": len(xyz), "fields": fields}
    if values is not None:
        shown = values[::every]
        finite = shown[np.isfinite(shown)]
        item["values"] = _floats(np.nan_to_num(shown))
        item["range"] = [float(finite.min()), float(finite.max())] if len(finite) else [0.0, 1.0]
    if colors is not None:
        item["colors"] = _base64(np.ascontiguousarray(colors[::every]).tobytes())
    return item


def _arrow(value: Any) -> Item:
    return {"arrow": seven(value), "length": LENGTH}


def xyz_of(value: Any) -> list[float]:
    """Return a vector as three finite numbers."""
    return [finite(value.x), finite(value.y), finite(value.z)]


def seven(value: Any) -> list[float]:
    """Return a pose as x y z [m] and unit quaternion x y z w."""
    return [*xyz_of(value.position), *unit_quaternion(value.orientation)]


def unit_quaternion(q: Any) -> list[float]:
    """Return a quaternion as x y z w of length 1; the identity for one of length 0."""
    turn = [finite(q.x), finite(q.y), finite(q.z), finite(q.w)]
    length = math.sqrt(sum(x * x for x in turn))
    return [x / length for x in turn] if length > 1e-9 else [0.0, 0.0, 0.0, 1.0]


def finite(value: float) -> float:
    """Return the number, 0 if it is not finite."""
    return float(value) if math.isfinite(value) else 0.0


def _floats(values: ArrayLike) -> str:
    return _base64(np.ascontiguousarray(values, dtype="<f4").tobytes())


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode("ascii")


KINDS: dict[str, Callable[[Any], list[Item]]] = {
    "nav_msgs/msg/Path": path,
    "nav_msgs/msg/Odometry": pose_with_covariance,
    "nav_msgs/msg/OccupancyGrid": occupancy_grid,
    "nav_msgs/msg/GridCells": grid_cells,
    "geometry_msgs/msg/PoseStamped": pose,
    "geometry_msgs/msg/PoseArray": poses,
    "geometry_msgs/msg/PoseWithCovarianceStamped": pose_with_covariance,
    "geometry_msgs/msg/PointStamped": point,
    "geometry_msgs/msg/PolygonStamped": polygon,
    "geometry_msgs/msg/TwistStamped": twist,
    "geometry_msgs/msg/AccelStamped": acceleration,
    "geometry_msgs/msg/WrenchStamped": wrench,
    "sensor_msgs/msg/Range": range_cone,
}
"""Type of a message → its drawing."""
CLOUDS: dict[str, Callable[[Any, str], list[Item]]] = {
    "sensor_msgs/msg/LaserScan": scan,
    "sensor_msgs/msg/PointCloud2": cloud,
}
"""Type of a message → its points, coloured by a field."""
OWN_SIZE = (grid_cells, point, range_cone)
"""Drawings whose size is part of the message."""


def options(kind: str) -> list[str]:
    """Return the options that change the drawing of a type, of color, size, field and height; some types have none."""
    if kind in CLOUDS:
        return ["color", "size", "field", *(["height"] if CLOUDS[kind] is cloud else [])]
    if kind not in KINDS or KINDS[kind] is occupancy_grid:
        return []
    return ["color"] if KINDS[kind] in OWN_SIZE else ["color", "size"]
