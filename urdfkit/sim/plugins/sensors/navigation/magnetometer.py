"""Magnetometers: the world's magnetic field in the sensor's axes."""

from math import cos, pi, radians, sin
from typing import Any

import numpy as np

from urdfkit.description.xml.element import Element
from urdfkit.linear_algebra import matmul
from urdfkit.messages import header, message_type, vector
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.hector_drift import drifting
from urdfkit.sim.plugins.sensors.motion_sensor import LinkSensor, Sample
from urdfkit.sim.plugins.sensors.navigation.altimeter_and_barometer import OneTopic
from urdfkit.sim.plugins.sensors.navigation.geodesy import Earth, earth_of
from urdfkit.sim.plugins.sensors.noise import noise_of
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Surroundings

MAGNETIC_FIELD = "sensor_msgs/msg/MagneticField"
VECTOR = "geometry_msgs/msg/Vector3Stamped"


class GzMagnetometer(OneTopic):
    """Magnetometer of gz sim: measures the world's ``<magnetic_field>`` [T]."""

    kind = "gz_magnetometer"
    type = MAGNETIC_FIELD

    def _read(self, setup: Setup, element: Element | None, surroundings: Surroundings) -> None:
        self._field = np.array(surroundings.world.magnetic_field)
        inside = None if element is None else element.find("magnetometer")
        axes = [None if inside is None else inside.find(axis) for axis in "xyz"]
        self._noises = [noise_of(axis, setup.random) for axis in axes]

    def _measure(self, sample: Sample) -> Any:
        true = matmul(sample.motion.rotation.T, self._field)
        found = [float(noise.on(value, sample.random)) for noise, value in zip(self._noises, true, strict=True)]
        spread = np.diag([noise.deviation**2 for noise in self._noises]).ravel()
        return message_type(MAGNETIC_FIELD)(header(sample.t, self.frame), vector(found), spread)


class HectorMagnetic(LinkSensor):
    """hector_gazebo_ros_magnetic of ROS 1: field from magnitude, declination and inclination."""

    kind = "hector_magnetic"

    def _prepare(
        self, setup: Setup, element: Element | None, read: Parameters, topics: Topics, surroundings: Surroundings
    ) -> None:
        heading = radians(read.number("heading"))  # heading of the world's x axis, clockwise from north
        if not read.has("heading"):
            heading = pi / 2 - (earth_of(surroundings.world) or Earth()).heading
        declination, inclination = radians(read.number("declination")), radians(read.number("inclination"))
        level = cos(inclination)
        self._field = read.number("magnitude") * np.array(
            [level * cos(heading - declination), level * sin(heading - declination), -sin(inclination)]
        )
        self._error = drifting(read, "", 3, rate=self.rate, dt=setup.dt, random=setup.random)
        self._is_field = read.flag("magnetic_field_messages")
        kind = MAGNETIC_FIELD if self._is_field else VECTOR
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic")), kind),)

    def _measure(self, sample: Sample) -> Any:
        found = vector((matmul(sample.motion.rotation.T, self._field) + self._error.at(sample.turn)).tolist())
        if self._is_field:
            return message_type(MAGNETIC_FIELD)(header(sample.t, self.frame), found, np.zeros(9))
        return message_type(VECTOR)(header(sample.t, self.frame), found)
