"""Lengths in the parameters of nodes that contradict the robot: wheels, their distances, and segments of limbs."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations
from math import hypot

from urdfkit.description.urdf.robot import Box, Cylinder, Joint, Link, Sphere
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_wheels import has_other_wheels
from urdfkit.lint.facts.control.yaml_tree import Node, number_of
from urdfkit.lint.facts.gazebo.drive_wheels import Wheel, collision_radii, wheel_of
from urdfkit.lint.facts.robot_parameters.groups import groups_of_nodes, tokens
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import shapes_of

Defects = Iterator[tuple[Source, Node, str]]

_TOLERANCE = 0.1
"""Accepted relative deviation of wheels, which are tuned on real robots."""

_TOLERANCE_OF_SEGMENTS = 0.02
"""Accepted relative deviation of the segments of a limb."""

_MOST_SKID = 2.0
"""Largest ratio of an effective track to the distance of the wheels, if wheels slip when the robot turns."""

_SIZE = r"(?:drive_|driven_)?wheel_(radius|diameter)"
_TRACK = r"track_?width|wheel_(?:track|separation|distance)|separation_between_wheels"
_BASE = r"wheel_?base|axle_(?:distance|separation)"
_SEGMENT = r"(thigh|shank|calf|tibia|femur|coxa|(?:upper|lower)_(?:arm|leg)|forearm|boom|stick|jib)_(?:length|len)"
"""Matches lengths of the segments of limbs; the length of a hand or gripper can be that to its tool frame."""

_WHEEL = frozenset(("wheel", "wheels", "tire", "tires", "tyre", "tyres"))

_STEEP = 0.7
"""Axes with a larger vertical part belong to steering wheels."""

_MEASURING = r"(?i)(?:dead|encoder|tracking|measuring|passive|odometry)[_ ]?wheel"
"""Matches the names of wheels that carry nothing, and that models often leave out."""

_UNITS = (100.0, 1000.0, 1.0 / 0.0254)
"""Factors of lengths in centimetres, millimetres and inches, as some drivers read them."""

_SIDES = frozenset(
    (
        *("fl", "fr", "rl", "rr", "bl", "br", "lf", "rf", "lr", "lh", "rh", "lb", "rb", "ml", "mr", "l", "r"),
        *("left", "right", "front", "rear", "back", "middle", "mid", "center", "centre", "link"),
    )
)
"""Words in the names of links that all segments of a limb may have."""


def wrong_lengths(model: Model) -> Defects:
    """Yield the lengths that contradict the robot, with a message."""
    wheels = [] if has_other_wheels(model) else _wheels(model)
    checked = [
        (source, group, tuple(_of_group(source, group, wheels, model))) for source, group in groups_of_nodes(model)
    ]
    for source, group, defects in checked:
        for value, message in defects if not _is_of_variant(source, group, checked) else ():
            yield source, value, message


def _of_group(source: Source, group: Node, wheels: list[Wheel], model: Model) -> Iterator[tuple[Node, str]]:
    for key, value in group.entries:
        number, name = number_of(value), key.text.rpartition(".")[2]
        if number is None or number <= 0.0:
            continue
        message = _of_wheels(name, number, wheels, model)
        if message and _has_other_wheels(source, group):
            continue
        message = message or _of_segment(name, number, model)
        if message:
            yield value, message


def _has_other_wheels(source: Source, group: Node) -> bool:
    """Return whether parameters belong to wheels that only measure, or to belts."""
    return any("track_length" in key.text for key, _ in group.entries) or bool(re.search(_MEASURING, source.text))


def _is_of_variant(
    source: Source, group: Node, checked: list[tuple[Source, Node, tuple[tuple[Node, str], ...]]]
) -> bool:
    """Return whether another file has the same parameters, of which all fit the robot."""
    keys = [key.text for key, _ in group.entries]
    return any(
        other is not source and not defects and [key.text for key, _ in others.entries] == keys
        for other, others, defects in checked
    )


def _wheels(model: Model) -> list[Wheel]:
    """Return the wheels of the robot that turn without limits, about axes that are not vertical."""
    found = [
        wheel_of(model, joint, None)
        for joint in model.robot.joints
        if joint.type == "continuous" and not _WHEEL.isdisjoint({*tokens(joint.name), *tokens(joint.child or "")})
    ]
    return [
        wheel
        for wheel in found
        if wheel is not None and "caster" not in tokens(wheel.joint.child or "") and abs(wheel.axis[2]) < _STEEP
    ]


def _of_wheels(name: str, number: float, wheels: list[Wheel], model: Model) -> str:
    """Return the message for a size or distance of wheels that none of the robot's wheels has; empty for others."""
    size = re.fullmatch(_SIZE, name)
    if size is not None:
        radii = [radius for wheel in wheels for radius in collision_radii(wheel, model) if radius > 0.0]
        factor = 2.0 if size[1] == "diameter" else 1.0
        sizes = [unit * factor * radius for radius in radii for unit in (1.0, *_UNITS)]
        if not radii or any(abs(number - each) <= _TOLERANCE * each for each in sizes):
            return ""
        return f"`{name}` is {number:g} m, but the {size[1]} of the wheels is {factor * radii[0]:.6g} m"
    is_track, is_base = (re.fullmatch(pattern, name) is not None for pattern in (_TRACK, _BASE))
    if len(wheels) < 2 or not (is_track or is_base):
        return ""
    sides, lengths = (
        sorted({round(abs(one.place[k] - other.place[k]), 6) for one, other in combinations(wheels, 2)} - {0.0})
        for k in (1, 0)
    )
    distances = sides if is_track else lengths
    most = _MOST_SKID if len(wheels) > 2 and is_track else 1.0 + _TOLERANCE
    accepted = [*distances, *(sides if is_base else ())]
    numbers = (number, *(number / unit for unit in _UNITS))
    if not distances or any(each / (1.0 + _TOLERANCE) <= one <= most * each for each in accepted for one in numbers):
        return ""
    return f"`{name}` is {number:g} m, but the wheels are {distances[-1]:.6g} m apart"


def _of_segment(name: str, number: float, model: Model) -> str:
    """Return the message for the length of a segment that all links of this name contradict; empty for others."""
    segment = re.fullmatch(_SEGMENT, name)
    if segment is None:
        return ""
    robot = model.robot
    moved = {joint.child for joint in robot.joints if joint.type != "fixed"}
    links = [
        link
        for link in robot.links
        if link.name in moved and [word for word in tokens(link.name) if word not in _SIDES] == [*tokens(segment[1])]
    ]
    children = [[joint for joint in robot.joints if joint.parent == link.name] for link in links]
    if not links or not all(children):
        return ""
    ends = [max(joints, key=lambda joint: (joint.type != "fixed", _distance(joint))) for joints in children]
    lengths = [_distance(joint) for joint in ends]
    if min(lengths) <= 0.0 or max(lengths) - min(lengths) > _TOLERANCE_OF_SEGMENTS * max(lengths):
        return ""
    accepted = [each for joints in children for joint in joints for each in _lengths(joint, model)]
    accepted += [size for link in links for size in _sizes(link)]
    numbers = (number, *(number / unit for unit in _UNITS))
    if any(abs(one - each) <= _TOLERANCE_OF_SEGMENTS * each for each in accepted for one in numbers):
        return ""
    return (
        f"`{name}` is {number:g} m, but joint `{ends[0].name}` is {lengths[0]:.4g} m from the origin of link"
        f" `{links[0].name}`"
    )


def _lengths(joint: Joint, model: Model) -> Iterator[float]:
    """Yield the distance of a joint from the origin of its parent [m]: in space, in a plane, along an axis.

    The last ones end at the surface of a round child, such as a foot.
    """
    x, y, z = joint.origin.xyz
    yield from (_distance(joint), hypot(x, y), hypot(y, z), hypot(x, z), abs(x), abs(y), abs(z))
    child = model.robot.link_by_name.get(joint.child or "")
    for shape in shapes_of(child) if child is not None else ():
        if isinstance(shape.geometry, (Cylinder, Sphere)):
            yield _distance(joint) + shape.geometry.radius


def _distance(joint: Joint) -> float:
    return hypot(*joint.origin.xyz)


def _sizes(link: Link) -> Iterator[float]:
    """Yield the sizes of the shapes of a link [m]."""
    for shape in shapes_of(link):
        if isinstance(shape.geometry, Box):
            yield from shape.geometry.size
        elif isinstance(shape.geometry, Cylinder):
            yield shape.geometry.length
        elif isinstance(shape.geometry, Sphere):
            yield 2.0 * shape.geometry.radius
