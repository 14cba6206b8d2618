"""Shapes of a left and a right link with equal offsets, although the joints below these links are mirrored."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.urdf.robot import Link, Vector
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.twins import mirrored
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import shapes_of

_LEAST = 0.1
"""Smallest offset of a shape, as a part of the offset of the joint below, that has a side."""


def unmirrored_shapes(model: Model) -> Iterator[tuple[Link, Element, str]]:
    """Yield a link, the origin of its first shape on the wrong side, and the message."""
    links, frames = model.robot.link_by_name, model.frames
    for link in model.robot.links:
        other = next((links[name] for name in mirrored(link.name) if name in links), None)
        if other is None or link.name not in frames or other.name not in frames:
            continue
        if frames[link.name].rotation != frames[other.name].rotation:
            continue
        for k, own, opposite in _flipped(link, other, model):
            pairs = list(zip(_places(link), _places(other), strict=False))
            wrong = [
                (mine, place[k])
                for (mine, place), (_, place_of_other) in pairs
                if place[k] == place_of_other[k] and abs(place[k]) >= _LEAST * abs(own) and place[k] * own < 0.0
            ]
            if len(_places(link)) == len(_places(other)) and wrong and own * opposite < 0.0:
                element, value = wrong[0]
                names = f"`{other.name}` and `{link.name}`"
                where = f"{'xyz'[k]} is {value:g} m for both"
                yield link, element, f"shapes of links {names} are not mirrored, unlike the joints below: {where}"
                break


def _flipped(link: Link, other: Link, model: Model) -> Iterator[tuple[int, float, float]]:
    """Yield the coordinates with opposite signs in the joints below two links: axis, own value, that of the other."""
    opposite = {joint.name: joint for joint in model.robot.children_of.get(other.name, ())}
    for joint in model.robot.children_of.get(link.name, ()):
        twin = next((opposite[name] for name in mirrored(joint.name) if name in opposite), None)
        for k in range(3) if twin is not None and twin.type == joint.type else ():
            own, of_twin = joint.origin.xyz[k], twin.origin.xyz[k] if twin is not None else 0.0
            if own == -of_twin != 0.0:
                yield k, own, of_twin


def _places(link: Link) -> list[tuple[Element, Vector]]:
    return [(shape.element.find("origin") or shape.element, shape.origin.xyz) for shape in shapes_of(link)]
