"""Contact sensors: gazebo_ros_bumper of ROS 1 and ROS 2, and gz sim's contact system.

A sensor reports the contacts of the collisions named in its ``<contact>``: position, normal (towards the sensor's
link), depth and force. All vectors are in the world's axes, regardless of ``frameName``, as in the plugin's source;
torques are about the link's centre of mass. While a topic has subscribers, the simulation stops at every step, so a
contact between two messages is part of the later message, with the values of its last step.
"""

from abc import abstractmethod
from functools import partial
from typing import Any

import numpy as np

from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array
from urdfkit.messages import BOOL, header, message_type, vector
from urdfkit.messages.sensors import CONTACT_STATE, CONTACTS_STATE, GZ_CONTACT, GZ_CONTACTS, GZ_JOINT_WRENCH
from urdfkit.messages.simulation import ENTITY
from urdfkit.sim.plugins.base import Sensor
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.contact.watched_contacts import Point, Seen, Touch, Watch
from urdfkit.sim.plugins.sensors.motion_sensor import carrier
from urdfkit.sim.plugins.sensors.sensor_values import rate_of
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.scene_view import Layout
from urdfkit.sim.state.periodic_steps import NEVER
from urdfkit.sim.state.robot_state import State


class Contacts(Sensor):
    """Contact sensor; collects the contacts of every step."""

    lead = NEVER

    def configure(self, setup: Setup) -> None:
        """Find the named collisions, and advertise the topics.

        Raises:
            SimulationError: the sensor names no collision or an unknown one, with its position.
        """
        sensor = setup.sensor
        if sensor is None or setup.surroundings is None:
            message = "a contact sensor plugin must be in the <sensor> of a link"
            raise SimulationError(message, position=self.plugin.element.origin.position)
        link = carrier(setup)
        self.name = sensor.name or "sensor"
        read = self.parameters(setup, link=link, sensor=self.name)
        self.frame = read.text("frame").lstrip("/")
        self.rate = rate_of(sensor.element, read)
        self._surroundings = setup.surroundings
        self._watch = Watch(setup, [(sensor.element, link)])
        self._seen: Seen = {}
        self._advertise(setup, sensor.element, read)

    @abstractmethod
    def _advertise(self, setup: Setup, element: Element, read: Parameters) -> None:
        """Fill `topics`."""

    def act(self, state: State) -> None:
        """Collect the contacts of the step, and publish the messages that are due."""
        self._seen.update(self._watch.look(state))
        super().act(state)

    def reset(self, step: int = 0) -> None:
        """Restart at a step."""
        super().reset(step)
        self._seen = {}

    def measure(self, state: State, count: int) -> None:
        """Publish the measurement of this state."""
        seen, self._seen = self._seen, {}
        self._offer(state.t, seen, self._surroundings.layout(), count)

    @abstractmethod
    def _offer(self, t: float, seen: Seen, layout: Layout, count: int) -> None:
        """Publish the collected contacts."""


class Bumper(Contacts):
    """gazebo_ros_bumper of ROS 1 and ROS 2: publishes a ContactsState, empty without contacts."""

    kind = "bumper"

    def _advertise(self, setup: Setup, element: Element, read: Parameters) -> None:
        topics = self.topic_names()
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic") or "bumper_states"), CONTACTS_STATE),)

    def _offer(self, t: float, seen: Seen, layout: Layout, count: int) -> None:
        self.topics[0].offer(partial(self._message, t, seen, layout), count=count)

    def _message(self, t: float, seen: Seen, layout: Layout) -> Any:
        touches = self._watch.touches(seen, layout)
        states = [_state(touch, k, len(touches), t) for k, touch in enumerate(touches)]
        return message_type(CONTACTS_STATE)(header(t, self.frame), states)


class GzContact(Contacts):
    """Contact sensor of gz sim: publishes Contacts in steps with a contact only."""

    kind = "gz_contact"

    def _advertise(self, setup: Setup, element: Element, read: Parameters) -> None:
        self.rate = 0.0  # systems/contact/Contact.cc ignores the update rate
        contact = element.find("contact")
        written = None if contact is None else contact.find("topic")
        name = (written.text if written is not None else "") or read.text("topic")
        self.topics = (setup.bus.advertise(self.topic_names().resolve(name), GZ_CONTACTS),)

    def _offer(self, t: float, seen: Seen, layout: Layout, count: int) -> None:
        if touches := self._watch.touches(seen, layout):
            self.topics[0].offer(partial(self._message, t, touches))

    def _message(self, t: float, touches: list[Touch]) -> Any:
        def vectors(name: str, touch: Touch) -> list[Any]:
            return [vector(getattr(point, name).tolist()) for point in touch.points]

        contacts = [
            message_type(GZ_CONTACT)(
                _entity(touch.mine), _entity(touch.other), vectors("position", touch), vectors("normal", touch),
                np.array([point.depth for point in touch.points]), [_joint_wrench(touch, p, t) for p in touch.points],
            )
            for touch in touches
        ]  # fmt: skip
        return message_type(GZ_CONTACTS)(header(t, ""), contacts)


def _wrench(force: Array, torque: Array) -> Any:
    return message_type("geometry_msgs/msg/Wrench")(vector(force.tolist()), vector(torque.tolist()))


def _state(touch: Touch, number: int, of: int, t: float) -> Any:
    """Return a ContactState (gazebo_ros_bumper.cpp)."""
    forces = [point.force for point in touch.points]
    torques = [np.cross(point.arm, point.force) for point in touch.points]
    info = f"Debug:  i:({number}/{of})     my geom:{touch.mine}   other geom:{touch.other}         time:{t:.9f}\n"
    return message_type(CONTACT_STATE)(
        info, touch.mine, touch.other,
        [_wrench(force, torque) for force, torque in zip(forces, torques, strict=True)],
        _wrench(np.sum(forces, axis=0), np.sum(torques, axis=0)),
        [vector(point.position.tolist()) for point in touch.points],
        [vector(point.normal.tolist()) for point in touch.points],
        np.array([point.depth for point in touch.points]),
    )  # fmt: skip


def _entity(name: str) -> Any:
    """Return the Entity of a collision, with id 0."""
    return message_type(ENTITY)(0, name, 5)


def _joint_wrench(touch: Touch, point: Point, t: float) -> Any:
    text, number = message_type("std_msgs/msg/String"), message_type("std_msgs/msg/UInt32")
    return message_type(GZ_JOINT_WRENCH)(
        header(t, ""), text(touch.mine), number(0), text(touch.other), number(0),
        _wrench(point.force, np.cross(point.arm, point.force)), _wrench(-point.force, np.zeros(3)),
    )  # fmt: skip


class GzTouch(Sensor):
    """TouchPlugin of gz sim: publishes true once the model has touched a target for a given time.

    Only the collisions of the model's contact sensors count. After the message, the plugin is disabled until a message
    on ``NAMESPACE/enable`` enables it.
    """

    kind = "gz_touch"

    def configure(self, setup: Setup) -> None:
        """Read target, time and namespace, and advertise the topic.

        Raises:
            SimulationError: a parameter is missing, or the model has no contact sensor, with the position.
        """
        read = self.parameters(setup)
        for meaning in ("target", "namespace", "time"):
            if not read.text(meaning):
                raise SimulationError(
                    f"the touch plugin has no <{read.tag(meaning)}>", position=self.plugin.element.origin.position
                )
        assert setup.surroundings is not None
        sensors = [
            (sensor.element, block.reference or "")
            for block in setup.kinematics.robot.gazebo
            for sensor in block.sensors
            if sensor.type == "contact"
        ]
        if not sensors:
            message = "the touch plugin needs a <sensor> of type contact in its model"
            raise SimulationError(message, position=self.plugin.element.origin.position)
        self.name = self.plugin.name or "touch"
        self._target, self._time = read.text("target"), read.number("time")
        self._starts_enabled = self._enabled = read.flag("enabled")
        self._since: float | None = None
        self._surroundings, self._watch = setup.surroundings, Watch(setup, sensors)
        namespace = read.text("namespace")
        self.topics = (setup.bus.advertise(f"{namespace}/touched", BOOL),)
        setup.bus.subscribe(f"{namespace}/enable", BOOL, self._enable)

    def _enable(self, message: Any) -> None:
        self._enabled, self._since = bool(message.data), None

    def reset(self, step: int = 0) -> None:
        """Restart at a step."""
        super().reset(step)
        self._enabled, self._since = self._starts_enabled, None

    def stop(self, step: int) -> int:
        """Return the next step at which the simulation has to stop for the sensor; `NEVER` while it is disabled."""
        return super().stop(step) if self._enabled else NEVER

    def measure(self, state: State, count: int) -> None:
        """Publish true, once, when the contact has lasted longer than the given time."""
        if not self._enabled:
            return
        touches = self._watch.touches(self._watch.look(state), self._surroundings.layout())
        if not any(self._target in name for touch in touches for name in (touch.mine, touch.other)):
            self._since = None
        elif self._since is None:
            self._since = state.t
        elif state.t - self._since > self._time:
            self._enabled = False
            self.topics[0].publish(message_type(BOOL)(True))
