"""Inertial measurement units: orientation, angular velocity and linear acceleration, gravity included.

The acceleration is the mean over the step that ends with the measurement, so the simulation also stops one step
earlier. Without subscribers it does not stop, and the mean covers the time since its last stop.
"""

from abc import abstractmethod
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array, matmul, vector_norm
from urdfkit.messages import header, message_type, vector
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.hector_drift import drifting
from urdfkit.sim.plugins.sensors.motion_sensor import LinkSensor, Sample
from urdfkit.sim.plugins.sensors.noise import Noise, noise_of
from urdfkit.sim.plugins.sensors.point_motion import KinematicSnapshot
from urdfkit.sim.plugins.sensors.sensor_values import rotation_matrix
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Surroundings
from urdfkit.sim.state.quaternion import from_matrix
from urdfkit.sim.state.robot_state import State

IMU = "sensor_msgs/msg/Imu"

G = 9.8065
"""Gravity with which hector converts ``rpyOffset`` to an offset of the acceleration [m/s²]."""


@dataclass(frozen=True, eq=False)
class Felt:
    """One reading of an IMU.

    Attributes:
        t: time stamp [s].
        rotation: orientation of the sensor; shape (3, 3).
        shaken: noise, added to the quaternion x y z w before it is normalised; shape (4,).
        turning: angular velocity in the sensor's axes [rad/s]; shape (3,).
        pulled: linear acceleration in the sensor's axes [m/s²]; shape (3,).
    """

    t: float
    rotation: Array
    shaken: Array
    turning: Array
    pulled: Array


class Imu(LinkSensor):
    """Inertial measurement unit; its subclass defines the topic and the errors."""

    lead = 1
    _relative = False
    _variances: tuple[Array, Array, Array]
    """Diagonals of the covariances of orientation, angular velocity and linear acceleration."""

    def _prepare(
        self, setup: Setup, element: Element | None, read: Parameters, topics: Topics, surroundings: Surroundings
    ) -> None:
        self._gravity = np.array(surroundings.world.gravity)
        self._reference: Array | None = None
        self._offset = rotation_matrix(*read.vector("rpy_offset", 3))
        self._errors(setup, element, read)
        self.topics = (setup.bus.advertise(topics.resolve(self._topic(read)), IMU),)

    def _topic(self, read: Parameters) -> str:
        return read.text("topic") or "~/out"

    @abstractmethod
    def _errors(self, setup: Setup, element: Element | None, read: Parameters) -> None:
        """Read the error model, and fill `_variances`."""

    @abstractmethod
    def _err(self, felt: Felt, sample: Sample) -> Felt:
        """Return a reading with errors added."""

    def act(self, state: State) -> None:
        """Publish the messages that are due; the first orientation is the reference if `_relative` is set."""
        if self._reference is None and self._relative:
            self._reference = KinematicSnapshot(self._kinematics, state).motion(self.link, self._mount).rotation
        super().act(state)

    def _measure(self, sample: Sample) -> Felt:
        R = sample.motion.rotation
        rotation = matmul(self._offset, R if self._reference is None else matmul(self._reference.T, R))
        true = Felt(
            sample.t,
            rotation,
            np.zeros(4),
            matmul(R.T, sample.motion.angular),
            matmul(R.T, sample.acceleration - self._gravity),
        )
        return self._err(true, sample)

    def message(self, felt: Felt) -> Any:
        """Return the Imu message of a reading."""
        quaternion = from_matrix(felt.rotation) + felt.shaken
        quaternion = quaternion / vector_norm(quaternion)
        kind = message_type("geometry_msgs/msg/Quaternion")
        orientation, turning, pulled = (np.diag(each).ravel() for each in self._variances)
        return message_type(IMU)(
            header(felt.t, self.frame), kind(*quaternion.tolist()), orientation,
            vector(felt.turning.tolist()), turning, vector(felt.pulled.tolist()), pulled,
        )  # fmt: skip


class PlainImu(Imu):
    """IMU with the noise of SDF, with one standard deviation for all quantities, or with both."""

    _gyro: tuple[Noise, ...]
    _accelerometer: tuple[Noise, ...]
    _compass: float = 0.0
    _plugin = Noise()

    def _set_variances(self) -> None:
        gyro, accelerometer = (
            np.array([noise.deviation**2 for noise in noises]) for noises in (self._gyro, self._accelerometer)
        )
        self._variances = np.full(3, self._compass**2), gyro, accelerometer

    def _err(self, felt: Felt, sample: Sample) -> Felt:
        pulled = self._plugin.on(_noisy(felt.pulled, self._accelerometer, sample.random), sample.random)
        turning = self._plugin.on(_noisy(felt.turning, self._gyro, sample.random), sample.random)
        shaken = self._compass * sample.random.standard_normal(4) if self._compass else felt.shaken
        return Felt(felt.t, felt.rotation, shaken, turning, pulled)


class ImuSensor(PlainImu):
    """gazebo_ros_imu_sensor of ROS 1 and ROS 2.

    The ROS 1 plugin adds its own noise to the readings of Gazebo's sensor, which already contain SDF's noise; its
    covariances contain only its own noise (gazebo_ros_imu_sensor.cpp, UpdateChild).
    """

    kind = "imu_sensor"

    def _namespace(self, setup: Setup) -> str:
        return setup.model

    def _errors(self, setup: Setup, element: Element | None, read: Parameters) -> None:
        if element is None:
            raise SimulationError(
                "an IMU plugin must be in the <sensor> of a link", position=self.plugin.element.origin.position
            )
        self._relative = read.flag("initial_orientation")
        self._gyro, self._accelerometer = _written(element, setup.random)
        self._set_variances()
        if self.spec.generation == "ros1":
            self._compass = read.number("gaussian_noise")
            self._plugin = Noise(deviation=self._compass)
            self._variances = (np.full(3, self._compass**2),) * 3


class GzImu(PlainImu):
    """IMU of gz sim, which publishes without a plugin."""

    kind = "gz_imu"
    _relative = True

    def _errors(self, setup: Setup, element: Element | None, read: Parameters) -> None:
        assert element is not None
        self._gyro, self._accelerometer = _written(element, setup.random)
        self._set_variances()


class BodyImu(PlainImu):
    """gazebo_ros_imu of ROS 1: acceleration without gravity, in the link's axes.

    The plugin rotates its vectors in the wrong direction; urdfkit publishes them in the axes of the configured link.
    """

    kind = "imu"

    def _errors(self, setup: Setup, element: Element | None, read: Parameters) -> None:
        if not read.text("body"):
            raise SimulationError(
                f"gazebo_ros_imu has no <{read.tag('body')}>", position=self.plugin.element.origin.position
            )
        self._gravity = np.zeros(3)
        deviation = read.number("gaussian_noise")
        self._gyro = self._accelerometer = (Noise(deviation=deviation),) * 3
        self._set_variances()
        self._variances = np.full(3, deviation**2), *self._variances[1:]


class HectorImu(Imu):
    """hector_gazebo_ros_imu of ROS 1: drifting errors of acceleration, angular velocity and heading."""

    kind = "hector_imu"

    def _errors(self, setup: Setup, element: Element | None, read: Parameters) -> None:
        errors = partial(drifting, read, rate=self.rate, dt=setup.dt, random=setup.random)
        self._accelerometer = errors("accel_", 3)
        self._gyro = errors("rate_", 3)
        yaw = "yaw_" if any(read.has(f"yaw_{each}") for each in ("offset", "drift", "gaussian_noise")) else "heading_"
        self._heading = errors(yaw, 1)
        roll, pitch, yaw_offset = read.vector("rpy_offset", 3)
        self._offset = np.eye(3)  # rpy_offset is an error of acceleration and heading, as of a tilted IMU
        for error, offset in (
            (self._accelerometer, np.array([pitch * G, -roll * G, 0.0])),
            (self._heading, np.array([yaw_offset])),
        ):
            error.offset = np.where(error.offset == 0.0, offset, error.offset)
        if old := read.number("gaussian_noise"):
            self._accelerometer.noise = self._gyro.noise = np.full(3, old)
        level = self._accelerometer.noise**2 / max(matmul(self._gravity, self._gravity), 1e-12)
        self._variances = (
            np.array([level[0], level[1], float(self._heading.noise[0]) ** 2]),
            self._gyro.noise**2,
            self._accelerometer.noise**2,
        )

    def _err(self, felt: Felt, sample: Sample) -> Felt:
        heading = float(self._heading.at(sample.turn)[0])
        turning, pulled = felt.turning + self._gyro.at(sample.turn), felt.pulled + self._accelerometer.at(sample.turn)
        return Felt(felt.t, matmul(felt.rotation, rotation_matrix(0.0, 0.0, heading)), felt.shaken, turning, pulled)


def _written(element: Element, random: np.random.Generator) -> tuple[tuple[Noise, ...], tuple[Noise, ...]]:
    """Return the noises of angular velocity and of linear acceleration in a sensor's ``<imu>``, along x, y and z."""
    imu = element.find("imu")
    kinds = [None if imu is None else imu.find(tag) for tag in ("angular_velocity", "linear_acceleration")]
    gyro, accelerometer = (
        tuple(noise_of(None if kind is None else kind.find(axis), random) for axis in "xyz") for kind in kinds
    )
    return gyro, accelerometer


def _noisy(values: Array, noises: tuple[Noise, ...], random: np.random.Generator) -> Array:
    return np.array([noise.on(value, random) for noise, value in zip(noises, values, strict=True)])
