"""GPS: gazebo_ros_gps_sensor of ROS 2 and the new Gazebo's navsat, a NavSatFix on WGS 84.

Noise is in metres along east, north and up; the new Gazebo's source adds it to degrees.
"""

from __future__ import annotations

from functools import partial
from math import cos, degrees, radians
from typing import TYPE_CHECKING, Any

import numpy as np

from urdfkit.errors import SimulationError
from urdfkit.messages import header, message_type
from urdfkit.sim.parameters import Parameters
from urdfkit.sim.plugin import Sensor, Setup
from urdfkit.sim.sensors.earth import A, Earth, earth_of
from urdfkit.sim.sensors.motion import Moment
from urdfkit.sim.sensors.noise import noise_of
from urdfkit.sim.sensors.values import number, pose_of
from urdfkit.sim.topics import Topics

if TYPE_CHECKING:
    from urdfkit.sim.state import State

FIX = "sensor_msgs/msg/NavSatFix"

DIAGONAL_KNOWN = 2
"""NavSatFix's COVARIANCE_TYPE_DIAGONAL_KNOWN."""


class Gps(Sensor):
    """gazebo_ros_gps_sensor of ROS 2."""

    kind = "gps"

    def configure(self, setup: Setup) -> None:
        """Read the sensor and where the world lies, and advertise.

        Raises:
            SimulationError: something makes no sense, with its place.
        """
        sensor = setup.sensor
        if sensor is None or setup.surroundings is None or setup.link not in setup.kinematics.link_names:
            raise SimulationError(
                "a GPS stands in a <sensor> of a link, and in none here", position=self.plugin.element.origin.position
            )
        self.name = sensor.name or "sensor"
        read = Parameters(self.plugin, self.spec, {**setup.names, "link": setup.link, "sensor": self.name})
        self.rate = number(sensor.element, "update_rate", 0.0)
        frame = read.text("frame") or read.text("old_frame") or read.text("default_frame")
        self.frame = frame.lstrip("/")
        self._kinematics, self._link, self._mount = setup.kinematics, setup.link, pose_of(sensor.element)
        earth = earth_of(setup.surroundings.world)
        if earth is None:
            setup.note(
                f"{sensor.element.origin.position}: world `{setup.world}` has no <spherical_coordinates>; "
                f"GPS `{self.name}` takes its origin for latitude and longitude zero"
            )
        self._earth = earth or Earth()
        gps = sensor.element.find("gps") or sensor.element.find("navsat")
        sensing = None if gps is None else gps.find("position_sensing")
        level, upright = (None if sensing is None else sensing.find(tag) for tag in ("horizontal", "vertical"))
        self._noises = noise_of(level, setup.random), noise_of(level, setup.random), noise_of(upright, setup.random)
        self._key = int(setup.random.integers(1 << 62))
        name = read.text("topic") if self.spec.generation == "gz" else "~/out"
        self.topics = (setup.bus.advertise(Topics(self.plugin, self.spec).resolve(name), FIX),)

    def measure(self, state: State, count: int) -> None:
        """Publish."""
        self.topics[0].offer(partial(self._message, Moment(self._kinematics, state), self.done), count=count)

    def _message(self, now: Moment, turn: int) -> Any:
        random = np.random.Generator(np.random.Philox(key=[self._key, turn]))
        latitude, longitude, altitude = self._earth.locate(now.motion(self._link, self._mount).position)
        east, north, up = (float(noise.on(np.zeros(()), random)) for noise in self._noises)
        longitude += degrees(east / (A * max(cos(radians(latitude)), 1e-9)))
        latitude += degrees(north / A)
        variances = [noise.deviation**2 for noise in self._noises]
        return message_type(FIX)(
            header(now.t, self.frame), message_type("sensor_msgs/msg/NavSatStatus")(0, 1), latitude, longitude,
            altitude + up, np.diag(variances).ravel(), DIAGONAL_KNOWN,
        )  # fmt: skip


class GzNavSat(Gps):
    """A navsat sensor of the new Gazebo, which publishes by itself."""

    kind = "gz_navsat"
