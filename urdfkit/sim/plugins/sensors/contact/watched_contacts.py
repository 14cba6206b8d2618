"""Contacts of the collisions that a contact sensor watches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.linear_algebra import Array, matmul
from urdfkit.sim.engine import Contact
from urdfkit.sim.plugins.sensors.contact.collision_names import Collision, collisions_of, find, scoped_name
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.scene_view import Layout
from urdfkit.sim.state.robot_state import State

Seen = dict[tuple[str, str], "list[Contact]"]
"""(watched link, other body), named as in contacts → their contacts."""


@dataclass(frozen=True, eq=False)
class Touch:
    """Two collisions in contact.

    Attributes:
        mine: Gazebo's scoped name of the sensor's collision.
        other: Gazebo's scoped name of the other collision.
        points: contact points; at least one.
    """

    mine: str
    other: str
    points: list[Point] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class Point:
    """Contact point, in the world's axes.

    Attributes:
        position: position of the point [m]; shape (3,).
        normal: unit normal towards the sensor's link; shape (3,).
        depth: penetration depth [m].
        force: force on the sensor's link [N]; shape (3,).
        arm: position relative to the centre of mass of the sensor's link [m]; shape (3,).
    """

    position: Array
    normal: Array
    depth: float
    force: Array
    arm: Array


class Watch:
    """Collisions that a plugin watches, and their contacts.

    Args:
        setup: setup of the plugin.
        sensors: the ``<sensor>`` elements whose ``<contact>`` names the collisions, each with its link.

    Raises:
        SimulationError: a sensor names no collision or an unknown one, with its position.
    """

    def __init__(self, setup: Setup, sensors: Sequence[tuple[Element, str]]) -> None:
        assert setup.surroundings is not None
        robot = setup.kinematics.robot
        self._model, self._names = setup.model, setup.kinematics.link_names
        self._prefix = f"{setup.model}::" if setup.namespace else ""
        collisions = collisions_of(robot, setup.surroundings.robots[setup.model].scene)
        watched = [each for element, link in sensors for each in _watched(element, collisions, link)]
        self._watched = {(each.link, each.number): each for each in watched}
        self._centres = {
            link.name: np.array(link.inertial.origin.xyz if link.inertial else (0.0, 0.0, 0.0)) for link in robot.links
        }
        self._links = {each.link for each in watched}

    def look(self, state: State) -> Seen:
        """Return the contacts of the last step with links that have watched collisions."""
        found: Seen = {}
        for contact in state.contacts:
            if contact.depth >= 0.0 or any(contact.force):
                for mine, other in ((contact.a, contact.b), (contact.b, contact.a)):
                    if mine.startswith(self._prefix) and mine.removeprefix(self._prefix) in self._links:
                        found.setdefault((mine, other), []).append(contact)
                        break
        return found

    def touches(self, seen: Seen, layout: Layout) -> list[Touch]:
        """Return the touches of the watched collisions.

        Args:
            seen: contacts from `look`.
            layout: layout of the scene at that step.
        """
        found: dict[tuple[str, str], Touch] = {}
        for (mine, other), contacts in seen.items():
            link = mine.removeprefix(self._prefix)
            placement = layout.placement(self._model, self._names.index(link))
            R, origin = placement[:3, :3], placement[:3, 3]
            for contact in contacts:
                position, sign = np.array(contact.position), 1.0 if contact.a == mine else -1.0
                numbers = (contact.a_shape, contact.b_shape) if sign > 0.0 else (contact.b_shape, contact.a_shape)
                collision = self._watched.get((link, numbers[0]))
                if collision is None:
                    continue
                names = f"{self._model}::{link}::{collision.name}", scoped_name(other, layout, numbers[1])
                arm = position - (origin + matmul(R, self._centres[link]))
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


def _watched(element: Element, collisions: tuple[Collision, ...], link: str) -> tuple[Collision, ...]:
    """Return the collisions that a sensor's ``<contact>`` names.

    Raises:
        SimulationError: the sensor names no collision or an unknown one, with its position.
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
            names = [collision.name for collision in sorted(collisions, key=lambda one: one.link != link)]
            hint = did_you_mean(each.text, names) or (f" (it has {', '.join(names[:4])})" if names else "")
            raise SimulationError(f"the robot has no collision `{each.text}`" + hint, position=each.origin.position)
        found.extend(means)
    return tuple(found)
