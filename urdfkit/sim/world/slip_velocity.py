"""Slip velocity: tangential velocity of a robot's contact points relative to the other body."""

from dataclasses import dataclass

import numpy as np

from urdfkit.linear_algebra import Array, matmul, vector_norm
from urdfkit.sim.engine import Contact
from urdfkit.sim.plugins.sensors.point_motion import PointMotion
from urdfkit.sim.world.live_world import LiveWorld
from urdfkit.sim.world.simulated_robot import SimulatedRobot


@dataclass(frozen=True, slots=True)
class ContactSlip:
    """A contact of a robot's link.

    Attributes:
        link: ``ROBOT::LINK``; only the link for the simulation's own robot.
        position: position in the world [m].
        velocity: tangential velocity of the link, relative to the other body [m/s].
    """

    link: str
    position: tuple[float, ...]
    velocity: tuple[float, ...]

    @property
    def speed(self) -> float:
        """Magnitude of the velocity [m/s]."""
        return vector_norm(self.velocity)


def slips(world: LiveWorld, contacts: tuple[Contact, ...]) -> list[ContactSlip]:
    """Return the slip of each contact of a robot's links.

    Args:
        world: world of the simulation.
        contacts: contacts of the last step.
    """
    motions = _Motions(world)
    found = []
    for contact in contacts:
        if (one := motions.of(contact.a)) is None:
            continue
        position, normal = np.array(contact.position), np.array(contact.normal)
        velocity = _at(one, position)
        if (other := motions.of(contact.b)) is not None:
            velocity -= _at(other, position)
        velocity -= matmul(velocity, normal) * normal
        found.append(ContactSlip(contact.a, contact.position, tuple(velocity.tolist())))
    return found


class _Motions:
    """Motions of links, each computed once."""

    def __init__(self, world: LiveWorld) -> None:
        self._links: dict[str, tuple[SimulatedRobot, str]] = {}
        for k, robot in enumerate(world.robots.values()):
            for link in robot.kinematics.link_names:
                self._links[f"{robot.name}::{link}" if k else link] = robot, link
        self._free = world.builder.free_bodies
        self._computed: dict[str, PointMotion | tuple[Array, Array]] = {}

    def of(self, name: str) -> PointMotion | tuple[Array, Array] | None:
        if name not in self._computed:
            if name in self._links:
                from urdfkit.sim.plugins.sensors.point_motion import KinematicSnapshot

                robot, link = self._links[name]
                self._computed[name] = KinematicSnapshot(robot.kinematics, robot.state).motion(link, np.eye(4))
            elif name in self._free:
                body = self._free[name]
                self._computed[name] = np.array(body.pose[:3]), np.array(body.twist)
            else:
                return None
        return self._computed[name]


def _at(motion: PointMotion | tuple[Array, Array], point: Array) -> Array:
    """Return the velocity of a point that moves with a link or body [m/s]."""
    if isinstance(motion, tuple):
        origin, twist = motion
        found: Array = twist[:3] + np.cross(twist[3:], point - origin)
        return found
    return np.array(motion.linear + np.cross(motion.angular, point - motion.position))
