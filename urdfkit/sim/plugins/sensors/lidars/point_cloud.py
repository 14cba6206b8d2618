"""Lidars with PointCloud2 output: gazebo_ros_ray_sensor of ROS 2, the Velodyne plugins and gz sim's lidar."""

from collections.abc import Callable
from typing import Any

import numpy as np

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors import cloud_messages
from urdfkit.sim.plugins.sensors.lidars.lidar import LASER_SCAN, RANGE, Lidar, Reading
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics

Messages = tuple[Callable[[Reading], Any], ...]

OUTPUTS = {
    "sensor_msgs/LaserScan": LASER_SCAN,
    "sensor_msgs/PointCloud": cloud_messages.POINT_CLOUD,
    "sensor_msgs/PointCloud2": cloud_messages.POINT_CLOUD_2,
    "sensor_msgs/Range": RANGE,
}


class RaySensor(Lidar):
    """gazebo_ros_ray_sensor of ROS 2, in its four output types; rays without a finite range give no point."""

    kind = "ray_sensor"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self._output = read.text("output_type")
        if self._output not in OUTPUTS:
            raise SimulationError(
                f"<output_type> is `{self._output}`; it must be {', '.join(OUTPUTS)}"
                + did_you_mean(self._output, OUTPUTS),
                position=read.place("output_type"),
            )
        self._min_intensity = read.number("min_intensity")
        self._ultrasound = self.is_ultrasound(setup, read)
        self.topics = (setup.bus.advertise(topics.resolve("~/out"), OUTPUTS[self._output]),)

    def messages(self) -> Messages:
        """Return the function that builds the message of each topic in `topics`."""
        made: dict[str, Callable[[Reading], Any]] = {
            LASER_SCAN: self._scan,
            cloud_messages.POINT_CLOUD: self._points,
            cloud_messages.POINT_CLOUD_2: self._points,
            RANGE: self._range,
        }
        return (made[OUTPUTS[self._output]],)

    def _scan(self, reading: Reading) -> Any:
        return self.laser_scan(reading, min_intensity=self._min_intensity)

    def _points(self, reading: Reading) -> Any:
        seen = np.isfinite(reading.ranges.ravel())
        points = self.points(reading.ranges)[seen]
        intensities = np.maximum(reading.intensities.ravel()[seen], self._min_intensity)
        if OUTPUTS[self._output] == cloud_messages.POINT_CLOUD:
            return cloud_messages.old_cloud(reading.t, self.frame, points, intensities)
        columns = {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2], "intensity": intensities}
        return cloud_messages.cloud(reading.t, self.frame, cloud_messages.GAZEBO_ROS_2, columns, width=len(points))

    def _range(self, reading: Reading) -> Any:
        return self.range_message(
            reading,
            nearest=float(reading.ranges.min()),
            field_of_view=self.scan.field_of_view,
            ultrasound=self._ultrasound,
        )


class Velodyne(Lidar):
    """gazebo_ros_velodyne_laser and _gpu_laser: points ordered by column, the lowest ring first."""

    kind = "velodyne"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self._nearest = max(self.scan.range_min, read.number("min_range"))
        self._farthest = min(self.scan.range_max, read.number("max_range", np.inf))
        self._min_intensity = read.number("min_intensity", -np.inf)
        self._deviation = read.number("gaussian_noise")
        self._organized = read.flag("organize_cloud")
        ros1 = self.spec.generation == "ros1"
        self._layout = cloud_messages.VELODYNE_ROS_1 if ros1 else cloud_messages.VELODYNE_ROS_2
        name = topics.resolve(read.text("topic") if ros1 else "~/out")
        self.topics = (setup.bus.advertise(name, cloud_messages.POINT_CLOUD_2),)

    def message(self, reading: Reading) -> Any:
        """Return the PointCloud2 of a reading."""
        samples, rings = self.scan.samples, self.scan.rings
        ranges, intensities = reading.ranges.T.ravel(), reading.intensities.T.ravel()
        order = np.arange(rings * samples).reshape(rings, samples).T.ravel()
        seen = self._within(ranges) & (intensities >= self._min_intensity)
        if self._deviation:
            ranges = ranges + self._deviation * reading.random.standard_normal(len(ranges))
            seen &= self._within(ranges)
        with np.errstate(invalid="ignore"):
            points = ranges[:, None] * self._directions[order]
        ring = np.tile(np.arange(rings), samples)
        columns = {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2], "intensity": intensities, "ring": ring}
        if not self._organized:
            columns = {name: values[seen] for name, values in columns.items()}
            return cloud_messages.cloud(reading.t, self.frame, self._layout, columns, width=int(seen.sum()))
        for name in ("x", "y", "z", "intensity"):
            columns[name] = np.where(seen, columns[name], np.nan)
        return cloud_messages.cloud(
            reading.t, self.frame, self._layout, columns, width=rings, height=samples, dense=False
        )

    def _within(self, ranges: Any) -> Any:
        return (self._nearest < ranges) & (ranges < self._farthest)


class GzLidar(Lidar):
    """Lidar of gz sim without a plugin: publishes a LaserScan, and a PointCloud2 ordered by ring."""

    kind = "gpu_lidar"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        scan = topics.resolve(read.text("topic"))
        self.topics = (
            setup.bus.advertise(scan, LASER_SCAN),
            setup.bus.advertise(f"{scan}/points", cloud_messages.POINT_CLOUD_2),
        )

    def messages(self) -> Messages:
        """Return the function that builds the message of each topic in `topics`."""
        return self.laser_scan, self._points

    def _points(self, reading: Reading) -> Any:
        points, seen = self.points(reading.ranges), np.isfinite(reading.ranges)
        columns = {
            "x": points[:, 0],
            "y": points[:, 1],
            "z": points[:, 2],
            "intensity": reading.intensities.ravel(),
            "ring": np.repeat(np.arange(self.scan.rings), self.scan.samples),
        }
        return cloud_messages.cloud(
            reading.t, self.frame, cloud_messages.GZ, columns,
            width=self.scan.samples, height=self.scan.rings, dense=bool(seen.all()),
        )  # fmt: skip
