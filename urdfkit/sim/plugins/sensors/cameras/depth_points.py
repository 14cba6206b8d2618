"""From depths to points: organised clouds with colour, in a camera's optical frame or in Gazebo's."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.scene.camera_model import Lens
from urdfkit.sim.plugins.sensors.cloud_messages import XYZ, Layout, cloud

COLORED: Layout = ((*XYZ, ("rgb", "f4", 16)), 32)
"""sensor_msgs/point_cloud2_iterator.h: setPointCloud2FieldsByString of xyz and rgb; the new Gazebo's is the same."""

Depths = NDArray[np.float32]


def within(depth: Depths, low: float, high: float) -> Depths:
    """Return depths, NaN where they are not between two bounds [m]."""
    found: Depths = np.where((depth > low) & (depth < high), depth, np.nan).astype(np.float32)
    return found


def points(t: float, frame: str, lens: Lens, depth: Depths, rgb: NDArray[np.uint8], *, optical: bool = True) -> Any:
    """Return a PointCloud2, a point per pixel.

    Args:
        t: when [s].
        frame: whose coordinates.
        lens: what it was seen with.
        depth: [m], not finite where there is none; shape (height, width).
        rgb: red, green and blue; shape (height, width, 3).
        optical: whether z is forward, x right and y down; else x is forward, y left and z up.
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
