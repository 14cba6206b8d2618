"""GPS: gazebo_ros_gps_sensor of ROS 2, gz sim's navsat and hector_gazebo_ros_gps, on WGS 84.

Noise is in metres along east, north and up; gz sim's source adds the same numbers to degrees.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import cos, degrees, pi, radians
from typing import Any

import numpy as np

from urdfkit.description.xml.element import Element
from urdfkit.linear_algebra import Array
from urdfkit.messages import header, message_type, vector
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.hector_drift import drifting
from urdfkit.sim.plugins.sensors.motion_sensor import LinkSensor, Sample
from urdfkit.sim.plugins.sensors.navigation.geodesy import A, Earth, earth_of
from urdfkit.sim.plugins.sensors.noise import noise_of
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Surroundings

FIX = "sensor_msgs/msg/NavSatFix"
VELOCITY = "geometry_msgs/msg/Vector3Stamped"

DIAGONAL_KNOWN = 2
"""NavSatFix's COVARIANCE_TYPE_DIAGONAL_KNOWN."""


@dataclass(frozen=True, eq=False)
class Fix:
    """One reading of a GPS.

    Attributes:
        t: time stamp [s].
        place: latitude [°], longitude [°] and altitude [m].
        velocity: north, west and up components [m/s]; shape (3,).
    """

    t: float
    place: tuple[float, float, float]
    velocity: Array


class Gps(LinkSensor):
    """gazebo_ros_gps_sensor of ROS 2."""

    kind = "gps"
    _status = 0, 1
    """Status and service of NavSatStatus: STATUS_FIX, SERVICE_GPS."""
    _variances: Array

    def _prepare(
        self, setup: Setup, element: Element | None, read: Parameters, topics: Topics, surroundings: Surroundings
    ) -> None:
        self._earth = earth_of(surroundings.world) or self._nowhere(setup, element)
        self._errors(setup, element, read)
        name = read.text("topic") or "~/out"
        self.topics = (setup.bus.advertise(topics.resolve(name), FIX),)

    def _nowhere(self, setup: Setup, element: Element | None) -> Earth:
        place = (element or self.plugin.element).origin.position
        setup.note(
            f"{place}: world `{setup.world}` has no <spherical_coordinates>; "
            f"GPS `{self.name}` uses latitude and longitude zero for its origin"
        )
        return Earth()

    def _errors(self, setup: Setup, element: Element | None, read: Parameters) -> None:
        gps = None if element is None else element.find("gps") or element.find("navsat")
        sensing = None if gps is None else gps.find("position_sensing")
        level, upright = (None if sensing is None else sensing.find(tag) for tag in ("horizontal", "vertical"))
        self._noises = noise_of(level, setup.random), noise_of(level, setup.random), noise_of(upright, setup.random)
        self._variances = np.array([noise.deviation**2 for noise in self._noises])

    def _measure(self, sample: Sample) -> Fix:
        east, north, up = (float(noise.on(np.zeros(()), sample.random)) for noise in self._noises)
        return self._fix(sample, (east, north, up), np.zeros(3))

    def _fix(self, sample: Sample, off: tuple[float, float, float], drift: Array) -> Fix:
        """Return the reading with the position error `off`, east, north and up [m], and the velocity error `drift`."""
        latitude, longitude, altitude = self._earth.locate(sample.motion.position)
        longitude += degrees(off[0] / (A * max(cos(radians(latitude)), 1e-9)))
        latitude += degrees(off[1] / A)
        east, north, up = self._earth.compass(sample.motion.linear)
        return Fix(sample.t, (latitude, longitude, altitude + off[2]), np.array([north, -east, up]) + drift)

    def message(self, fix: Fix) -> Any:
        """Return the NavSatFix of a reading."""
        return message_type(FIX)(
            header(fix.t, self.frame), message_type("sensor_msgs/msg/NavSatStatus")(*self._status), *fix.place,
            np.diag(self._variances).ravel(), DIAGONAL_KNOWN,
        )  # fmt: skip


class GzNavSat(Gps):
    """Sensor of type navsat of gz sim, which publishes without a plugin."""

    kind = "gz_navsat"


class HectorGps(Gps):
    """hector_gazebo_ros_gps of ROS 1: fix and velocity (north, west, up), both with drifting errors."""

    kind = "hector_gps"

    def _prepare(
        self, setup: Setup, element: Element | None, read: Parameters, topics: Topics, surroundings: Surroundings
    ) -> None:
        super()._prepare(setup, element, read, topics, surroundings)
        earth = self._earth
        heading = pi / 2 - radians(read.number("heading")) if read.has("heading") else earth.heading
        self._earth = Earth(
            radians(read.number("latitude", degrees(earth.latitude))),
            radians(read.number("longitude", degrees(earth.longitude))),
            read.number("altitude", earth.elevation),
            heading,
        )
        self._status = int(read.number("status")), int(read.number("service", 1.0))
        velocity = setup.bus.advertise(topics.resolve(read.text("velocity_topic")), VELOCITY)
        self.topics = (*self.topics, velocity)

    def _nowhere(self, setup: Setup, element: Element | None) -> Earth:
        if self.plugin.element.find("referenceLatitude") is not None:
            return Earth()
        return super()._nowhere(setup, element)

    def _errors(self, setup: Setup, element: Element | None, read: Parameters) -> None:
        errors = partial(drifting, read, rate=self.rate, dt=setup.dt, random=setup.random)
        self._position = errors("", 3)
        self._speed = errors("velocity_", 3)
        self._variances = self._position.variance

    def _measure(self, sample: Sample) -> Fix:
        east, north, up = self._earth.compass(self._position.at(sample.turn))
        return self._fix(sample, (east, north, up), self._speed.at(sample.turn))

    def messages(self) -> tuple[Callable[[Fix], Any], ...]:
        """Return the function that builds the message of each topic in `topics`."""
        return self.message, self._velocity

    def _velocity(self, fix: Fix) -> Any:
        return message_type(VELOCITY)(header(fix.t, self.frame), vector(fix.velocity.tolist()))
