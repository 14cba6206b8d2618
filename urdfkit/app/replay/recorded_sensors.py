"""Scans, point clouds and images of a recording or live robot on the page."""

import io
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from urdfkit.app.replay.observed_robot import ObservedRobot
from urdfkit.app.simulation.features.sensor_views import ENLARGED, LARGE, WIDTH, picture, points
from urdfkit.bus import Bus, Topic
from urdfkit.errors import UrdfkitError
from urdfkit.view.protocol.websocket_messages import COLORED, PICTURE, POINTS
from urdfkit.view.server.server import Server

PERIOD = 0.1
"""Minimum seconds between two views of a topic."""
KINDS = {
    "sensor_msgs/msg/LaserScan": POINTS,
    "sensor_msgs/msg/PointCloud2": COLORED,
    "sensor_msgs/msg/PointCloud": POINTS,
    "sensor_msgs/msg/Image": PICTURE,
    "sensor_msgs/msg/CompressedImage": PICTURE,
}
"""Type of messages → how they are shown."""


@dataclass(slots=True)
class _View:
    topic: Topic
    kind: int
    due: float = 0.0
    shown: int = 0

    @property
    def key(self) -> str:
        return f"sensor:{self.topic.name}"


class RecordedSensors:
    """Views of the topics with sensor data.

    Args:
        bus: the topics.
        robot: source of the poses of frames.
        server: the page.
        clock: wall clock [s].
    """

    def __init__(self, bus: Bus, robot: ObservedRobot, server: Server, clock: Callable[[], float]) -> None:
        self._bus, self._robot, self._server, self._clock = bus, robot, server, clock
        self._views: list[_View] = []

    def find(self) -> None:
        """Follow the topics that were advertised since the last call, and publish the list of the views."""
        found = [topic for topic in self._bus.topics if topic.type in KINDS]
        new = found[len(self._views) :]
        self._views += [_View(topic, KINDS[topic.type]) for topic in new]
        if new:
            self._publish()

    def show(self) -> None:
        """Publish the list of the views."""
        self.find()
        self._publish()

    def _publish(self) -> None:
        names = [
            {"topic": view.topic.name, "picture": view.kind == PICTURE, "camera": view.kind == PICTURE}
            for view in self._views
        ]
        self._server.publish_latched("sensors", sensors=names)

    def tick(self, time: float) -> None:
        """Send the views of new messages that pages show.

        Args:
            time: time of the recording [s].
        """
        for index, view in enumerate(self._views):
            now = self._clock()
            if view.due > now or view.topic.count == view.shown or not self._server.hub.accepts(view.key):
                continue
            view.shown, view.due = view.topic.count, now + PERIOD
            message = view.topic.latest
            if message is None:
                continue
            try:
                content = self._content(view, message, time)
            except (UrdfkitError, LookupError, ValueError, TypeError, AttributeError, OSError) as error:
                text = f"{view.topic.name} cannot be shown: {error}"
                self._server.broadcast("notice", text=text, tone="warning")
                view.due = float("inf")
                continue
            self._server.sense(view.key, index, time, view.kind, content)

    def _content(self, view: _View, message: Any, time: float) -> bytes:
        kind = view.kind
        if kind == PICTURE:
            is_large = f"{ENLARGED}{view.topic.name}" in self._server.hub.subscribed_keys
            width = LARGE if is_large else WIDTH
            return picture(message, width=width) if hasattr(message, "encoding") else _compressed(message, width)
        frame = self._robot.frame_pose(message.header.frame_id, time)
        return points(message, np.eye(4) if frame is None else frame, colored=kind == COLORED)


def _compressed(message: Any, width: int) -> bytes:
    """Return a CompressedImage as a JPEG of at most this width [px]."""
    from PIL import Image

    with Image.open(io.BytesIO(bytes(message.data))) as whole:
        small = whole.convert("RGB")
        small.thumbnail((width, 10 * width))
        file = io.BytesIO()
        small.save(file, format="JPEG", quality=80)
    return file.getvalue()
