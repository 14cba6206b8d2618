"""Loading of robots and worlds for a simulation, and validation of its arguments."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import World, load_world
from urdfkit.description.urdf.massless_links import massless
from urdfkit.errors import SimulationError
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import matmul
from urdfkit.notice import Notice
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.sim.construction.validation import require_valid
from urdfkit.sim.state.arguments import vector

MAX_GRAVITY = 1e4
"""Maximum gravity [m/s²]: the Sun's is 274, and this value adds 10 m/s in a step of 1 ms."""

SINGULAR = 1e-9
"""Minimum eigenvalue of a mass matrix, scaled to a diagonal of ones, that can be simulated."""


def require_valid_arguments(seed: int, spawn: Spawn | None) -> None:
    """Check the arguments of a simulation.

    Raises:
        SimulationError: an argument is invalid.
    """
    if not isinstance(seed, int) or seed < 0:
        raise SimulationError(f"`{seed}` is not a valid seed; use an integer, zero or greater")
    if not isinstance(spawn, Spawn | None):
        raise SimulationError(f"`spawn` is {spawn!r}; it must be a Spawn, such as Spawn(x=1.0, yaw=1.57)")


def world_with_gravity(
    world: World | str | Path, gravity: Sequence[float] | None, package_path: Sequence[str | Path]
) -> World:
    """Return a world, loaded from a file or by name if necessary, with gravity [m/s²] replaced unless None.

    Raises:
        UrdfkitError: the world does not exist or is invalid, or gravity is not a valid vector.
    """
    loaded = world if isinstance(world, World) else load_world(world, package_path=package_path)
    if gravity is None:
        return loaded
    return replace(loaded, gravity=valid_gravity(gravity))


def valid_gravity(gravity: Sequence[float]) -> tuple[float, float, float]:
    """Return a validated gravity vector [m/s²].

    Raises:
        SimulationError: the vector does not have three finite numbers, or a component exceeds `MAX_GRAVITY`.
    """
    x, y, z = vector(gravity, 3, "gravity", "m/s²")
    if max(abs(x), abs(y), abs(z)) > MAX_GRAVITY:
        raise SimulationError(
            f"gravity is {max(x, y, z, key=abs):g} m/s²; it must be at most {MAX_GRAVITY:g} m/s² (Earth: 0,0,-9.81)"
        )
    return x, y, z


def require_masses(kinematics: Kinematics, q: NDArray[np.float64], note: Callable[[str], None]) -> None:
    """Check that all bodies and joints are possible, and that everything that moves has mass.

    A link without mass between two joints moves with the mass of the links that it carries if the axes of the joints
    differ, which the mass matrix shows. Gazebo removes such links, so they are reported.

    Args:
        kinematics: model of the robot.
        q: initial configuration.
        note: reports a warning to the user.

    Raises:
        SimulationError: a mass, inertia, shape or limit is impossible, or a movable link has no mass; with its place.
    """
    require_valid(kinematics.robot)
    found = massless(kinematics.robot, floating=kinematics.floating_base)
    if not found:
        return
    if is_regular(kinematics, q):
        for link, _ in found:
            at = link.element.origin.position
            text = f"{at}: link `{link.name}` has no mass; it moves with its child links"
            note(Notice(text, position=at, cause="no mass"))
        return
    # Report the last link of a chain without mass, because the others carry it.
    link, joint = found[-1]
    why = f"joint `{joint.name}` moves it" if joint is not None else "the robot is free to move"
    advice = "or fix it to a link that has them" if joint is not None else "or fix the robot with --fixed-base"
    problem = "has no <inertial>" if link.inertial is None else "has no mass or no moment of inertia"
    message = f"link `{link.name}` {problem}, but {why}: add <inertial> with <mass> and <inertia>, {advice}"
    raise SimulationError(message, position=link.element.origin.position)


def is_regular(kinematics: Kinematics, q: NDArray[np.float64]) -> bool:
    """Return whether every joint moves a mass, and the mass matrix is invertible."""
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
