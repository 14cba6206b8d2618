"""What is simulated: a MODEL, loaded, and whether it can move."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from urdfkit.description import Robot, load
from urdfkit.description.masses import massless
from urdfkit.errors import SimulationError
from urdfkit.resources import find_model


def load_robot(model: str | Path, package_path: Sequence[str | Path] = ()) -> Robot:
    """Load a robot by file, package folder or name.

    Raises:
        UrdfkitError: there is none, or it is broken; says why and where.
    """
    found = find_model([str(model)], package_path=[str(folder) for folder in package_path])
    return load(found.path, arguments=found.arguments, package_path=found.package_path)


def require_masses(robot: Robot, *, floating: bool) -> None:
    """Check that everything that moves has a mass.

    Args:
        robot: the robot as written.
        floating: whether the root link moves too.

    Raises:
        SimulationError: a link must move but has no mass, with its place and what to write.
    """
    for link, joint in massless(robot, floating=floating):
        why = f"joint `{joint.name}` moves it" if joint is not None else "the robot is free to move"
        problem = "has no <inertial>" if link.inertial is None else "has no mass greater than zero"
        raise SimulationError(
            f"link `{link.name}` {problem}, but {why}: write <inertial> with <mass> and <inertia> into it, "
            "or fix it to a link that has them",
            position=link.element.origin.position,
        )
