"""Point cloud messages: PointCloud2 with the field layout of each plugin, and the deprecated PointCloud."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.messages import header, message_type

POINT_CLOUD = "sensor_msgs/msg/PointCloud"
POINT_CLOUD_2 = "sensor_msgs/msg/PointCloud2"

_TYPES = {"f4": 7, "u2": 4, "u4": 6, "u1": 2}
"""numpy type → datatype of PointField."""

Layout = tuple[tuple[tuple[str, str, int], ...], int]
"""(name, numpy type, offset) of each field, and bytes per point."""

XYZ = (("x", "f4", 0), ("y", "f4", 4), ("z", "f4", 8))
GAZEBO_ROS_2: Layout = ((*XYZ, ("intensity", "f4", 12)), 16)
"""Layout in gazebo_ros, conversions/sensor_msgs.hpp."""
VELODYNE_ROS_1: Layout = ((*XYZ, ("intensity", "f4", 16), ("ring", "u2", 20)), 32)
VELODYNE_ROS_2: Layout = ((*XYZ, ("intensity", "f4", 12), ("ring", "u2", 16), ("time", "f4", 18)), 22)
GZ: Layout = ((*XYZ, ("intensity", "f4", 16), ("ring", "u2", 24)), 32)
"""gz-sensors GpuLidarSensor.cc: every field starts at a multiple of eight bytes."""


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
        t: time stamp [s].
        frame: frame id of the header.
        layout: fields with their offsets, and bytes per point.
        columns: field → width · height values; missing fields are zero.
        width: points per row.
        height: number of rows.
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
    """Return a PointCloud with the channel ``intensity``.

    Args:
        t: time stamp [s].
        frame: frame id of the header.
        points: positions [m]; shape (n, 3).
        intensities: values of the channel; shape (n,).
    """
    point = message_type("geometry_msgs/msg/Point32")
    channel = message_type("sensor_msgs/msg/ChannelFloat32")("intensity", intensities.astype(np.float32))
    return message_type(POINT_CLOUD)(header(t, frame), [point(*each) for each in points.tolist()], [channel])
