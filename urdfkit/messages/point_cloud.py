"""Points of a PointCloud2 by field."""

from typing import Any

NUMBERS = {1: "<i1", 2: "<u1", 3: "<i2", 4: "<u2", 5: "<i4", 6: "<u4", 7: "<f4", 8: "<f8"}
"""Type of a field of a PointCloud2 → numpy type; sensor_msgs/PointField."""


def read_points(cloud: Any) -> Any:
    """Return the points of a ``sensor_msgs/msg/PointCloud2``: a structured array with one row per point.

    The columns are the fields of the message, such as ``x``, ``y``, ``z`` [m] in the frame of the message. A point
    without an obstacle is NaN.

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

    row = np.dtype(
        {
            "names": [field.name for field in cloud.fields],
            "formats": [NUMBERS[field.datatype] for field in cloud.fields],
            "offsets": [field.offset for field in cloud.fields],
            "itemsize": cloud.point_step,
        }
    )
    return np.frombuffer(cloud.data.tobytes(), dtype=row)
