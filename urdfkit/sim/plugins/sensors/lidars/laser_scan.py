"""Lidars with LaserScan, Range or PointCloud output: gazebo_ros_laser, _block_laser and _range, and a sonar."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.cloud_messages import POINT_CLOUD, old_cloud
from urdfkit.sim.plugins.sensors.hector_drift import drifting
from urdfkit.sim.plugins.sensors.lidars.lidar import LASER_SCAN, RANGE, Lidar, Reading
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics

Messages = tuple[Callable[[Reading], Any], ...]


class Laser(Lidar):
    """gazebo_ros_laser and gazebo_ros_gpu_laser of ROS 1."""

    kind = "laser"
    namespace = "{model}"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic")), LASER_SCAN),)

    def messages(self) -> Messages:
        """Return the function that builds the message of each topic in `topics`."""
        return (self.laser_scan,)


class BlockLaser(Lidar):
    """gazebo_ros_block_laser of ROS 1: one point per ray of all rings; a ray without a hit ends at the maximum range.

    The plugin mirrors points vertically (``z = -r·sin(pitch)``) and measures ranges from the minimum range; urdfkit
    publishes the true positions.
    """

    kind = "block_laser"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self._deviation = read.number("gaussian_noise")
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic")), POINT_CLOUD),)

    def message(self, reading: Reading) -> Any:
        """Return the PointCloud of a reading."""
        farthest = min(self.scan.range_max, float(np.finfo(np.float32).max))
        ranges = np.clip(reading.ranges, self.scan.range_min, farthest).ravel()
        noise = self._deviation * reading.random.standard_normal((len(ranges), 4))
        points = self.points(ranges) + noise[:, :3] * (ranges < farthest)[:, None]
        return old_cloud(reading.t, self.frame, points, reading.intensities.ravel() + noise[:, 3])


class Range(Lidar):
    """gazebo_ros_range of ROS 1: the shortest range of all rays."""

    kind = "range"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self._deviation = read.number("gaussian_noise")
        self._field_of_view = read.number("field_of_view")
        self._ultrasound = self.is_ultrasound(setup, read)
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic")), RANGE),)

    def message(self, reading: Reading) -> Any:
        """Return the Range of a reading."""
        nearest = float(np.clip(reading.ranges, self.scan.range_min, self.scan.range_max).min())
        if nearest < self.scan.range_max:
            nearest += float(reading.random.normal(0.0, self._deviation))
            nearest = min(nearest, self.scan.range_max)
        return self.range_message(
            reading, nearest=nearest, field_of_view=self._field_of_view, ultrasound=self._ultrasound
        )


class Sonar(Lidar):
    """hector_gazebo_ros_sonar of ROS 1: the shortest range of all rays, with a drifting error."""

    kind = "sonar"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self._error = drifting(read, "", 1, rate=self.rate, dt=setup.dt, random=setup.random)
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic")), RANGE),)

    def messages(self) -> Messages:
        """Return the function that builds the message of each topic in `topics`."""
        return (partial(self._range, self.done),)

    def _range(self, turn: int, reading: Reading) -> Any:
        scan = self.scan
        nearest = float(np.clip(reading.ranges, scan.range_min, scan.range_max).min())
        if nearest < scan.range_max:
            nearest += float(self._error.at(turn)[0])
            nearest = min(max(nearest, scan.range_min), scan.range_max)
        across = min(scan.angle_max - scan.angle_min, scan.vertical_max - scan.vertical_min)
        return self.range_message(reading, nearest=nearest, field_of_view=across, ultrasound=True)
