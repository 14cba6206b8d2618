"""Joint load: the wrench that the parent link exerts on the child link, from the balance of momentum.

Between two steps, the momentum of the subtree below a joint changes by the impulses of gravity, contacts, external
wrenches and the joint; all except the joint's are known. Momenta are computed from the links of the description, so the
method also works for fixed joints.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from urdfkit.description.urdf.robot import Robot
from urdfkit.linear_algebra import Array, matmul
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.sim.plugins.sensors.point_motion import PointMotion

Wrench = tuple[Array, Array]
"""Force [N] and torque [N·m], along the world's axes."""


@dataclass(frozen=True, eq=False)
class Lump:
    """Link with mass.

    Attributes:
        link: name of the link.
        mass: mass [kg].
        frame: frame of its inertia in the link, with the origin at the centre of mass; shape (4, 4).
        inertia: inertia tensor about the centre of mass [kg·m²]; shape (3, 3).
    """

    link: str
    mass: float
    frame: Array
    inertia: Array


def below(robot: Robot, link: str) -> tuple[str, ...]:
    """Return a link and all its descendants."""
    found = [link]
    for name in found:
        found.extend(joint.child for joint in robot.children_of.get(name, ()) if joint.child is not None)
    return tuple(found)


def lumps_of(robot: Robot, links: Sequence[str]) -> tuple[Lump, ...]:
    """Return a `Lump` for each link with a mass."""
    found = []
    for name in links:
        inertial = robot.link_by_name[name].inertial
        if inertial is None or not inertial.mass:
            continue
        tensor = np.zeros((3, 3)) if inertial.inertia is None else np.array(inertial.inertia.rows)
        found.append(Lump(name, inertial.mass, pose_matrix(inertial.origin), tensor))
    return tuple(found)


def momentum(lumps: Sequence[Lump], motions: Sequence[PointMotion], about: Array) -> Wrench:
    """Return linear momentum [kg·m/s] and angular momentum [kg·m²/s] about a fixed point.

    Args:
        lumps: links with mass.
        motions: motion of the inertia frame of each link.
        about: reference point [m]; shape (3,).
    """
    linear, angular = np.zeros(3), np.zeros(3)
    for lump, motion in zip(lumps, motions, strict=True):
        p = lump.mass * motion.linear
        linear += p
        angular += np.cross(motion.position - about, p)
        angular += matmul(matmul(matmul(motion.rotation, lump.inertia), motion.rotation.T), motion.angular)
    return linear, angular


def weight(lumps: Sequence[Lump], motions: Sequence[PointMotion], gravity: Array, about: Array) -> Wrench:
    """Return the wrench of gravity on links, about a point.

    Args:
        lumps: links with mass.
        motions: motion of the inertia frame of each link.
        gravity: gravitational acceleration [m/s²]; shape (3,).
        about: reference point [m]; shape (3,).
    """
    force, torque = np.zeros(3), np.zeros(3)
    for lump, motion in zip(lumps, motions, strict=True):
        force += lump.mass * gravity
        torque += np.cross(motion.position - about, lump.mass * gravity)
    return force, torque
