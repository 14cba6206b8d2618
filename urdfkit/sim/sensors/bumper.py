"""Contact sensors: gazebo_ros_bumper of ROS 1 and ROS 2, and the new Gazebo's contact system.

They tell what touches the collisions that are named in their ``<contact>``: where, along which normal (towards the
sensor's side), how deep, and what pushes it there. Everything is in the world's axes, whatever ``frameName`` says, as
in the plugin's source; torques are about the centre of mass of the link. While somebody listens, the simulation stops
at every step, so that a touch between two messages is told in the later one, with the last of its steps.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.messages import header, message_type, vector
from urdfkit.sensor_messages import CONTACT_STATE, CONTACTS_STATE, GZ_CONTACT, GZ_CONTACTS, GZ_JOINT_WRENCH
from urdfkit.sim.parameters import Parameters
from urdfkit.sim.plugin import Sensor, Setup
from urdfkit.sim.schedule import NEVER
from urdfkit.sim.sensors.carried import carrier
from urdfkit.sim.sensors.collisions import Collision, collisions_of, find, nearest, scoped_name
from urdfkit.sim.sensors.values import rate_of
from urdfkit.sim.topics import Topics
from urdfkit.world_messages import ENTITY

if TYPE_CHECKING:
    from urdfkit.description.element import Element
    from urdfkit.sim.engine import Contact
    from urdfkit.sim.state import State
    from urdfkit.sim.surroundings import Layout

Array = NDArray[np.float64]
Seen = dict[tuple[str, str], "list[Contact]"]
"""What touched what, by the names that contacts have."""


@dataclass(frozen=True, eq=False)
class Touch:
    """Two collisions that touch.

    Attributes:
        mine: the sensor's collision, as Gazebo calls it.
        other: what it touches.
        points: where, and how; at least one.
    """

    mine: str
    other: str
    points: list[Point] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class Point:
    """A point of contact, in the world's axes.

    Attributes:
        position: [m]; shape (3,).
        normal: towards the sensor's side; shape (3,).
        depth: [m].
        force: on the sensor's side [N]; shape (3,).
        arm: from the centre of mass of the sensor's link [m]; shape (3,).
    """

    position: Array
    normal: Array
    depth: float
    force: Array
    arm: Array


class Contacts(Sensor):
    """A contact sensor."""

    def configure(self, setup: Setup) -> None:
        """Find the collisions that are named, and advertise.

        Raises:
            SimulationError: there is none, or none of that name, with its place.
        """
        sensor = setup.sensor
        if sensor is None or setup.surroundings is None:
            raise SimulationError(
                "a contact sensor stands in a <sensor> of a link, and in none here",
                position=self.plugin.element.origin.position,
            )
        link = carrier(setup)
        self.name = sensor.name or "sensor"
        read = Parameters(self.plugin, self.spec, {**setup.names, "link": link, "sensor": self.name})
        self.frame = read.text("frame").lstrip("/")
        self.rate = rate_of(sensor.element, read)
        self._model, self._kinematics = setup.model, setup.kinematics
        self._prefix = f"{setup.model}::" if setup.namespace else ""
        self._surroundings = setup.surroundings
        scene = next(each.scene for name, each in setup.surroundings.robots.items() if name == setup.model)
        collisions = collisions_of(setup.kinematics.robot, scene)
        self._watched = _watched(sensor.element, collisions, link)
        self._of_link: dict[str, tuple[Collision, ...]] = {}
        for each in collisions:
            self._of_link[each.link] = (*self._of_link.get(each.link, ()), each)
        self._centres = {
            each.name: np.array(each.inertial.origin.xyz if each.inertial else (0.0, 0.0, 0.0))
            for each in setup.kinematics.robot.links
        }
        self._links = {each.link for each in self._watched}
        self._seen: Seen = {}
        self._advertise(setup, sensor.element, read)

    @abstractmethod
    def _advertise(self, setup: Setup, element: Element, read: Parameters) -> None:
        """Fill `topics`."""

    def next_stop(self, step: int) -> int:
        """Return the next step while somebody listens."""
        return NEVER if super().next_stop(step) == NEVER else step + 1

    def catch_up(self, state: State) -> None:
        """Take note of what touches, and measure what has fallen due."""
        fresh: Seen = {}
        for contact in state.contacts:
            if contact.depth >= 0.0 or any(contact.force):
                for mine, other in ((contact.a, contact.b), (contact.b, contact.a)):
                    link = mine.removeprefix(self._prefix)
                    if mine.startswith(self._prefix) and link in self._links:
                        fresh.setdefault((mine, other), []).append(contact)
                        break
        self._seen.update(fresh)
        super().catch_up(state)

    def reset(self) -> None:
        """Start again at step 0."""
        super().reset()
        self._seen = {}

    def measure(self, state: State, count: int) -> None:
        """Publish."""
        seen, self._seen = self._seen, {}
        self._offer(state.t, seen, self._surroundings.layout(), count)

    @abstractmethod
    def _offer(self, t: float, seen: Seen, layout: Layout, count: int) -> None:
        """Publish what was seen."""

    def _touches(self, seen: Seen, layout: Layout) -> list[Touch]:
        """Return what touches the collisions that are watched."""
        found: dict[tuple[str, str], Touch] = {}
        for (mine, other), contacts in seen.items():
            link = mine.removeprefix(self._prefix)
            placement = layout.placement(self._model, self._kinematics.link_names.index(link))
            R, origin = placement[:3, :3], placement[:3, 3]
            for contact in contacts:
                position, sign = np.array(contact.position), 1.0 if contact.a == mine else -1.0
                collision = nearest(self._of_link[link], R.T @ (position - origin))
                if collision not in self._watched:
                    continue
                names = f"{self._model}::{link}::{collision.name}", scoped_name(other, layout, position)
                arm = position - (origin + R @ self._centres[link])
                found.setdefault(names, Touch(*names)).points.append(
                    Point(
                        position,
                        sign * np.array(contact.normal),
                        max(contact.depth, 0.0),
                        sign * np.array(contact.force),
                        arm,
                    )
                )
        return list(found.values())


class Bumper(Contacts):
    """gazebo_ros_bumper of ROS 1 and ROS 2: a ContactsState, empty where nothing touches."""

    kind = "bumper"

    def _advertise(self, setup: Setup, element: Element, read: Parameters) -> None:
        topics = Topics(self.plugin, self.spec)
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic") or "bumper_states"), CONTACTS_STATE),)

    def _offer(self, t: float, seen: Seen, layout: Layout, count: int) -> None:
        self.topics[0].offer(partial(self._message, t, seen, layout), count=count)

    def _message(self, t: float, seen: Seen, layout: Layout) -> Any:
        touches = self._touches(seen, layout)
        states = [_state(touch, k, len(touches), t) for k, touch in enumerate(touches)]
        return message_type(CONTACTS_STATE)(header(t, self.frame), states)


class GzContact(Contacts):
    """A contact sensor of the new Gazebo: Contacts whenever something touches, and nothing else."""

    kind = "gz_contact"

    def _advertise(self, setup: Setup, element: Element, read: Parameters) -> None:
        self.rate = 0.0  # systems/contact/Contact.cc looks at no rate
        contact = element.find("contact")
        written = None if contact is None else contact.find("topic")
        name = (written.text if written is not None else "") or read.text("topic")
        self.topics = (setup.bus.advertise(Topics(self.plugin, self.spec).resolve(name), GZ_CONTACTS),)

    def _offer(self, t: float, seen: Seen, layout: Layout, count: int) -> None:
        if touches := self._touches(seen, layout):
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


def _watched(element: Element, collisions: tuple[Collision, ...], link: str) -> tuple[Collision, ...]:
    """Return the collisions that a sensor's ``<contact>`` names.

    Raises:
        SimulationError: it names none, or one that is not there, with its place.
    """
    contact = element.find("contact")
    wanted = [] if contact is None else contact.find_all("collision")
    if not wanted:
        raise SimulationError(
            "a contact sensor lacks the <collision> in its <contact>", position=(contact or element).origin.position
        )
    found: list[Collision] = []
    for each in wanted:
        means = find(each.text, collisions, link)
        if not means:
            known = [collision.name for collision in sorted(collisions, key=lambda one: one.link != link)]
            hint = did_you_mean(each.text, known) or (f" (it has {', '.join(known[:4])})" if known else "")
            raise SimulationError(f"the robot has no collision `{each.text}`{hint}", position=each.origin.position)
        found.extend(means)
    return tuple(found)


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
    """Return an Entity that is a collision; it has no number here."""
    return message_type(ENTITY)(0, name, 5)


def _joint_wrench(touch: Touch, point: Point, t: float) -> Any:
    text, number = message_type("std_msgs/msg/String"), message_type("std_msgs/msg/UInt32")
    return message_type(GZ_JOINT_WRENCH)(
        header(t, ""), text(touch.mine), number(0), text(touch.other), number(0),
        _wrench(point.force, np.cross(point.arm, point.force)), _wrench(-point.force, np.zeros(3)),
    )  # fmt: skip
