"""Links that fixed joints attach to a heavier one: their mass and inertia hardly change its motion."""

from functools import cached_property

from urdfkit.description.urdf.principal_moments import principal_moments
from urdfkit.description.urdf.robot import Link, Robot

NEGLIGIBLE = 0.05
"""Largest mass and moment of a negligible link, relative to those of the links that it is fixed to."""

_Largest = tuple[tuple[float, float], tuple[float, float]]
"""The two largest masses [kg] and the two largest moments [kg·m²] of the links of a body."""


class AttachedBodies:
    """The bodies of a robot: links that fixed joints attach to each other.

    Args:
        robot: the robot; nothing is computed before the first query.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot

    def body_of(self, name: str) -> str:
        """Return the name of the link that represents a body: the links that fixed joints connect with a link."""
        return self._bodies.get(name, name)

    def is_negligible(self, link: Link) -> bool:
        """Return whether the mass and the inertia of a link are negligible: it is fixed to a heavier parent."""
        return self.is_fixed(link) and self.is_small(link)

    def is_small(self, link: Link) -> bool:
        """Return whether fixed joints attach a link to one with much more mass and inertia, in either direction."""
        own = _mass(link), _moment(link)
        largest = self._largest[self.body_of(link.name)]
        others = [pair[1] if pair[0] == value else pair[0] for pair, value in zip(largest, own, strict=True)]
        return all(value <= NEGLIGIBLE * other for value, other in zip(own, others, strict=True))

    def is_fixed(self, link: Link) -> bool:
        """Return whether a fixed joint attaches a link to its parent, so that Gazebo and MuJoCo merge both."""
        return any(joint.type == "fixed" for joint in self._robot.parents_of.get(link.name, ()))

    def is_fixed_to_world(self, link: Link) -> bool:
        """Return whether fixed joints attach a link to the link ``world``, so that its inertia has no effect."""
        return self.body_of(link.name) == self.body_of("world")

    @cached_property
    def _bodies(self) -> dict[str, str]:
        """Name of a link → name of a link that represents its body; without links that no fixed joint attaches."""
        neighbours: dict[str, list[str]] = {}
        for joint in self._robot.joints:
            if joint.type == "fixed" and joint.parent and joint.child:
                neighbours.setdefault(joint.parent, []).append(joint.child)
                neighbours.setdefault(joint.child, []).append(joint.parent)
        found: dict[str, str] = {}
        for first in neighbours:
            pending = [first]
            while pending:
                name = pending.pop()
                if name not in found:
                    found[name] = first
                    pending += neighbours[name]
        return found

    @cached_property
    def _largest(self) -> dict[str, _Largest]:
        """Name of the link that represents a body → its two largest masses and moments."""
        found: dict[str, _Largest] = {}
        for link in self._robot.link_by_name_in_order():
            body = self.body_of(link.name)
            masses, moments = found.get(body, ((0.0, 0.0), (0.0, 0.0)))
            found[body] = _two_largest(*masses, _mass(link)), _two_largest(*moments, _moment(link))
        return found


def _two_largest(*values: float) -> tuple[float, float]:
    first, second, *_ = sorted(values, reverse=True)
    return first, second


def _mass(link: Link) -> float:
    return (link.inertial.mass or 0.0) if link.inertial is not None else 0.0


def _moment(link: Link) -> float:
    return max((max(map(abs, moments)) for moments, _ in principal_moments(link)), default=0.0)
