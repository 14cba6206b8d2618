"""What all lidars do: cast their rays when somebody listens, and tell what they met.

Sources: gazebo classic, RaySensor.cc, GpuRaySensor.cc and MultiRayShape.cc. Rays begin at the least range, so what is
nearer is not seen, the sensor's own housing for one. A reading at or beyond the greatest range is +inf, one at the
least range -inf (REP 117); noise goes on the others, which then stay between the two. ``ray`` meets collisions, the
others visuals.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.messages import header, message_type
from urdfkit.scene.placement import pose_matrices
from urdfkit.sim.parameters import Parameters
from urdfkit.sim.plugin import Sensor, Setup
from urdfkit.sim.sensors.noise import noise_of
from urdfkit.sim.sensors.scan import scan_of
from urdfkit.sim.sensors.values import number, pose_of
from urdfkit.sim.topics import Topics

if TYPE_CHECKING:
    from urdfkit.sim.state import State

Array = NDArray[np.float64]

LASER_SCAN = "sensor_msgs/msg/LaserScan"
RANGE = "sensor_msgs/msg/Range"


@dataclass(frozen=True, eq=False)
class Reading:
    """One look of a lidar.

    Attributes:
        t: when [s].
        ranges: [m], ±inf outside the limits; shape (rings, samples), the lowest ring first.
        intensities: the ``laser_retro`` of what was met, zero where nothing was; shape (rings, samples).
        random: for noise that a plugin adds itself.
    """

    t: float
    ranges: Array
    intensities: Array
    random: np.random.Generator


class Lidar(Sensor):
    """A lidar; what it publishes is its subclass's to say."""

    namespace = ""
    """Where ROS 1 puts the plugin whose ``<robotNamespace>`` is empty; ``{model}`` is the robot's name."""

    def configure(self, setup: Setup) -> None:
        """Read the scan, the rate and the plugin's parameters, and advertise.

        Raises:
            SimulationError: something makes no sense, with its place.
        """
        sensor = setup.sensor
        if sensor is None or setup.surroundings is None:
            raise SimulationError("a lidar stands in a <sensor>", position=self.plugin.element.origin.position)
        self.name = sensor.name or "sensor"
        self._surroundings = setup.surroundings
        names = {**setup.names, "link": setup.link, "sensor": self.name}
        read = Parameters(self.plugin, self.spec, names)
        empty = self.plugin.element.find("robotNamespace") is not None
        topics = Topics(self.plugin, self.spec, namespace=self.namespace.format(**names) if empty else "")
        self.scan = scan_of(sensor)
        self.rate = _slower(number(sensor.element, "update_rate", 0.0), read.number("update_rate"))
        self.frame = (read.text("frame") or read.text("old_frame") or read.text("default_frame")).lstrip("/")
        self._role: Any = "collision" if sensor.type == "ray" else "visual"
        self._directions = self.scan.directions()
        self._pose = pose_of(sensor.element)
        self._link = setup.kinematics.link_names.index(setup.link)
        self._noise = noise_of(sensor.element.find("ray") or sensor.element.find("lidar"), setup.random)
        self._key = int(setup.random.integers(1 << 62))
        self._advertise(setup, read, topics)

    @abstractmethod
    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        """Read what is the plugin's own and fill `topics`."""

    @abstractmethod
    def messages(self) -> tuple[Callable[[Reading], Any], ...]:
        """Return what makes the message of each of `topics`."""

    def measure(self, state: State, count: int) -> None:
        """Publish what is seen from here; nothing is computed before somebody looks."""
        t, poses = state.t, self._surroundings.poses(state.link_poses())
        look = self._look(t, poses, self.done)
        for topic, message in zip(self.topics, self.messages(), strict=True):
            topic.offer(lambda make=message: make(look()), count=count)  # type: ignore[misc]

    def _look(self, t: float, poses: Array, turn: int) -> Callable[[], Reading]:
        """Return what takes the reading, once for all topics. Noise depends on the reading's number alone."""

        @cache
        def look() -> Reading:
            table = self._surroundings.table(self._role)
            table.place(poses)
            scan = self.scan
            frame = pose_matrices(poses[self._link])[0] @ self._pose
            hits = table.cast((0.0, 0.0, 0.0), self._directions, near=scan.range_min, far=scan.range_max, frame=frame)
            ranges = hits.distances
            random = np.random.Generator(np.random.Philox(key=[self._key, turn]))
            low, high = ranges <= scan.range_min, ranges >= scan.range_max
            if self._noise:
                ranges = np.clip(self._noise.on(ranges, random), scan.range_min, scan.range_max)
            ranges = np.where(high, np.inf, np.where(low, -np.inf, ranges))
            retro = np.array([*(shape.laser_retro for shape in table.shapes), 0.0])
            shape = (scan.rings, scan.samples)
            return Reading(t, ranges.reshape(shape), retro[hits.shapes].reshape(shape), random)

        return look

    # What several plugins publish.

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

    def points(self, ranges: Array) -> Array:
        """Return where the readings are in the sensor's frame [m]; shape (rings · samples, 3)."""
        with np.errstate(invalid="ignore"):
            found: Array = ranges.reshape(-1, 1) * self._directions
        return found


def _slower(one: float, other: float) -> float:
    """Return the smaller of two rates that are set; zero where none is."""
    return min((rate for rate in (one, other) if rate > 0), default=0.0)
