"""Base class of lidars: casts the rays while a topic has subscribers, and builds the common messages.

Sources: gazebo classic, RaySensor.cc, GpuRaySensor.cc and MultiRayShape.cc. Rays start at the minimum range, so nearer
shapes such as the sensor's own housing are not detected. A reading at or beyond the maximum range is +inf, a reading at
the minimum range -inf (REP 117). Noise is added to all other readings, which are then clamped to the limits. Sensors of
type ``ray`` detect collisions, all other types visuals.
"""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np

from urdfkit.description.urdf.robot import SensorTag
from urdfkit.errors import did_you_mean
from urdfkit.linear_algebra import Array
from urdfkit.messages import header, message_type
from urdfkit.scene import Role
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.lidars.scan_pattern import scan_of
from urdfkit.sim.plugins.sensors.noise import noise_of
from urdfkit.sim.plugins.sensors.scene_sensor import SceneSensor
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Layout

LASER_SCAN = "sensor_msgs/msg/LaserScan"
RANGE = "sensor_msgs/msg/Range"

RADIATIONS = ("infrared", "ultrasound")


@dataclass(frozen=True, eq=False)
class Reading:
    """Readings of one measurement of a lidar.

    Attributes:
        t: time stamp [s].
        ranges: [m], ±inf outside the limits; shape (rings, samples), the lowest ring first.
        intensities: the ``laser_retro`` of the shape that each ray hits, zero without a hit; shape (rings, samples).
        random: generator for noise that a plugin adds.
    """

    t: float
    ranges: Array
    intensities: Array
    random: np.random.Generator


class Lidar(SceneSensor):
    """Lidar; its subclass defines the topics."""

    def _prepare(self, setup: Setup, sensor: SensorTag, read: Parameters, topics: Topics) -> None:
        self.scan = scan_of(sensor)
        self._role: Role = "collision" if sensor.type == "ray" else "visual"
        self._directions = self.scan.directions()
        self._noise = noise_of(sensor.element.find("ray") or sensor.element.find("lidar"), setup.random)
        self._advertise(setup, read, topics)

    @abstractmethod
    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        """Read the parameters of this plugin and fill `topics`."""

    def _observe(self, t: float, layout: Layout, frame: Array, random: np.random.Generator) -> Reading:
        table, scan = self._surroundings.view(layout).table(self._role, layout), self.scan
        hits = table.cast((0.0, 0.0, 0.0), self._directions, near=scan.range_min, far=scan.range_max, frame=frame)
        ranges = hits.distances
        low, high = ranges <= scan.range_min, ranges >= scan.range_max
        if self._noise:
            ranges = np.clip(self._noise.on(ranges, random), scan.range_min, scan.range_max)
        ranges = np.where(high, np.inf, np.where(low, -np.inf, ranges))
        retro = np.array([*(shape.laser_retro for shape in table.shapes), 0.0])
        shape = (scan.rings, scan.samples)
        return Reading(t, ranges.reshape(shape), retro[hits.shapes].reshape(shape), random)

    # Messages that several plugins publish.

    def laser_scan(self, reading: Reading, *, min_intensity: float = -np.inf) -> Any:
        """Return a LaserScan of the middle ring."""
        scan, ring = self.scan, self.scan.rings // 2
        return message_type(LASER_SCAN)(
            header(reading.t, self.frame), scan.angle_min, scan.angle_max, scan.increment, 0.0, 0.0, scan.range_min,
            scan.range_max, reading.ranges[ring].astype(np.float32),
            np.maximum(reading.intensities[ring], min_intensity).astype(np.float32),
        )  # fmt: skip

    def range_message(self, reading: Reading, *, nearest: float, field_of_view: float, ultrasound: bool) -> Any:
        """Return a Range."""
        kind = message_type(RANGE)
        return kind(
            header(reading.t, self.frame), kind.ULTRASOUND if ultrasound else kind.INFRARED, field_of_view,
            self.scan.range_min, self.scan.range_max, nearest,
        )  # fmt: skip

    def is_ultrasound(self, setup: Setup, read: Parameters) -> bool:
        """Return whether the radiation type is ultrasound; an unknown type is infrared, as in Gazebo."""
        kind = read.text("radiation", RADIATIONS[0])
        if kind not in RADIATIONS:
            setup.note(
                f"{read.place('radiation')}: <{read.tag('radiation')}> is `{kind}`, which is treated as infrared"
                f"{did_you_mean(kind, RADIATIONS)}"
            )
        return kind == "ultrasound"

    def points(self, ranges: Array) -> Array:
        """Return the points at the measured ranges in the sensor's frame [m]; shape (rings · samples, 3)."""
        with np.errstate(invalid="ignore"):
            found: Array = ranges.reshape(-1, 1) * self._directions
        return found
