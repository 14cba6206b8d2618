"""Depth cameras: gazebo_ros_openni_kinect and _depth_camera of ROS 1, depth and RGB-D cameras of gz sim."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.cameras.camera import Camera, Capture
from urdfkit.sim.plugins.sensors.cameras.camera_optics import CAMERA_INFO, IMAGE, depth_image
from urdfkit.sim.plugins.sensors.cameras.depth_points import points, within
from urdfkit.sim.plugins.sensors.cloud_messages import POINT_CLOUD_2
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics


class DepthCamera(Camera):
    """gazebo_ros_depth_camera of ROS 1: depths below the minimum are NaN."""

    kind = "depth_camera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self._min_depth, self._max_depth = read.number("min_depth"), read.number("max_depth", np.inf)
        self._millimetres = read.flag("millimetres")

        def topic(meaning: str, type: str) -> Any:
            return setup.bus.advertise(self.topic_of(read, topics, meaning, ""), type)

        self.topics = (
            topic("image_topic", IMAGE),
            topic("depth_topic", IMAGE),
            topic("cloud_topic", POINT_CLOUD_2),
            topic("info_topic", CAMERA_INFO),
            topic("depth_info_topic", CAMERA_INFO),
        )

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the functions that build the messages of the first topics in `topics`."""
        return self.message, self._depth, self._points

    def other_messages(self) -> tuple[Callable[[float], Any], ...]:
        """Return the functions that build the messages of the other topics."""
        return self.info, self.info

    def _deep(self, capture: Capture) -> NDArray[np.float32]:
        return within(capture.picture.depth, self._min_depth, self._max_depth)

    def _depth(self, capture: Capture) -> Any:
        return depth_image(capture.t, self.frame, self._deep(capture), millimetres=self._millimetres)

    def _points(self, capture: Capture) -> Any:
        return points(capture.t, self.frame, self.optics.lens, self._deep(capture), capture.picture.rgb)


class OpenniKinect(DepthCamera):
    """gazebo_ros_openni_kinect of ROS 1: depths outside the limits are NaN."""

    kind = "openni_kinect"


class GzDepthCamera(Camera):
    """Depth camera of gz sim: depths beyond the limit are +inf; its points are in the sensor's axes."""

    kind = "gz_depth_camera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        name, bus = topics.resolve(read.text("image_topic")), setup.bus
        self.topics = (
            bus.advertise(name, IMAGE),
            bus.advertise(f"{name}/points", POINT_CLOUD_2),
            bus.advertise(f"{name.rpartition('/')[0]}/camera_info", CAMERA_INFO),
        )

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the functions that build the messages of the first topics in `topics`."""
        return self._depth, self._points

    def _depth(self, capture: Capture) -> Any:
        return depth_image(capture.t, self.frame, capture.picture.depth)

    def _points(self, capture: Capture) -> Any:
        picture = capture.picture
        return points(capture.t, self.sensor_frame, self.optics.lens, picture.depth, picture.rgb, optical=False)


class GzRgbdCamera(GzDepthCamera):
    """RGB-D camera of gz sim: depth camera with colour images; all topics are below its own."""

    kind = "gz_rgbd_camera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        name, bus = topics.resolve(read.text("image_topic")), setup.bus
        self.topics = (
            bus.advertise(f"{name}/image", IMAGE),
            bus.advertise(f"{name}/depth_image", IMAGE),
            bus.advertise(f"{name}/points", POINT_CLOUD_2),
            bus.advertise(f"{name}/camera_info", CAMERA_INFO),
        )

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the functions that build the messages of the first topics in `topics`."""
        return self.message, self._depth, self._points
