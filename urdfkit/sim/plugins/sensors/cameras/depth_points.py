"""Organised coloured point clouds from depth images, in the optical frame or in the axes of Gazebo's sensor."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.scene.camera_model import Lens
from urdfkit.sim.plugins.sensors.cloud_messages import XYZ, Layout, cloud

COLORED: Layout = ((*XYZ, ("rgb", "f4", 16)), 32)
"""sensor_msgs/point_cloud2_iterator.h: setPointCloud2FieldsByString of xyz and rgb; also gz sim's layout."""

Depths = NDArray[np.float32]


def within(depth: Depths, low: float, high: float) -> Depths:
    """Return depths with NaN outside the limits `low` and `high` [m]."""
    found: Depths = np.where((depth > low) & (depth < high), depth, np.nan).astype(np.float32)
    return found


def points(t: float, frame: str, lens: Lens, depth: Depths, rgb: NDArray[np.uint8], *, optical: bool = True) -> Any:
    """Return a PointCloud2 with one point per pixel.

    Args:
        t: time stamp [s].
        frame: frame id of the header.
        lens: lens of the camera.
        depth: [m], not finite where the camera has no measurement; shape (height, width).
        rgb: red, green and blue; shape (height, width, 3).
        optical: use optical axes (z forward, x right, y down) instead of x forward, y left, z up.
    """
    directions = np.empty((lens.width * lens.height, 3))
    directions[lens.order] = lens.directions
    with np.errstate(invalid="ignore"):
        found = directions * (depth.reshape(-1, 1) / directions[:, :1])
    x, y, z = (-found[:, 1], -found[:, 2], found[:, 0]) if optical else (found[:, 0], found[:, 1], found[:, 2])
    red, green, blue = (rgb[:, :, channel].reshape(-1).astype(np.uint32) for channel in range(3))
    packed = (red << 16 | green << 8 | blue).view(np.float32)
    columns: dict[str, NDArray[Any]] = {"x": x, "y": y, "z": z, "rgb": packed}
    dense = bool(np.isfinite(depth).all())
    return cloud(t, frame, COLORED, columns, width=lens.width, height=lens.height, dense=dense)
