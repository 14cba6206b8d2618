"""What a joint carries: the force and torque that the link above exerts on the one below, by the balance of momentum.

Between two steps the momentum of everything below a joint changes by what gravity, contacts, pushes and the joint give
it; all but the last are known. Momenta are those of the links as written, so it works for fixed joints as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.robot import Robot
from urdfkit.linear_algebra import matmul
from urdfkit.scene.placement import pose_matrix
from urdfkit.sim.plugins.sensors.point_motion import Motion

Array = NDArray[np.float64]
Wrench = tuple[Array, Array]
"""Force [N] and torque [N·m], along the world's axes."""


@dataclass(frozen=True, eq=False)
class Lump:
    """A link with mass.

    Attributes:
        link: its name.
        mass: [kg].
        frame: centre of mass, and the axes of its inertia, in the link; shape (4, 4).
        inertia: about the centre of mass [kg·m²]; shape (3, 3).
    """

    link: str
    mass: float
    frame: Array
    inertia: Array


def below(robot: Robot, link: str) -> tuple[str, ...]:
    """Return a link and all that hang on it."""
    found = [link]
    for name in found:
        found.extend(joint.child for joint in robot.children_of.get(name, ()) if joint.child is not None)
    return tuple(found)


def lumps_of(robot: Robot, links: Sequence[str]) -> tuple[Lump, ...]:
    """Return those of some links that have a mass."""
    found = []
    for name in links:
        inertial = robot.link_by_name[name].inertial
        if inertial is None or not inertial.mass:
            continue
        I = inertial.inertia  # noqa: E741 - the field's own letter
        tensor = np.zeros((3, 3))
        if I is not None:
            tensor = np.array([[I.ixx, I.ixy, I.ixz], [I.ixy, I.iyy, I.iyz], [I.ixz, I.iyz, I.izz]])
        found.append(Lump(name, inertial.mass, pose_matrix(inertial.origin), tensor))
    return tuple(found)


def momentum(lumps: Sequence[Lump], motions: Sequence[Motion], about: Array) -> Wrench:
    """Return linear momentum [kg·m/s] and angular momentum [kg·m²/s] about a point that stands still.

    Args:
        lumps: bodies.
        motions: of their centres of mass, with the axes of their inertias.
        about: the point [m]; shape (3,).
    """
    linear, angular = np.zeros(3), np.zeros(3)
    for lump, motion in zip(lumps, motions, strict=True):
        p = lump.mass * motion.linear
        linear += p
        angular += np.cross(motion.position - about, p)
        angular += matmul(matmul(matmul(motion.rotation, lump.inertia), motion.rotation.T), motion.angular)
    return linear, angular


def weight(lumps: Sequence[Lump], motions: Sequence[Motion], gravity: Array, about: Array) -> Wrench:
    """Return what gravity does to bodies, about a point.

    Args:
        lumps: bodies.
        motions: of their centres of mass.
        gravity: [m/s²]; shape (3,).
        about: the point [m]; shape (3,).
    """
    force, torque = np.zeros(3), np.zeros(3)
    for lump, motion in zip(lumps, motions, strict=True):
        force += lump.mass * gravity
        torque += np.cross(motion.position - about, lump.mass * gravity)
    return force, torque
