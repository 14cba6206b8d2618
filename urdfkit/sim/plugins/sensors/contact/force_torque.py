"""Force and torque at a joint: gazebo_ros_ft_sensor of ROS 1 and ROS 2, and gz sim's force_torque sensors.

The wrench is the mean over the step that ends with the measurement, so the simulation also stops one step earlier.
Without subscribers it does not stop, and the mean covers the time since its last stop. The wrench is about the origin
of the joint (of the sensor in gz sim), along the axes of the child link unless configured otherwise.
"""

from abc import abstractmethod
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.linear_algebra import Array, matmul
from urdfkit.messages import header, message_type, vector
from urdfkit.sim.engine import Contact
from urdfkit.sim.plugins.base import Sensor
from urdfkit.sim.plugins.sensors.contact.joint_load import Wrench, below, lumps_of, momentum, weight
from urdfkit.sim.plugins.sensors.noise import Noise, noise_of
from urdfkit.sim.plugins.sensors.point_motion import KinematicSnapshot
from urdfkit.sim.plugins.sensors.sensor_values import choice, pose_of, rate_of
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.robot_state import State

WRENCH = "geometry_msgs/msg/WrenchStamped"


FRAMES = ("parent", "child", "sensor")
DIRECTIONS = ("child_to_parent", "parent_to_child")


@dataclass(frozen=True, eq=False)
class Step:
    """Measured quantities of the last step.

    Attributes:
        now: robot at the end of the step.
        before: robot at the previous stop of the simulation; None at the first.
        contacts: contacts in the step.
        pushes: force [N], torque [N·m] and point of application [m] of each external wrench on the links, in the world.
    """

    now: KinematicSnapshot
    before: KinematicSnapshot | None
    contacts: tuple[Contact, ...]
    pushes: tuple[tuple[Array, Array, Array], ...]


class ForceTorque(Sensor):
    """Sensor of the wrench that a joint transmits.

    Attributes:
        frame: frame id of its messages.
    """

    lead = 1
    frame: str = ""
    _noises: tuple[Noise, ...]
    _sign = -1.0
    """-1 for the wrench of the child on the parent, 1 for the wrench of the parent on the child."""
    _mount: Array
    """Placement of the sensor in the child link; torques are about its origin; shape (4, 4)."""

    def configure(self, setup: Setup) -> None:
        """Find the joint, and advertise the topic.

        Raises:
            SimulationError: the joint is unknown or a parameter is invalid, with its position.
        """
        if setup.surroundings is None:
            raise SimulationError("nothing is around", position=self.plugin.element.origin.position)
        self.name = (setup.sensor.name if setup.sensor is not None else self.plugin.name) or "sensor"
        self._kinematics = setup.kinematics
        self._gravity = np.array(setup.surroundings.world.gravity)
        self._prefix = f"{setup.model}::" if setup.namespace else ""
        self._model, self._surroundings = setup.model, setup.surroundings
        self._key = int(setup.random.integers(1 << 62))
        self._before: KinematicSnapshot | None = None
        self._mount = np.eye(4)
        self._prepare(setup)
        self._links = below(setup.kinematics.robot, self._child)
        self._lumps = lumps_of(setup.kinematics.robot, self._links)

    @abstractmethod
    def _prepare(self, setup: Setup) -> None:
        """Read joint, rate, frame, direction and noise, and fill `topics`."""

    def _read_joint(self, setup: Setup, name: str, place: Any) -> None:
        """Read the parent and child link of a joint.

        Raises:
            SimulationError: the robot has no joint of that name.
        """
        robot = setup.kinematics.robot
        joint = robot.joint_by_name.get(name)
        if joint is None or joint.parent is None or joint.child is None:
            raise SimulationError(
                f"no joint `{name}` in robot `{robot.name}`" + did_you_mean(name, robot.joint_by_name), position=place
            )
        self._parent, self._child = joint.parent, joint.child

    def act(self, state: State) -> None:
        """Publish the messages that are due, and store this state for the next measurement."""
        super().act(state)
        self._before = KinematicSnapshot(self._kinematics, state)

    def reset(self, step: int = 0) -> None:
        """Restart at a step."""
        super().reset(step)
        self._before = None

    def measure(self, state: State, count: int) -> None:
        """Publish the measurement of this state."""
        now = KinematicSnapshot(self._kinematics, state)
        pushes = self._surroundings.pushes_on(self._model, self._links)
        step = Step(now, self._before, state.contacts, pushes)
        self.topics[0].offer(partial(self._message, step, self.done), count=count)

    def _message(self, step: Step, turn: int) -> Any:
        random = np.random.Generator(np.random.Philox(key=[self._key, turn]))
        force, torque = self._measured(step)
        found = [
            float(noise.on(np.array(value), random))
            for noise, value in zip(self._noises, (*force, *torque), strict=True)
        ]
        wrench = message_type("geometry_msgs/msg/Wrench")(vector(found[:3]), vector(found[3:]))
        return message_type(WRENCH)(header(step.now.t, self.frame), wrench)

    @abstractmethod
    def _axes(self, now: KinematicSnapshot) -> Array:
        """Return the axes of the published wrench in the world; shape (3, 3)."""

    def _measured(self, step: Step) -> Wrench:
        """Return the wrench without noise."""
        import pinocchio as pin

        here = step.now.motion(self._child, self._mount)
        # Half a step earlier, when the engine changes the velocities.
        half = 0.5 * (step.now.t - step.before.t) if step.before and step.now.step - step.before.step == 1 else 0.0
        force, torque = self._carried(step, here.position - half * here.linear)
        R = matmul(pin.exp3(-half * here.angular), self._axes(step.now))
        return self._sign * matmul(R.T, force), self._sign * matmul(R.T, torque)

    def _carried(self, step: Step, about: Array) -> Wrench:
        """Return the wrench of the joint on the child, about a point."""
        now = [step.now.motion(each.link, each.frame) for each in self._lumps]
        old, dt = now, 1.0
        if step.before is not None and step.before.step < step.now.step:
            old = [step.before.motion(each.link, each.frame) for each in self._lumps]
            dt = step.now.t - step.before.t
        gained = [(b - a) / dt for a, b in zip(*(momentum(self._lumps, m, about) for m in (old, now)), strict=True)]
        weights = [weight(self._lumps, motions, self._gravity, about) for motions in (old, now)]
        force, torque = (0.5 * (a + b) for a, b in zip(*weights, strict=True))
        for contact in step.contacts:
            for side, sign in ((contact.a, 1.0), (contact.b, -1.0)):
                if side.startswith(self._prefix) and side.removeprefix(self._prefix) in self._links:
                    f = sign * np.array(contact.force)
                    force += f
                    torque += np.cross(np.array(contact.position) - about, f)
        for f, t, at in step.pushes:
            force += f
            torque += t + np.cross(at - about, f)
        return gained[0] - force, gained[1] - torque


class JointForceTorque(ForceTorque):
    """gazebo_ros_ft_sensor of ROS 1 and ROS 2: the wrench of the child on the parent, along the child's axes."""

    kind = "force_torque"

    def _prepare(self, setup: Setup) -> None:
        read = self.parameters(setup)
        place = self.plugin.element.origin.position
        if self.plugin.element.find("body_name") is not None and self.spec.generation == "ros2":
            message = "gazebo_ros_ft_sensor on a link (<body_name>) is not simulated: name a joint in <joint_name>"
            raise SimulationError(message, position=read.place("body"))
        if not read.text("joint"):
            raise SimulationError(f"gazebo_ros_ft_sensor has no <{read.tag('joint')}>", position=place)
        if self.spec.generation == "ros1" and not read.text("topic"):
            raise SimulationError("gazebo_ros_ft_sensor has no <topicName>", position=place)
        self._read_joint(setup, read.text("joint"), read.place("joint"))
        self.rate = rate_of(None, read)
        self.frame = self._child
        self._noises = (Noise(deviation=read.number("gaussian_noise")),) * 6
        name = self.topic_names().resolve(read.text("topic") or "wrench")
        self.topics = (setup.bus.advertise(name, WRENCH),)

    def _axes(self, now: KinematicSnapshot) -> Array:
        return now.motion(self._child, self._mount).rotation


class GzForceTorque(ForceTorque):
    """Sensor of type force_torque of gz sim, in the ``<gazebo reference=…>`` of a joint."""

    kind = "gz_force_torque"

    def _prepare(self, setup: Setup) -> None:
        sensor = setup.sensor
        assert sensor is not None
        place = sensor.element.origin.position
        if setup.link in setup.kinematics.link_names or not setup.link:
            here = f"`{setup.link}` is a link" if setup.link else "this <gazebo> has no reference"
            raise SimulationError(
                f"a force_torque sensor must be in the <gazebo reference=…> of a joint; {here}", position=place
            )
        self._read_joint(setup, setup.link, place)
        self._mount = pose_of(sensor.element)
        read = self.parameters(setup, joint=setup.link, sensor=self.name)
        self.rate = rate_of(sensor.element, read)
        inside = sensor.element.find("force_torque")
        self._axes_of = choice(inside, "frame", FRAMES, "child")
        direction = choice(inside, "measure_direction", DIRECTIONS, DIRECTIONS[0])
        self._sign = -1.0 if direction == DIRECTIONS[0] else 1.0
        kinds = [None if inside is None else inside.find(tag) for tag in ("force", "torque")]
        self._noises = tuple(
            noise_of(None if kind is None else kind.find(axis), setup.random) for kind in kinds for axis in "xyz"
        )
        self.frame = (read.text("frame") or read.text("old_frame") or read.text("default_frame")).lstrip("/")
        self.topics = (setup.bus.advertise(self.topic_names().resolve(read.text("topic")), WRENCH),)

    def _axes(self, now: KinematicSnapshot) -> Array:
        if self._axes_of == "parent":
            return now.motion(self._parent, np.eye(4)).rotation
        return now.motion(self._child, self._mount if self._axes_of == "sensor" else np.eye(4)).rotation
