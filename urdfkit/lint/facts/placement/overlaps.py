"""Links that lie in other links of the robot with every joint at zero."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations
from math import dist

from urdfkit.description.urdf.robot import Joint, Mesh, Pose, Vector
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Span
from urdfkit.lint.facts.placement.solids import MovingBodies, Solid, diagonal, half_sizes, moving_bodies
from urdfkit.lint.facts.root_cause import parent_at
from urdfkit.lint.facts.twins import mirrored, side_of
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import shapes_of
from urdfkit.record import record

_MOST = 80
"""Largest number of moving bodies of a robot that is checked."""

_DEEP = 0.1
"""Smallest depth of the centre of a link in another one, as a part of half its smallest size."""

_THIN = 0.25
"""Smallest ratio of the smallest sizes of both links; rotors and other small parts are inside of housings."""

_SMALL = 0.02
"""Largest diagonal of a placeholder [m]."""

_BESIDE = 0.3
"""Smallest depth of a link in one on another branch, as a part of half the smallest size of both."""

_JOINTS = 4
"""Largest number of joints that overlap by one mistake, such as those of four flippers and their wheels."""

_MEETING = re.compile(
    r"(?i)finger|jaw|grip|hand|palm|claw|thumb|knuckle|clamp|pad|tip|door|eye|ear|lens|roller|link_?\d"
)
"""Names of parts that touch others, or that belong to closed chains."""

_SURFACE = 1e-4
"""Distance by which a shape that is inside of another one may stick out [m]."""

_DIGITS = 4
"""Decimal places of coordinates of shapes at one place."""


@record(eq=False)
class Overlap:
    """A link in another one.

    Attributes:
        joint: the joint that places it.
        place: the element with the wrong offset.
        message: the message of the finding.
        written: the place of the wrong parent link, if the joint has another parent link than its counterpart.
    """

    joint: Joint
    place: Element
    message: str
    written: Span | None = None


def overlaps(model: Model) -> Iterator[Overlap]:
    """Yield the links in other links; robots whose links have meshes or many shapes only where they have not."""
    bodies = moving_bodies(model, _MOST)
    if bodies is None:
        return
    for search in (_hidden, _coincident, _crossing, _beside):
        found = list(search(model, bodies))
        yield from found
        if found:
            return


def _hidden(model: Model, bodies: MovingBodies) -> Iterator[Overlap]:
    """Yield the joints whose loads, with everything that they carry, are completely inside of their parents."""
    for body, (carrier, joint) in bodies.carriers.items():
        around = bodies.solids.get(carrier, [])
        below = bodies.below(body) if around else []
        links = [link for name in below for link in bodies.links.get(name, ())]
        if any(isinstance(shape.geometry, Mesh) for link in links for shape in shapes_of(link)):
            continue
        solids = [solid for name in below for solid in bodies.solids.get(name, ()) if diagonal(solid.shape) > _SMALL]
        if solids and all(
            any(other.depth(point) >= -_SURFACE for other in around)
            for solid in solids
            for point in solid.points((-1, 1))
        ):
            message = f"link `{joint.child}` of joint `{joint.name}`, with all parts that it carries, is inside the "
            yield Overlap(joint, _origin(joint), f"{message}shape of `{around[0].link.name}`")


def _coincident(model: Model, bodies: MovingBodies) -> Iterator[Overlap]:
    """Yield a joint whose link has the same shape at the same place as a link that it is not attached to."""
    first: dict[object, tuple[str, Solid]] = {}
    found: set[object] = set()
    for body, solids in bodies.solids.items():
        if body not in bodies.carriers or len(solids) != 1 or diagonal(solids[0].shape) <= _SMALL:
            continue
        solid = solids[0]
        numbers = (*solid.at.translation, *(part for row in solid.at.rotation for part in row))
        key = (solid.shape, tuple(round(part, _DIGITS) + 0.0 for part in numbers))
        other, twin = first.setdefault(key, (body, solid))
        carrier = bodies.carriers[body][0]
        if other == body or carrier in (other, bodies.carriers[other][0]) or bodies.carriers[other][0] == body:
            continue  # Counterparts on one parent are compared by S909.
        wrong, right = (body, twin) if not _is_misplaced(other, twin.at.translation) else (other, solid)
        joint = next((each for _, each in bodies.above(wrong) if any(each.origin.xyz)), bodies.carriers[wrong][1])
        message = f"link `{solid.link.name if wrong == body else twin.link.name}` is in the same place as link "
        place = _origin(joint)
        if place.origin.position not in found:
            found.add(place.origin.position)
            yield Overlap(joint, place, f"{message}`{right.link.name}`")


def _is_misplaced(name: str, place: Vector) -> bool:
    """Return whether a link is at another end or side of the root link than its name states."""
    signs = {"rear": (0, -1.0), "back": (0, -1.0), "front": (0, 1.0), "left": (1, 1.0), "right": (1, -1.0)}
    words = [signs[word] for word in re.split(r"[^a-z]+", name.lower()) if word in signs]
    return any(place[axis] * sign < 0.0 for axis, sign in words)


def _crossing(model: Model, bodies: MovingBodies) -> Iterator[Overlap]:
    """Yield a joint or shape that places a link in another link that carries it over at least two joints."""
    found: set[object] = set()
    for body in bodies.carriers:
        inner = bodies.solids.get(body, ())
        joints: list[Joint] = []
        for carrier, joint in bodies.above(body):
            joints.append(joint)
            outer = bodies.solids.get(carrier, ())
            if not all(map(_includes_zero, joints)):
                break
            if len(joints) < 2 or len(inner) != 1 or len(outer) != 1 or all(one.type == "prismatic" for one in joints):
                continue
            if not _is_inside(inner[0], inner[0].at.translation, outer[0]):
                continue
            joint, place = _cause(inner[0], outer[0], joints, model)
            position = place.origin.position
            if position not in found:
                found.add(position)
                message = f"link `{inner[0].link.name}` is in link `{outer[0].link.name}`, which carries it over "
                yield Overlap(joint, place, f"{message}{len(joints)} joints")
            break


def _beside(model: Model, bodies: MovingBodies) -> Iterator[Overlap]:
    """Yield the joint that places a link in one on another branch of the robot, if that is the only such pair.

    Compares links that turn about their centres, such as wheels, and links with another parent than their counterpart.
    """
    single = {body: solids[0] for body, solids in bodies.solids.items() if len(solids) == 1 and body in bodies.carriers}
    single = {body: solid for body, solid in single.items() if diagonal(solid.shape) > _SMALL}
    chains = {body: {body, *(carrier for carrier, _ in bodies.above(body))} for body in single}
    found: list[tuple[str, str]] = []
    for body, other in combinations(single, 2):
        one, two = single[body], single[other]
        if body in chains[other] or other in chains[body] or _MEETING.search(f"{one.link.name} {two.link.name}"):
            continue
        if dist(one.at.translation, two.at.translation) > (diagonal(one.shape) + diagonal(two.shape)) / 2.0:
            continue
        thickness = min(one.thickness, two.thickness)
        pairs = ((one, two), (two, one))
        if not any(
            outer.depth(point) > _BESIDE * thickness for inner, outer in pairs for point in _inner_points(inner)
        ):
            continue
        ends = [bodies.carriers[name][1] for name in (body, other)]
        are_centred = all(
            _is_centred(single[name], joint, model) for name, joint in zip((body, other), ends, strict=True)
        )
        if not are_centred and not any(_has_other_parent(joint, model) for joint in ends):
            continue  # Rods and cylinders of closed chains meet in parts on another branch.
        joints = [joint for name in (body, other) for joint in (bodies.carriers[name][1], *_joints_above(name, bodies))]
        if all(map(_includes_zero, joints)):
            found.append((body, other))
    positions = {_origin(bodies.carriers[body][1]).origin.position for pair in found for body in pair}
    if not found or len(positions) > _JOINTS:
        return
    body, other = found[0]
    places = [(one, bodies.carriers[one][1]) for one in (body, other)]
    moved = next((one for one, joint in places if _has_other_parent(joint, model)), None)
    is_first = moved == body or (moved is None and _is_misplaced(body, single[body].at.translation))
    wrong, right = (body, other) if is_first else (other, body)
    joint = bodies.carriers[wrong][1]
    written = parent_at(model, joint) if moved is not None else None
    message = f"link `{single[wrong].link.name}` is in link `{single[right].link.name}`, on another branch of the robot"
    yield Overlap(joint, _origin(joint), message, written)


def _is_centred(solid: Solid, joint: Joint, model: Model) -> bool:
    """Return whether a joint is in the middle of the shape of its load, as that of a wheel is."""
    frame = model.frames.get(joint.child or "")
    return frame is not None and dist(frame.translation, solid.at.translation) <= _DEEP * diagonal(solid.shape)


def _has_other_parent(joint: Joint, model: Model) -> bool:
    """Return whether the counterpart of a joint on the other side has another parent link, of the middle."""
    joints = model.robot.joint_by_name
    other = next((joints[name] for name in mirrored(joint.name) if name in joints), None)
    parent = joint.parent or ""
    return other is not None and other.parent != parent and side_of(parent) == side_of(other.parent or "") == ""


def _joints_above(body: str, bodies: MovingBodies) -> Iterator[Joint]:
    yield from (joint for _, joint in bodies.above(body))


def _inner_points(solid: Solid) -> Iterator[Vector]:
    return (point for point in solid.points((-0.9, 0.0, 0.9)) if solid.depth(point) >= 0.0)


def _is_inside(inner: Solid, centre: Vector, outer: Solid) -> bool:
    is_thin = inner.thickness < _THIN * outer.thickness
    return not is_thin and diagonal(inner.shape) > _SMALL and outer.depth(centre) > _DEEP * outer.thickness


def _includes_zero(joint: Joint) -> bool:
    low, high = (joint.limit.lower, joint.limit.upper) if joint.limit is not None else (None, None)
    return low is None or high is None or low <= 0.0 <= high


def _cause(inner: Solid, outer: Solid, joints: list[Joint], model: Model) -> tuple[Joint, Element]:
    """Return the joint, and the origin of the shape whose sign is wrong or of the joint farthest from its parent."""
    frame, offset = model.frames[inner.link.name], inner.pose.xyz
    axis = max(range(3), key=lambda k: abs(offset[k]))
    x, y, z = (-part if k == axis else part for k, part in enumerate(offset))
    origin = shapes_of(inner.link)[0].element.find("origin")
    if origin is not None:
        mirrored = frame.moved(Pose((x, y, z), inner.pose.rpy)).translation
        if not _is_inside(inner, mirrored, outer) and abs(offset[axis]) > half_sizes(inner.shape)[axis]:
            return joints[0], origin
    turning = [joint for joint in reversed(joints) if joint.type != "prismatic"]  # A telescope is inside of itself.
    joint = max(turning, key=lambda each: _distance_from_surface(each, model))
    return joint, _origin(joint)


def _distance_from_surface(joint: Joint, model: Model) -> float:
    """Return the distance of a joint from the surface of the box around its parent link [m]."""
    from urdfkit.lint.facts.placement.joint_places import depth

    parent = model.extents.get(joint.parent or "")
    return abs(depth(joint.origin.xyz, parent)) if parent is not None else 0.0


def _origin(joint: Joint) -> Element:
    return joint.element.find("origin") or joint.element
