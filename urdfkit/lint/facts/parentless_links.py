"""Suggested child links for joints whose child is undefined: links with a similar name, preferably without parent."""

from urdfkit.description.urdf.robot import Robot
from urdfkit.lint.fix_builders import meant, nearest

_CUTOFF = 0.6
"""Minimum similarity to the name of a link without parent: `amr` for `arm`."""


def meant_child(robot: Robot, name: str) -> tuple[str | None, str]:
    """Return the link most similar to an undefined child (or None), and ``; did you mean …``."""
    near, hint = meant(name, robot.link_by_name)
    if near is None:
        near = nearest(name, robot.root_by_name, cutoff=_CUTOFF)
        hint = f"; did you mean `{near}`?" if near is not None else ""
    return near, hint
