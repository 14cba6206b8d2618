"""Inertial measurement units: orientation, turning rate, and what an accelerometer feels, gravity included.

The acceleration is that of the step that ended with the measurement, so the simulation stops one step before as well; a
message that nobody waited for has the mean since the simulation last stopped.
"""

from __future__ import annotations

from abc import abstractmethod
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.messages import header, message_type, vector
from urdfkit.sim.parameters import Parameters
from urdfkit.sim.plugin import Sensor, Setup
from urdfkit.sim.schedule import NEVER
from urdfkit.sim.sensors.motion import Moment
from urdfkit.sim.sensors.mounted import slower
from urdfkit.sim.sensors.noise import Noise, noise_of
from urdfkit.sim.sensors.values import number, pose_of
from urdfkit.sim.topics import Topics

if TYPE_CHECKING:
    from urdfkit.description.robot import SensorTag
    from urdfkit.sim.state import State

IMU = "sensor_msgs/msg/Imu"

Array = NDArray[np.float64]


class Imu(Sensor):
    """An inertial measurement unit; where it publishes and how it errs is its subclass's to say."""

    _gyro: tuple[Noise, ...]
    _accelerometer: tuple[Noise, ...]
    _compass: float = 0.0

    def configure(self, setup: Setup) -> None:
        """Read the sensor and the plugin's parameters, and advertise.

        Raises:
            SimulationError: something makes no sense, with its place.
        """
        sensor = setup.sensor
        if sensor is None or setup.surroundings is None or setup.link not in setup.kinematics.link_names:
            raise SimulationError(
                "an IMU stands in a <sensor> of a link, and in none here", position=self.plugin.element.origin.position
            )
        self.name = sensor.name or "sensor"
        read = Parameters(self.plugin, self.spec, {**setup.names, "link": setup.link, "sensor": self.name})
        self.rate = slower(number(sensor.element, "update_rate", 0.0), read.number("update_rate"))
        self._kinematics, self._link = setup.kinematics, setup.link
        self._mount = pose_of(sensor.element)
        self._gravity = np.array(setup.surroundings.world.gravity)
        self._key = int(setup.random.integers(1 << 62))
        self._before: Moment | None = None
        self._reference: Array | None = None
        frame = read.text("frame") or read.text("old_frame") or read.text("body") or read.text("default_frame")
        self.frame = frame.lstrip("/")
        self._relative = self.spec.generation == "gz" or read.flag("initial_orientation")
        self._noises(setup, sensor, read)
        self.topics = (setup.bus.advertise(self._topic(setup, read), IMU),)

    @abstractmethod
    def _topic(self, setup: Setup, read: Parameters) -> str:
        """Return where it publishes."""

    @abstractmethod
    def _noises(self, setup: Setup, sensor: SensorTag, read: Parameters) -> None:
        """Read how it errs into `_gyro` and `_accelerometer` (three each) and `_compass` (one deviation)."""

    def next_stop(self, step: int) -> int:
        """Return the step at which the simulation has to stop for it: where it is due, and one before."""
        due = super().next_stop(step)
        return due if due == NEVER or due - 1 <= step else due - 1

    def catch_up(self, state: State) -> None:
        """Measure what has fallen due, and remember this moment for the next."""
        if self._reference is None and self._relative:
            self._reference = Moment(self._kinematics, state).motion(self._link, self._mount).rotation
        super().catch_up(state)
        self._before = Moment(self._kinematics, state)

    def reset(self) -> None:
        """Start again at step 0."""
        super().reset()
        self._before = None

    def measure(self, state: State, count: int) -> None:
        """Publish."""
        self.topics[0].offer(
            partial(self._message, Moment(self._kinematics, state), self._before, self.done), count=count
        )

    def _message(self, now: Moment, before: Moment | None, turn: int) -> Any:
        import pinocchio as pin

        motion = now.motion(self._link, self._mount)
        acceleration = np.zeros(3)
        if before is not None and before.step < now.step:
            acceleration = (motion.linear - before.motion(self._link, self._mount).linear) / (now.t - before.t)
        random = np.random.Generator(np.random.Philox(key=[self._key, turn]))
        felt = _noisy(motion.rotation.T @ (acceleration - self._gravity), self._accelerometer, random)
        turning = _noisy(motion.rotation.T @ motion.angular, self._gyro, random)
        rotation = motion.rotation if self._reference is None else self._reference.T @ motion.rotation
        quaternion = pin.Quaternion(rotation).coeffs()
        if self._compass:
            quaternion = quaternion + self._compass * random.standard_normal(4)
            quaternion = quaternion / np.linalg.norm(quaternion)
        kind = message_type("geometry_msgs/msg/Quaternion")
        return message_type(IMU)(
            header(now.t, self.frame), kind(*quaternion.tolist()), np.diag([self._compass**2] * 3).ravel(),
            vector(turning.tolist()), np.diag([noise.deviation**2 for noise in self._gyro]).ravel(),
            vector(felt.tolist()), np.diag([noise.deviation**2 for noise in self._accelerometer]).ravel(),
        )  # fmt: skip


class ImuSensor(Imu):
    """gazebo_ros_imu_sensor of ROS 1 and ROS 2."""

    kind = "imu_sensor"

    def _topic(self, setup: Setup, read: Parameters) -> str:
        topics = Topics(self.plugin, self.spec, namespace=setup.model)
        return topics.resolve(read.text("topic") if self.spec.generation == "ros1" else "~/out")

    def _noises(self, setup: Setup, sensor: SensorTag, read: Parameters) -> None:
        if self.spec.generation == "ros1":
            self._compass = read.number("gaussian_noise", unsigned=True)
            self._gyro = self._accelerometer = (Noise(deviation=self._compass),) * 3
        else:
            self._compass = 0.0
            self._gyro, self._accelerometer = _written(sensor, setup.random)


class GzImu(Imu):
    """An IMU of the new Gazebo, which publishes by itself."""

    kind = "gz_imu"

    def _topic(self, setup: Setup, read: Parameters) -> str:
        return Topics(self.plugin, self.spec).resolve(read.text("topic"))

    def _noises(self, setup: Setup, sensor: SensorTag, read: Parameters) -> None:
        self._compass = 0.0
        self._gyro, self._accelerometer = _written(sensor, setup.random)


def _written(sensor: SensorTag, random: np.random.Generator) -> tuple[tuple[Noise, ...], tuple[Noise, ...]]:
    """Return the noises in a sensor's ``<imu>``: of turning rates and of accelerations, along x, y and z."""
    imu = sensor.element.find("imu")
    kinds = [None if imu is None else imu.find(tag) for tag in ("angular_velocity", "linear_acceleration")]
    gyro, accelerometer = (
        tuple(noise_of(None if kind is None else kind.find(axis), random) for axis in "xyz") for kind in kinds
    )
    return gyro, accelerometer


def _noisy(values: Array, noises: tuple[Noise, ...], random: np.random.Generator) -> Array:
    return np.array([noise.on(value, random) for noise, value in zip(noises, values, strict=True)])
