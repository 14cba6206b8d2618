"""Placement of the camera of a picture: a direction, and the distance at which everything is in the image."""

from math import cos, pi, radians, sin, tan

import numpy as np

from urdfkit.errors import UsageError, did_you_mean
from urdfkit.linear_algebra import Array, matmul
from urdfkit.scene.camera_model import Lens

FIELD_OF_VIEW = radians(28.0)
"""Horizontal field of view of a picture of equal width and height [rad]."""

MARGIN = 1.14
"""Size of the image relative to that of the robot in it."""

VIEWS = {
    "corner": (-38.0, 22.0), "front": (0.0, 8.0), "back": (180.0, 8.0), "left": (90.0, 8.0), "right": (-90.0, 8.0),
    "top": (-90.0, 89.9),
}  # fmt: skip
"""Named directions from the robot to the camera: azimuth from the x axis to the left, and elevation [degrees]."""


def camera_direction(text: str) -> tuple[float, float, float]:
    """Return azimuth and elevation [degrees], and a zoom factor.

    Args:
        text: the name of a view, or ``AZIMUTH,ELEVATION`` or ``AZIMUTH,ELEVATION,ZOOM``.

    Raises:
        UsageError: neither of them.
    """
    if text in VIEWS:
        return (*VIEWS[text], 1.0)
    try:
        numbers = [float(word) for word in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in (2, 3) or not np.isfinite(numbers).all() or not -90.0 <= numbers[1] <= 90.0:
        raise UsageError(
            f"--camera: `{text}` is neither AZIMUTH,ELEVATION[,ZOOM] in degrees nor a view{did_you_mean(text, VIEWS)} "
            f"(views: {', '.join(VIEWS)})"
        )
    zoom = numbers[2] if len(numbers) == 3 else 1.0
    if not 0.0 < zoom <= 100.0:
        raise UsageError(f"--camera: zoom {zoom:g} is not between 0 and 100")
    return numbers[0], min(max(numbers[1], -89.9), 89.9), zoom


def lens_of(width: int, height: int) -> Lens:
    """Return the lens of a picture [px]; the field of view is that of its shorter edge."""
    half = tan(FIELD_OF_VIEW / 2) * max(1.0, width / height)
    return Lens(width, height, 2.0 * float(np.arctan(half)))


def placement(points: Array, lens: Lens, azimuth: float, elevation: float, zoom: float = 1.0) -> Array:
    """Return the placement of a camera that sees all points; it looks along x, with z up; shape (4, 4).

    Args:
        points: [m]; shape (n, 3).
        lens: of the camera.
        azimuth: direction from the points to the camera, from x to y [degrees].
        elevation: of the camera above the horizon [degrees].
        zoom: larger than one moves the camera closer.
    """
    turn, rise = azimuth * pi / 180.0, elevation * pi / 180.0
    back = np.array([cos(rise) * cos(turn), cos(rise) * sin(turn), sin(rise)])
    left = np.array([sin(turn), -cos(turn), 0.0])
    frame = np.eye(4)
    frame[:3, :3] = np.column_stack([-back, left, np.cross(-back, left)])
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    depth, *across = matmul(points - middle, frame[:3, :3]).T
    # A point is in the image if |s - c| <= w (D + depth): centre c, half width w at a depth of one, distance D.
    halves = [edge / (2.0 * lens.focal_length * MARGIN) for edge in (lens.width, lens.height)]
    ends = [((s - w * depth).max(), (s + w * depth).min()) for s, w in zip(across, halves, strict=True)]
    distance = max(float(high - low) / (2 * w) for (high, low), w in zip(ends, halves, strict=True))
    distance = max(distance, 1e-3 - float(depth.min()))
    center = matmul(frame[:3, 1:3], np.array([(high + low) / 2 for high, low in ends]))
    frame[:3, 3] = middle + center + back * distance / zoom
    return frame
