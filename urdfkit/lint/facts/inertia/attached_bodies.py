"""Bodies that fixed joints attach to a heavier one: their mass and inertia hardly change its motion."""

from urdfkit.description.urdf.robot import Link
from urdfkit.lint.facts.inertia.principal_moments import principal_moments
from urdfkit.lint.model.model import Model

NEGLIGIBLE = 0.05
"""Largest mass and moment of a negligible body, relative to those of the links that it is fixed to."""


def is_negligible(model: Model, link: Link) -> bool:
    """Return whether the mass and the inertia of a link are negligible: fixed joints attach it to a heavier parent.

    Args:
        model: the linted model.
        link: a link of the model.
    """
    return is_fixed(model, link) and is_small(model, link)


def is_small(model: Model, link: Link) -> bool:
    """Return whether fixed joints attach a link to one with much more mass and inertia, in either direction."""
    attached = _attached(model, link)
    others = [model.robot.link_by_name[name] for name in attached - {link.name} if name in model.robot.link_by_name]
    return _mass(link) <= NEGLIGIBLE * max(map(_mass, others), default=0.0) and _moment(link) <= NEGLIGIBLE * max(
        map(_moment, others), default=0.0
    )


def is_fixed(model: Model, link: Link) -> bool:
    """Return whether a fixed joint attaches a link to its parent, so that Gazebo and MuJoCo merge both."""
    return any(joint.type == "fixed" and joint.child == link.name for joint in model.robot.joints)


def is_fixed_to_world(model: Model, link: Link) -> bool:
    """Return whether fixed joints attach a link to the link ``world``, so that its inertia has no effect."""
    return "world" in _attached(model, link)


def _attached(model: Model, link: Link) -> set[str]:
    """Return the names of a link and of all links that fixed joints attach to it."""
    neighbours: dict[str, list[str]] = {}
    for joint in model.robot.joints:
        if joint.type == "fixed" and joint.parent and joint.child:
            neighbours.setdefault(joint.parent, []).append(joint.child)
            neighbours.setdefault(joint.child, []).append(joint.parent)
    attached = {link.name}
    pending = [link.name]
    while pending:
        fresh = set(neighbours.get(pending.pop(), ())) - attached
        attached |= fresh
        pending += fresh
    return attached


def _mass(link: Link) -> float:
    return (link.inertial.mass or 0.0) if link.inertial is not None else 0.0


def _moment(link: Link) -> float:
    return max((max(map(abs, moments)) for moments, _ in principal_moments(link)), default=0.0)
