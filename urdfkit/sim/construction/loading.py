"""What is simulated: a MODEL, loaded, and whether it can move."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import World, load_world
from urdfkit.description.urdf.masses import massless
from urdfkit.errors import SimulationError
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import matmul
from urdfkit.sim.construction.spawn import Spawn
from urdfkit.sim.construction.validation import require_sound
from urdfkit.sim.state.arguments import vector

STRONGEST = 1e4
"""Gravity beyond any that robots stand in [m/s²]: the Sun's is 274, and in a step of 1 ms it gives 10 m/s."""

SINGULAR = 1e-9
"""Least eigenvalue of a mass matrix, scaled to ones on its diagonal, of a robot that can be simulated."""


def require_sense(seed: int, spawn: Spawn | None) -> None:
    """Refuse arguments of a simulation that are nothing of the kind.

    Raises:
        SimulationError: the first of them.
    """
    if not isinstance(seed, int) or seed < 0:
        raise SimulationError(f"`{seed}` is no seed; it must be a whole number, zero or more")
    if not isinstance(spawn, Spawn | None):
        raise SimulationError(f"`spawn` is {spawn!r}; it must be a Spawn, such as Spawn(x=1.0, yaw=1.57)")


def the_world(world: World | str | Path, gravity: Sequence[float] | None, package_path: Sequence[str | Path]) -> World:
    """Return a world, loaded by name or file where it is not, with another gravity [m/s²] where that is given.

    Raises:
        UrdfkitError: there is none, it is broken, or the gravity is no vector.
    """
    found = world if isinstance(world, World) else load_world(world, package_path=package_path)
    if gravity is None:
        return found
    return replace(found, gravity=sound_gravity(gravity))


def sound_gravity(gravity: Sequence[float]) -> tuple[float, float, float]:
    """Return gravity [m/s²] that can be simulated.

    Raises:
        SimulationError: it is not three finite numbers, or stronger than any that robots stand in.
    """
    x, y, z = vector(gravity, 3, "gravity", "m/s²")
    if max(abs(x), abs(y), abs(z)) > STRONGEST:
        raise SimulationError(f"gravity of {max(x, y, z, key=abs):g} m/s² makes no sense; the Earth's is 0,0,-9.81")
    return x, y, z


def require_masses(kinematics: Kinematics, q: NDArray[np.float64], note: Callable[[str], None]) -> None:
    """Check that everything is a body or a joint, and that everything that moves has something to move.

    A link without mass between two joints can do with the mass of the links it carries, if their axes differ; that is
    seen from the mass matrix. Gazebo drops such links, so they are noted.

    Args:
        kinematics: the robot's model.
        q: where it starts.
        note: tells the user something.

    Raises:
        SimulationError: a mass, an inertia, a shape or a limit cannot be, or a link must move but has no mass; with its
            place and what to write.
    """
    require_sound(kinematics.robot)
    found = massless(kinematics.robot, floating=kinematics.floating_base)
    if not found:
        return
    if _is_regular(kinematics, q):
        for link, _ in found:
            note(f"{link.element.origin.position}: link `{link.name}` has no mass: it moves with what it carries")
        return
    # What carries nothing is at fault, not what carries it.
    link, joint = found[-1]
    why = f"joint `{joint.name}` moves it" if joint is not None else "the robot is free to move"
    instead = "or fix it to a link that has them" if joint is not None else "or hold it still with --fixed-base"
    problem = "has no <inertial>" if link.inertial is None else "has no mass or no moment of inertia"
    raise SimulationError(
        f"link `{link.name}` {problem}, but {why}: write <inertial> with <mass> and <inertia> into it, {instead}",
        position=link.element.origin.position,
    )


def _is_regular(kinematics: Kinematics, q: NDArray[np.float64]) -> bool:
    """Whether every joint moves a mass, and the mass matrix can be inverted."""
    import pinocchio

    pin: Any = pinocchio
    pin.computeSubtreeMasses(kinematics.model, kinematics.data)
    if not all(mass > 0.0 for mass in list(kinematics.data.mass)[1:]):
        return False
    upper = np.triu(pin.crba(kinematics.model, kinematics.data, q))
    G = kinematics.mimic_matrix
    M = matmul(matmul(G.T, upper + np.triu(upper, 1).T), G)
    own = np.diag(M)
    if not np.isfinite(M).all() or not (own > 1e-15 * own.max(initial=0.0)).all():  # what rounding leaves of a zero
        return False
    scale = np.sqrt(own)
    return bool(np.linalg.eigvalsh(M / np.outer(scale, scale))[0] > SINGULAR)
