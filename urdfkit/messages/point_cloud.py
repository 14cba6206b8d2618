"""Points of sensor messages: those of a PointCloud2 by field, and those of a LaserScan."""

from typing import Any

NUMBERS = {1: "<i1", 2: "<u1", 3: "<i2", 4: "<u2", 5: "<i4", 6: "<u4", 7: "<f4", 8: "<f8"}
"""Type of a field of a PointCloud2 → numpy type; sensor_msgs/PointField."""


def read_points(cloud: Any) -> Any:
    """Return the points of a ``sensor_msgs/msg/PointCloud2``: a structured array with one row per point.

    The columns are the fields of the message, such as ``x``, ``y``, ``z`` [m] in the frame of the message. A point
    without an obstacle is NaN. Fields of an unknown type and the rest of an incomplete point are left out.

    Raises:
        ValueError: a field is outside of its point.

    Example:
        >>> import numpy as np
        >>> from urdfkit.messages import from_fields, read_points
        >>> data = np.array([0.5, 1.5], dtype="<f4").view(np.uint8)
        >>> field = {"name": "x", "offset": 0, "datatype": 7, "count": 1}
        >>> cloud = {"height": 1, "width": 2, "fields": [field], "point_step": 4, "row_step": 8, "data": data}
        >>> read_points(from_fields("sensor_msgs/msg/PointCloud2", cloud))["x"].tolist()
        [0.5, 1.5]
    """
    import numpy as np

    fields = {field.name: field for field in cloud.fields if field.name and field.datatype in NUMBERS}
    row = np.dtype(
        {
            "names": list(fields),
            "formats": [NUMBERS[field.datatype] for field in fields.values()],
            "offsets": [field.offset for field in fields.values()],
            "itemsize": cloud.point_step,
        }
    )
    data = cloud.data.tobytes()
    return np.frombuffer(data, row, len(data) // row.itemsize if row.itemsize else 0)


def colors_of(packed: Any) -> Any:
    """Return red, green, blue and alpha, 0 to 255, of PCL's packed 32-bit colours; shape (points, 4)."""
    import numpy as np

    return np.ascontiguousarray(packed).view(np.uint8).reshape(-1, 4)[:, [2, 1, 0, 3]]


def scan_points(scan: Any) -> Any:
    """Return the points of a ``sensor_msgs/msg/LaserScan`` in the plane of the sensor [m]; shape (ranges, 3).

    A point without an obstacle is not finite.
    """
    import numpy as np

    ranges = np.asarray(scan.ranges, dtype=float)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    with np.errstate(invalid="ignore"):  # infinity times zero
        return np.stack([ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(len(ranges))], axis=-1)
