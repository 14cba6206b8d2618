"""Links that joints must have meant whose child is no link: one of nearly the name, sooner one without a parent."""

from __future__ import annotations

from urdfkit.lint.edits import meant, nearest

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Robot

_LIKENESS = 0.6
"""How near the name of a link without parent has to be: `amr` for `arm`."""


def meant_child(robot: Robot, name: str) -> tuple[str | None, str]:
    """Return the link that the child of a joint must have meant, None where none is, and ``; did you mean …``."""
    near, hint = meant(name, robot.link_by_name)
    if near is None:
        near = nearest(name, (link.name for link in robot.roots()), likeness=_LIKENESS)
        hint = f"; did you mean `{near}`?" if near is not None else ""
    return near, hint
