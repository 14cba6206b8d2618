"""Likely corrections of undefined child links: links with a similar name, preferably without parent."""

from itertools import islice

from urdfkit.description.urdf.queries import dangling
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import nearest

_CUTOFF = 0.6
"""Minimum similarity to the name of a link without parent: `amr` for `arm`."""


def meant_child(robot: Robot, name: str) -> str | None:
    """Return the link most similar to an undefined child; None without a similar one."""
    return nearest(name, robot.link_by_name, cutoff=0.7) or nearest(name, robot.root_by_name, cutoff=_CUTOFF)


def likely_children(robot: Robot, *, most: int | None = None) -> dict[str, str]:
    """Return undefined child → its likely correction.

    Args:
        robot: the robot.
        most: maximum number of undefined children to correct, each of which costs a search; all without a number.
    """
    names = (name for _, name, _ in islice(dangling(robot, "child"), most))
    return {name: meant for name in names if (meant := meant_child(robot, name)) is not None}
