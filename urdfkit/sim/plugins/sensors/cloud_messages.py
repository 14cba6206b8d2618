"""Messages that hold points: PointCloud2 with the fields each plugin writes, and the old PointCloud."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.messages import header, message_type

POINT_CLOUD = "sensor_msgs/msg/PointCloud"
POINT_CLOUD_2 = "sensor_msgs/msg/PointCloud2"

_TYPES = {"f4": 7, "u2": 4, "u4": 6, "u1": 2}
"""PointField's numbers of types."""

Layout = tuple[tuple[tuple[str, str, int], ...], int]
"""(name, numpy type, offset) of each field, and bytes per point."""

XYZ = (("x", "f4", 0), ("y", "f4", 4), ("z", "f4", 8))
GAZEBO_ROS_2: Layout = ((*XYZ, ("intensity", "f4", 12)), 16)
"""gazebo_ros conversions/sensor_msgs.hpp."""
VELODYNE_ROS_1: Layout = ((*XYZ, ("intensity", "f4", 16), ("ring", "u2", 20)), 32)
VELODYNE_ROS_2: Layout = ((*XYZ, ("intensity", "f4", 12), ("ring", "u2", 16), ("time", "f4", 18)), 22)
GZ: Layout = ((*XYZ, ("intensity", "f4", 16), ("ring", "u2", 24)), 32)
"""gz-sensors GpuLidarSensor.cc: every field begins at a multiple of eight bytes."""


def cloud(
    t: float,
    frame: str,
    layout: Layout,
    columns: Mapping[str, NDArray[Any]],
    *,
    width: int,
    height: int = 1,
    dense: bool = True,
) -> Any:
    """Return a PointCloud2.

    Args:
        t: when [s].
        frame: whose coordinates.
        layout: fields and their places.
        columns: field → values, width · height of them; what is missing is zero.
        width: points in a row.
        height: rows.
        dense: whether all points are finite.
    """
    fields, step = layout
    kind = np.dtype(
        {
            "names": [name for name, _, _ in fields],
            "formats": [f"<{type}" for _, type, _ in fields],
            "offsets": [offset for _, _, offset in fields],
            "itemsize": step,
        }
    )
    rows = np.zeros(width * height, dtype=kind)
    for name, values in columns.items():
        rows[name] = values
    point_field = message_type("sensor_msgs/msg/PointField")
    described = [point_field(name, offset, _TYPES[type], 1) for name, type, offset in fields]
    content = np.frombuffer(rows.tobytes(), dtype=np.uint8)
    return message_type(POINT_CLOUD_2)(
        header(t, frame), height, width, described, False, step, step * width, content, dense
    )


def old_cloud(t: float, frame: str, points: NDArray[Any], intensities: NDArray[Any]) -> Any:
    """Return a PointCloud with one channel.

    Args:
        t: when [s].
        frame: whose coordinates.
        points: [m]; shape (n, 3).
        intensities: shape (n,).
    """
    point = message_type("geometry_msgs/msg/Point32")
    channel = message_type("sensor_msgs/msg/ChannelFloat32")("intensity", intensities.astype(np.float32))
    return message_type(POINT_CLOUD)(header(t, frame), [point(*each) for each in points.tolist()], [channel])
