"""Boxes of a Detection2DArray, which pages draw over an image."""

import math
from typing import Any

from urdfkit.app.simulation.displays.drawings import Item, finite

CAMERA_INFO, IMAGE = "sensor_msgs/msg/CameraInfo", "sensor_msgs/msg/Image"
MOST = 1000
"""Maximum boxes of an image."""


def camera_info_topic(image: str) -> str:
    """Return the topic of the CameraInfo of an image: ``camera_info`` in its namespace, as of image_transport."""
    return f"{image.rpartition('/')[0]}/camera_info"


def boxes(message: Any, size: tuple[int, int] | None) -> list[Item]:
    """Return the boxes with their labels.

    Args:
        message: the Detection2DArray.
        size: width and height of the image [px]; None if unknown.

    Returns:
        An item with ``boxes``: centre x and y, width, height [px], rotation [°] and label of each; and ``size``.
    """
    found = []
    for each in message.detections[:MOST]:
        box, centre = each.bbox, each.bbox.center
        numbers = (centre.position.x, centre.position.y, box.size_x, box.size_y, math.degrees(centre.theta))
        found.append([*map(finite, numbers), _label(each)])
    return [{"boxes": found, "size": size}]


def _label(detection: Any) -> str:
    """Return the most probable class, with its score unless that is 1."""
    best = max((each.hypothesis for each in detection.results), key=lambda each: each.score, default=None)
    if best is None:
        return str(detection.id)[:80]
    score = "" if best.score == 1.0 else f" {finite(best.score):.2f}"
    return f"{str(best.class_id)[:80]}{score}"
