"""Thickness for links whose mass lies on a line, where the robot could not be simulated without it.

The inertia tensor of such a link has a principal moment of zero, such as ``ixx="1" iyy="1" izz="0"``. Free, or on a
joint along the line, nothing resists its rotation about the line, and the mass matrix is singular. MuJoCo refuses such
a body; PyBullet ignores the tensor of the file and takes that of the shapes.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from urdfkit.defect_message import with_effect
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Link, Robot
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import matmul, symmetric_eigen
from urdfkit.sim.construction.loading import is_regular
from urdfkit.sim.construction.repairs.inertia_tensors import ZERO, inertia_of, repair_at

Array = NDArray[np.float64]

THICKNESS = 1e-3
"""Second moment across the line, relative to that along it: a cylinder with a length of 55 radii."""


def with_thickness(robot: Robot, *, floating: bool) -> tuple[Robot, list[Repair]]:
    """Return a robot whose mass matrix is regular where masses on a line made it singular, and the repairs.

    Args:
        robot: the robot, with possible tensors.
        floating: whether its base moves.
    """
    thin = {link.name: tensor for link in robot.links if (tensor := _on_line(link)) is not None}
    if not thin:
        return robot, []
    # Rounding must not make a singular matrix regular.
    lines = {name: _with_second_moments(robot.link_by_name[name], tensor, 0.0) for name, tensor in thin.items()}
    kinematics = Kinematics(_replaced(robot, lines), floating_base=floating)
    if is_regular(kinematics, kinematics.neutral()):
        return robot, []
    thick = {name: _with_second_moments(robot.link_by_name[name], tensor, THICKNESS) for name, tensor in thin.items()}
    return _replaced(robot, thick), [_repair(link) for link in thick.values()]


def _on_line(link: Link) -> Array | None:
    """Return the tensor of a link whose mass lies on a line, shape (3, 3); else None."""
    inertial = link.inertial
    if inertial is None or inertial.inertia is None or not (inertial.mass or 0.0) > 0.0:
        return None
    tensor = np.array(inertial.inertia.rows)
    smallest, _, largest = symmetric_eigen(tensor)[0].tolist()
    return tensor if largest > 0.0 and smallest <= ZERO * largest else None


def _with_second_moments(link: Link, tensor: Array, least: float) -> Link:
    """Return a link whose second moments are at least this part of the largest; those below `ZERO` of it count as 0."""
    inertial = link.inertial
    assert inertial is not None
    assert inertial.inertia is not None
    values, axes = symmetric_eigen(np.trace(tensor) / 2.0 * np.eye(3) - tensor)
    values = np.where(values > ZERO * values.max(), values, 0.0)
    second = matmul(axes * np.maximum(values, least * values.max()), axes.T)
    inertia = inertia_of(np.trace(second) * np.eye(3) - second, inertial.inertia.element)
    return replace(link, inertial=replace(inertial, inertia=inertia))


def _repair(link: Link) -> Repair:
    assert link.inertial is not None
    assert link.inertial.inertia is not None
    moments = symmetric_eigen(link.inertial.inertia.rows)[0].tolist()
    message = with_effect(
        f"link `{link.name}` has a principal moment of inertia of zero, so nothing resists its rotation about "
        "that axis",
        f"simulated with {', '.join(f'{moment:.4g}' for moment in moments)} kg·m² (as a rod with a thickness)",
    )
    return repair_at(link.inertial.inertia.element, "inertia", "I502", message, link=link.name)


def _replaced(robot: Robot, links: dict[str, Link]) -> Robot:
    return replace(robot, links=tuple([links.get(link.name, link) for link in robot.links]))
