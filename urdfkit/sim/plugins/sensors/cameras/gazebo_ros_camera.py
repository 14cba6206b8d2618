"""gazebo_ros_camera: the plugin for single cameras in ROS 1, and for every camera type in ROS 2."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from urdfkit.linear_algebra import Array
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.cameras.camera import SEVERAL, Camera, Capture, sensor_type
from urdfkit.sim.plugins.sensors.cameras.camera_optics import CAMERA_INFO, IMAGE, depth_image
from urdfkit.sim.plugins.sensors.cameras.depth_points import points, within
from urdfkit.sim.plugins.sensors.cameras.multicamera import MultiCamera
from urdfkit.sim.plugins.sensors.cloud_messages import POINT_CLOUD_2
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Layout


class RosCamera(MultiCamera):
    """gazebo_ros_camera of ROS 1 and ROS 2.

    In ROS 2, a sensor of type depth also publishes depth images and points, and a sensor of type multicamera publishes
    all its cameras. In ROS 2, depths below the minimum are -inf and depths above the maximum +inf in images; both are
    NaN in point clouds.
    """

    kind = "camera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self._several = self.spec.generation == "ros2" and (sensor_type(setup) in SEVERAL)
        if self._several:
            super()._advertise(setup, read, topics)
            return
        self.deep = self.spec.generation == "ros2" and sensor_type(setup) == "depth"
        self._min_depth, self._max_depth = read.number("min_depth", 0.4), read.number("max_depth", np.inf)

        def topic(type: str, name: str, meaning: str = "") -> Any:
            return setup.bus.advertise(self.topic_of(read, topics, meaning, name), type)

        images = [topic(IMAGE, "image_raw", "image_topic")]
        plain = [topic(CAMERA_INFO, "camera_info", "info_topic")]
        if self.deep:
            images += [topic(IMAGE, "depth/image_raw"), topic(POINT_CLOUD_2, "points")]
            plain.append(topic(CAMERA_INFO, "depth/camera_info"))
        self.topics = (*images, *plain)

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the functions that build the messages of the first topics in `topics`."""
        if self._several:
            return super().messages()
        return (self.message, self._depth, self._points) if self.deep else (self.message,)

    def other_messages(self) -> tuple[Callable[[float], Any], ...]:
        """Return the functions that build the messages of the other topics."""
        if self._several:
            return super().other_messages()
        return (self.info, self.info) if self.deep else (self.info,)

    def _observe(self, t: float, layout: Layout, frame: Array, random: np.random.Generator) -> Any:
        observe = super()._observe if self._several else partial(Camera._observe, self)
        return observe(t, layout, frame, random)

    def _depth(self, capture: Capture) -> Any:
        depth = capture.picture.depth
        deep = np.where(depth >= self._max_depth, np.inf, np.where(depth <= self._min_depth, -np.inf, depth))
        return depth_image(capture.t, self.frame, deep.astype(np.float32))

    def _points(self, capture: Capture) -> Any:
        deep = within(capture.picture.depth, self._min_depth, self._max_depth)
        return points(capture.t, self.frame, self.optics.lens, deep, capture.picture.rgb)
