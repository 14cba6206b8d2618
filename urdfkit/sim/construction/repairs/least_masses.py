"""Small masses for moving links with neither mass nor shapes, so that the rest of the robot moves as without them.

Every such link gets the same mass m and the inertia m·r², where r is the radius of gyration of the links with mass.
They add m·D to the mass matrix M of the rest. If m·D ≤ ε·M, the kinetic energy of every motion of the rest changes by
at most the factor ε, and so do its accelerations, in the norm of M. The base counts as moving, so the bound includes
gravity. m is the largest mass that fulfils the bound in the neutral configuration.

If M is singular for the joints that move the rest, such as those of an arm of which only the fingers have masses, the
rest does not determine its own motion, and no mass is small. Then m is the mean mass of the links with mass.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.massless_links import massless
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Inertia, Inertial, Link, Pose, Robot
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import matmul, symmetric_eigen
from urdfkit.sim.construction.loading import SINGULAR, is_regular
from urdfkit.sim.construction.repairs.estimated_masses import mass_repair

Array = NDArray[np.float64]

INFLUENCE = 5e-4
"""Largest relative change of the motion of the rest of the robot; half of the promised 0.1 %."""

ALONE = 1.0, 0.1
"""Mass [kg] and radius of gyration [m] of each link of a robot without any mass."""


def with_least_masses(robot: Robot, *, floating: bool) -> tuple[Robot, list[Repair]]:
    """Return a robot whose moving bodies all have a mass, and the repairs.

    A robot that can be simulated, because its links without mass carry other links, stays unchanged. A robot with a
    negative mass also stays unchanged, because no repair replaces it.

    Args:
        robot: the robot, with estimated masses where links have shapes.
        floating: whether its base moves.
    """
    found = massless(robot, floating=floating)
    if not found or any(link.inertial is not None and (link.inertial.mass or 0.0) < 0.0 for link in robot.links):
        return robot, []
    kinematics = Kinematics(robot, floating_base=floating)
    if is_regular(kinematics, kinematics.neutral()):
        return robot, []
    radius = _radius(robot)
    mass = _mass(robot, [link for link, _ in found], radius, floating=floating)
    basis = f"it changes the motion of the other links by at most {100.0 * INFLUENCE:g} %"
    if mass is None:
        mass = _mean_mass(robot)
        basis = "the mean mass of the other links, because too few of them have a mass for the joints that move them"
    elif not mass:
        mass, radius = ALONE
        basis = "no other link has a mass"
    changed = {link.name: _inertial(link, mass, radius) for link, _ in found}
    repairs = [mass_repair(link, [changed[link.name]], joint, basis) for link, joint in found]
    return _replaced(robot, changed), repairs


def _radius(robot: Robot) -> float:
    """Return the radius of gyration of the links with mass and inertia [m]."""
    mass = trace = 0.0
    for link in robot.links:
        if (own := link.inertial) is not None and own.mass and (i := own.inertia) is not None:
            mass += own.mass
            trace += i.ixx + i.iyy + i.izz
    return float(np.sqrt(trace / (3.0 * mass))) if mass > 0.0 and trace > 0.0 else ALONE[1]


def _mean_mass(robot: Robot) -> float:
    """Return the mean mass of the links with a mass [kg]."""
    return float(np.mean([link.inertial.mass for link in robot.links if link.inertial and link.inertial.mass]))


def _mass(robot: Robot, links: Sequence[Link], radius: float, *, floating: bool) -> float | None:
    """Return the mass of each of the links [kg]; zero if no other link has a mass, None if M is singular."""
    own = _scaled(_mass_matrix(robot, floating=floating))[0]
    if own.size and symmetric_eigen(own)[0][0] <= SINGULAR:
        return None
    heavy = _mass_matrix(robot)
    added = _mass_matrix(_replaced(robot, {link.name: _inertial(link, 1.0, radius) for link in links})) - heavy
    scaled, moved, scale = _scaled(heavy)
    if not moved.any():
        return 0.0
    values, axes = symmetric_eigen(scaled)
    kept = values > SINGULAR
    basis = axes[:, kept] / np.sqrt(values[kept])
    influence = matmul(matmul(basis.T, added[np.ix_(moved, moved)] / scale), basis)
    largest = float(symmetric_eigen(influence)[0][-1])
    return INFLUENCE / largest if largest > 0.0 else ALONE[0]


def _scaled(M: Array) -> tuple[Array, NDArray[np.bool_], Array]:
    """Return the rows and columns of M that move a mass, with a diagonal of ones; these rows; and their scale."""
    size = np.sqrt(np.maximum(np.diag(M), 0.0))
    moved = size > 1e-9 * size.max(initial=0.0)
    scale = np.outer(size[moved], size[moved])
    return M[np.ix_(moved, moved)] / scale, moved, scale


def _mass_matrix(robot: Robot, *, floating: bool = True) -> Array:
    import pinocchio

    pin: Any = pinocchio
    kinematics = Kinematics(robot, floating_base=floating)
    upper = np.triu(pin.crba(kinematics.model, kinematics.data, kinematics.neutral()))
    return np.asarray(upper + np.triu(upper, 1).T)


def _inertial(link: Link, mass: float, radius: float) -> Inertial:
    """Return the inertial of a link with a mass [kg] and a radius of gyration [m]."""
    moment = mass * radius**2
    origin = Pose() if link.inertial is None else link.inertial.origin
    inertia = Inertia(moment, 0.0, 0.0, moment, 0.0, moment, link.element)
    return Inertial(origin, mass, inertia, link.element)


def _replaced(robot: Robot, inertials: dict[str, Inertial]) -> Robot:
    """Return a robot with other inertials of some links."""
    changed = [replace(link, inertial=inertials.get(link.name, link.inertial)) for link in robot.links]
    return replace(robot, links=tuple(changed))
