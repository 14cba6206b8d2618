"""Pairs of links that are not adjacent, and whose collisions an SRDF must disable."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from urdfkit.description.urdf.robot import Joint
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.placement.solids import MovingBodies, Solid, moving_bodies
from urdfkit.lint.facts.twins import mirrored
from urdfkit.lint.model.model import Model

_MOST = 40
"""Largest number of links, and of moving joints, that are compared with each other."""

_DEPTH = 0.002
"""Smallest depth of an overlap [m]."""

_FEWEST = 3
"""Smallest number of pairs whose counterparts on the other side are disabled, of which one stands out."""

Pairs = dict[frozenset[str], Element]
Missing = tuple[tuple[str, str], Element, str]
"""Names of two links, the most similar element of the SRDF, and the reason."""


def overlapping(model: Model, disabled: Pairs) -> Iterator[Missing]:
    """Yield the pairs of links that overlap at zero, and that fixed joints or the stages of a telescope connect."""
    bodies = moving_bodies(model, _MOST)
    if bodies is None:
        return
    mentioned = {link for pair in disabled for link in pair}
    adjacent = {frozenset((joint.parent, joint.child)) for joint in model.robot.joints}
    for names in _groups(model, bodies):
        solids: dict[str, list[Solid]] = {}
        for name in names:
            for solid in bodies.solids.get(name, ()):
                if solid.link.collisions and solid.link.name in mentioned:
                    solids.setdefault(solid.link.name, []).append(solid)
        for one, other in combinations(solids, 2) if len(solids) <= _MOST else ():
            pair = frozenset((one, other))
            if pair not in disabled and pair not in adjacent and _overlap(solids[one], solids[other]):
                near = [element for links, element in disabled.items() if one in links][-1]
                yield (one, other), near, "overlap with every joint at zero"


def unlike_other_side(model: Model, disabled: Pairs) -> Iterator[Missing]:
    """Yield the only pair of links that is not disabled although its counterpart on the other side is.

    Compares pairs of one limb with one link between them. Whether links farther apart can touch, the Setup Assistant
    finds by sampling, with different results for the two sides.
    """
    parents = {joint.child: joint.parent for joint in model.robot.joints}
    solid = {link.name for link in model.robot.links if link.collisions}
    missing: list[Missing] = []
    equal, are_near = 0, False
    for pair, element in disabled.items():
        if len(pair) != 2 or not pair <= solid:
            continue
        sides = [next((name for name in mirrored(link) if name in solid), link) for link in sorted(pair)]
        counterpart = frozenset(sides)
        if counterpart == pair or len(counterpart) != 2:
            continue
        if counterpart in disabled:
            equal += 1
        else:
            are_near = not counterpart & pair and any(parents.get(parents.get(link)) in pair for link in pair)
            missing.append(((sides[0], sides[1]), element, "are the counterparts of a pair that the SRDF disables"))
    if len(missing) == 1 and are_near and equal >= 2 * _FEWEST:
        yield missing[0]


def _groups(model: Model, bodies: MovingBodies) -> list[list[str]]:
    """Return the bodies that prismatic joints with zero in their ranges connect, each a list."""
    group_of: dict[str, list[str]] = {body: [body] for body in bodies.links}
    for body, (carrier, joint) in bodies.carriers.items():
        if joint.type == "prismatic" and _includes_zero(joint) and carrier in group_of and body in group_of:
            one, other = group_of[carrier], group_of[body]
            if one is not other:
                one += other
                group_of |= dict.fromkeys(other, one)
    return list({id(group): group for group in group_of.values()}.values())


def _includes_zero(joint: Joint) -> bool:
    return joint.limit is not None and (joint.limit.lower or 0.0) <= 0.0 <= (joint.limit.upper or 0.0)


def _overlap(first: list[Solid], second: list[Solid]) -> bool:
    """Return whether a point on the surface, an edge or the axis of one solid is inside of another one."""
    for one in first:
        for other in second:
            for inner, outer in ((one, other), (other, one)):
                if any(
                    outer.depth(point) > _DEPTH
                    for point in inner.points((-0.9, 0.0, 0.9))
                    if inner.depth(point) > _DEPTH
                ):
                    return True
    return False
