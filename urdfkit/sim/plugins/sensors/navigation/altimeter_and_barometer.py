"""Height sensors: altimeter, air pressure sensor, and the barometer of the hector quadrotor."""

from abc import abstractmethod
from collections.abc import Callable
from math import exp, log
from typing import Any

import numpy as np

from urdfkit.description.xml.element import Element
from urdfkit.messages import header, message_type
from urdfkit.messages.sensors import GZ_ALTIMETER, HECTOR_ALTIMETER
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.hector_drift import drifting
from urdfkit.sim.plugins.sensors.motion_sensor import LinkSensor, Sample
from urdfkit.sim.plugins.sensors.noise import Noise, noise_of
from urdfkit.sim.plugins.sensors.point_motion import KinematicSnapshot
from urdfkit.sim.plugins.sensors.sensor_values import number
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Surroundings
from urdfkit.sim.state.robot_state import State

FLUID_PRESSURE = "sensor_msgs/msg/FluidPressure"
POINT = "geometry_msgs/msg/PointStamped"

SEA_LEVEL = 101325.0
"""Sea-level pressure of the standard atmosphere [Pa] (ISO 2533), as in gz-sensors."""
SEA_LEVEL_TEMPERATURE = 288.15
"""Sea-level temperature of the standard atmosphere [K]."""
LAPSE = 0.0065
"""Temperature lapse rate [K/m]."""
EARTH_RADIUS = 6356766.0
"""Earth radius for geopotential heights [m]."""
EXPONENT = 9.80665 * 28.9644 / (8314.32 * LAPSE)


def pressure(height: float) -> float:
    """Return the pressure of the standard atmosphere at a height [m] above sea level [Pa] (AirPressureSensor.cc)."""
    geopotential = EARTH_RADIUS * height / (EARTH_RADIUS + height)
    return SEA_LEVEL * exp(-EXPONENT * log(SEA_LEVEL_TEMPERATURE / (SEA_LEVEL_TEMPERATURE - LAPSE * geopotential)))


class OneTopic(LinkSensor):
    """Sensor of gz sim with one topic, which publishes without a plugin; its reading is the message."""

    type: str

    def _prepare(
        self, setup: Setup, element: Element | None, read: Parameters, topics: Topics, surroundings: Surroundings
    ) -> None:
        self._read(setup, element, surroundings)
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic")), self.type),)

    @abstractmethod
    def _read(self, setup: Setup, element: Element | None, surroundings: Surroundings) -> None:
        """Read the elements of this kind of sensor."""


class GzAirPressure(OneTopic):
    """Air pressure sensor of gz sim."""

    kind = "gz_air_pressure"
    type = FLUID_PRESSURE

    def _read(self, setup: Setup, element: Element | None, surroundings: Surroundings) -> None:
        inside = None if element is None else element.find("air_pressure")
        self._above = number(inside, "reference_altitude", 0.0)
        self._noise = noise_of(None if inside is None else inside.find("pressure"), setup.random)

    def _measure(self, sample: Sample) -> Any:
        found = pressure(self._above + float(sample.motion.position[2]))
        found = float(self._noise.on(np.array(found), sample.random))
        return message_type(FLUID_PRESSURE)(header(sample.t, self.frame), found, self._noise.deviation**2)


class GzAltimeter(OneTopic):
    """Altimeter of gz sim: height above its initial position, and vertical velocity."""

    kind = "gz_altimeter"
    type = GZ_ALTIMETER
    _start: float | None = None

    def _read(self, setup: Setup, element: Element | None, surroundings: Surroundings) -> None:
        inside = None if element is None else element.find("altimeter")

        def noise(tag: str) -> Noise:
            return noise_of(None if inside is None else inside.find(tag), setup.random)

        self._height_noise, self._climb_noise = noise("vertical_position"), noise("vertical_velocity")

    def act(self, state: State) -> None:
        """Publish the messages that are due; the first state is the reference height."""
        if self._start is None:
            self._start = float(KinematicSnapshot(self._kinematics, state).motion(self.link, self._mount).position[2])
        super().act(state)

    def stop(self, step: int) -> int:
        """Return the next step at which the simulation has to stop for the sensor; the first step is one of them."""
        return step if self._start is None else super().stop(step)

    def _measure(self, sample: Sample) -> Any:
        start = self._start or 0.0
        height = float(self._height_noise.on(sample.motion.position[2] - start, sample.random))
        climb = float(self._climb_noise.on(sample.motion.linear[2], sample.random))
        return message_type(GZ_ALTIMETER)(header(sample.t, self.frame), height, climb, start)


class HectorBaro(LinkSensor):
    """hector_gazebo_ros_baro of ROS 1: height in the world, and the corresponding air pressure."""

    kind = "hector_baro"

    def _prepare(
        self, setup: Setup, element: Element | None, read: Parameters, topics: Topics, surroundings: Surroundings
    ) -> None:
        self._error = drifting(read, "", 1, rate=self.rate, dt=setup.dt, random=setup.random)
        self._elevation, self._qnh = read.number("elevation"), read.number("qnh")
        self.topics = (
            setup.bus.advertise(topics.resolve(read.text("topic")), POINT),
            setup.bus.advertise(topics.resolve(read.text("altimeter_topic")), HECTOR_ALTIMETER),
        )

    def _measure(self, sample: Sample) -> tuple[float, float]:
        return sample.t, float(sample.motion.position[2]) + float(self._error.at(sample.turn)[0])

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the function that builds the message of each topic in `topics`."""
        return self._height, self._altimeter

    def _height(self, felt: tuple[float, float]) -> Any:
        t, height = felt
        return message_type(POINT)(header(t, self.frame), message_type("geometry_msgs/msg/Point")(0.0, 0.0, height))

    def _altimeter(self, felt: tuple[float, float]) -> Any:
        t, height = felt
        altitude = height + self._elevation
        # gazebo_ros_baro.cpp; pressures are in hPa.
        there = (1.0 - altitude / 44330.0) ** 5.263157 * self._qnh
        return message_type(HECTOR_ALTIMETER)(header(t, self.frame), altitude, there, self._qnh)
