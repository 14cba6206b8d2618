"""Sensors with several cameras, such as stereo pairs: gazebo_ros_multicamera of ROS 1, gazebo_ros_camera of ROS 2.

All cameras capture at the same time and share one frame id, as in Gazebo. In a stereo pair, the projection matrix of
the right camera contains its distance to the left camera (``P[3] = -f · hackBaseline``).
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np

from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.cameras.camera import Camera, Capture, Imager
from urdfkit.sim.plugins.sensors.cameras.camera_optics import CAMERA_INFO, IMAGE, image
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Layout

Captures = Callable[[int], Capture]
"""Function that returns the capture of a camera by its index; each camera is rendered on its first call."""


class MultiCamera(Camera):
    """Cameras named left and right, on topics below ``CAMERA/left`` and ``CAMERA/right``; ROS 2 accepts any names."""

    kind = "multicamera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        named = [(side, imager) for imager in self.imagers if (side := self._side(imager))]
        if not named:
            element = self.optics.element
            raise SimulationError(
                "gazebo_ros_multicamera recognizes cameras by `left` and `right` in their names; this sensor has "
                + ", ".join(f"`{imager.name}`" for imager in self.imagers),
                position=element.origin.position,
            )
        ros1 = self.spec.generation == "ros1"
        self.imagers = [replace(imager, baseline=0.0) if ros1 and side == "left" else imager for side, imager in named]
        bus = setup.bus

        def topic(type: str, name: str, meaning: str) -> list[Any]:
            return [bus.advertise(self.topic_of(read, topics, meaning, name, side), type) for side, _ in named]

        images = topic(IMAGE, "image_raw", "image_topic")
        self.topics = (*images, *topic(CAMERA_INFO, "camera_info", "info_topic"))

    def _side(self, imager: Imager) -> str:
        if self.spec.generation != "ros1":
            return imager.name
        return next((side for side in ("left", "right") if side in imager.name), "")

    def _observe(self, t: float, layout: Layout, frame: Array, random: np.random.Generator) -> Captures:
        @cache
        def capture_of(number: int) -> Capture:
            # Each camera has its own random stream: subscribers of other cameras do not change its noise.
            own = np.random.Generator(random.bit_generator.jumped(number))  # type: ignore[attr-defined]
            renderer = self._surroundings.view(layout).renderer(layout)
            return self.imagers[number].capture(t, renderer, frame, own, deep=False)

        return capture_of

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the functions that build the image of each camera."""
        return tuple(partial(self._image_of, number) for number in range(len(self.imagers)))

    def other_messages(self) -> tuple[Callable[[float], Any], ...]:
        """Return the functions that build the CameraInfo of each camera."""
        return tuple(partial(imager.info, self.frame) for imager in self.imagers)

    def _image_of(self, number: int, captures: Captures) -> Any:
        capture = captures(number)
        return image(capture.t, self.frame, capture.picture.rgb, self.imagers[number].optics.encoding)
