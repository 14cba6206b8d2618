"""The one joint that breaks the symmetry of two chains, such as the legs or arms of a robot."""

import re
from collections.abc import Callable
from math import hypot

from urdfkit.description.urdf.geometry import rotate
from urdfkit.description.urdf.robot import Joint, Vector
from urdfkit.lint.facts.placement.joint_axes import axis_in_root
from urdfkit.lint.facts.twins import mirrored, side_of
from urdfkit.lint.model.model import Model

_FEWEST = 3
"""Number of pairs that are mirror images, from which on the robot counts as symmetric."""

_SAME = 0.01
"""Largest difference of mirrored vectors, as a fraction of their length."""

_UNLIKE = 0.1
"""Smallest difference of vectors that are not mirrored."""

_UNLIKE_AXES = 0.5
"""The same for axes."""

_SMALLEST = 2e-3
"""Length from which on an offset is compared [m]."""

_ENDS = r"(?i)left|right|front|rear|back|hind|(?<![a-z])(?:[flrbh]{1,2})(?![a-z])"
"""Words for a side or an end."""

_KIND = re.compile("roll|pitch|yaw")
"""Words for the axis of a joint."""

Pair = tuple[Joint, Joint]


def asymmetric_offset(model: Model) -> tuple[Joint, Joint, int] | None:
    """Return the misplaced joint, its counterpart and the wrong coordinate of the only unmirrored pair of joints."""
    found = _only_unlike(model, lambda joint: _offset(joint, joint.origin.xyz, model))
    if found is None:
        return None
    (first, second), flip = found
    if first.parent == second.parent:
        return None
    k = next((k for k in range(3) if _matches(model, first, _flipped(second.origin.xyz, k), second, flip)), None)
    if k is None:
        is_last = not any(each.parent == first.child and _has_twin(each, model) for each in model.robot.joints)
        if is_last and all(each in (first, second) for each in _family(first, model)):
            return None  # two hands or tools can differ, unlike the feet of four legs
        differences = [abs(abs(a) - abs(b)) for a, b in zip(first.origin.xyz, second.origin.xyz, strict=True)]
        k = differences.index(max(differences))
    votes = [_votes(joint, k, model) for joint in (first, second)]
    offsets = [_offset(joint, joint.origin.xyz, model) or (0.0, 0.0, 0.0) for joint in (first, second)]
    if votes[0] == votes[1] and offsets[0][flip] * offsets[1][flip] > _SMALLEST**2:
        left = offsets[0][flip] * _direction_of_left(flip, model)
        votes = [left, -left]
    elif votes[0] == votes[1]:
        votes = [_along_parent(joint, model) for joint in (first, second)]
    return (first, second, k) if votes[0] < votes[1] else (second, first, k)


def asymmetric_axis(model: Model) -> Pair | None:
    """Return the joint whose axis is not that of its counterpart, and the counterpart, if all others are mirrored."""
    found = _only_unlike(model, lambda joint: axis_in_root(joint, model) if joint.is_movable else None, is_line=True)
    if found is None:
        return None
    first, second = found[0]
    return (first, second) if odd_axis(first, second, model) is first else (second, first)


def odd_axis(first: Joint, second: Joint, model: Model) -> Joint:
    """Return the one of two joints whose axis fewer joints of the same kind have; the second one if both are alike."""
    votes = [sum(each.axis == joint.axis for each in _family(joint, model)) for joint in (first, second)]
    if votes[0] == votes[1] and (kind := _KIND.search(first.name)):
        alike = [each for each in model.robot.joints if each not in (first, second) and kind[0] in each.name]
        votes = [sum(_is_line(each.axis, joint.axis) for each in alike) for joint in (first, second)]
    return first if votes[0] < votes[1] else second


def _only_unlike(
    model: Model, vector: Callable[[Joint], Vector | None], *, is_line: bool = False
) -> tuple[Pair, int] | None:
    """Return the only pair whose vectors are not mirrored, and the coordinate of the mirror."""
    joints = model.robot.joint_by_name
    vectors: list[tuple[Pair, Vector, Vector]] = []
    for joint in joints.values():
        name = next((name for name in mirrored(joint.name) if name in joints), None)
        if name is None or side_of(joint.name) != "left" or joints[name].type != joint.type:
            continue
        both = vector(joint), vector(joints[name])
        if both[0] is not None and both[1] is not None and max(hypot(*each) for each in both if each) > _SMALLEST:
            vectors.append(((joint, joints[name]), both[0], both[1]))
    for k in (1, 0):
        least = _UNLIKE_AXES if is_line else _UNLIKE
        unlike = [pair for pair, a, b in vectors if _difference(_flipped(a, k), b, is_line=is_line) > least]
        same = [pair for pair, a, b in vectors if _difference(_flipped(a, k), b, is_line=is_line) < _SAME]
        telling = [pair for pair, a, b in vectors if pair in same and (is_line or abs(a[k]) > _SMALLEST)]
        if len(unlike) == 1 and len(telling) >= _FEWEST and len(same) + 1 == len(vectors):
            return unlike[0], k
        if not unlike:
            break
    return None


def _offset(joint: Joint, xyz: Vector, model: Model) -> Vector | None:
    """Return an offset of a joint in the root frame, with every joint at zero."""
    frame = model.frames.get(joint.parent or "")
    return rotate(frame.rotation, xyz) if frame is not None else None


def _has_twin(joint: Joint, model: Model) -> bool:
    return any(name in model.robot.joint_by_name for name in mirrored(joint.name))


def _matches(model: Model, first: Joint, xyz: Vector, second: Joint, flip: int) -> bool:
    a, b = _offset(first, first.origin.xyz, model), _offset(second, xyz, model)
    return a is not None and b is not None and _difference(_flipped(a, flip), b) < _SAME


def _flipped(vector: Vector, k: int) -> Vector:
    x, y, z = (-value if i == k else value for i, value in enumerate(vector))
    return x, y, z


def _difference(first: Vector, second: Vector, *, is_line: bool = False) -> float:
    """Return the distance of two vectors as a fraction of the longer one; directions do not count for lines."""
    length = max(hypot(*first), hypot(*second))
    distances = [hypot(*(a - sign * b for a, b in zip(first, second, strict=True))) for sign in (1, -1)]
    return (min(distances) if is_line else distances[0]) / length


def _family(joint: Joint, model: Model) -> list[Joint]:
    """Return the joints whose names differ in sides and ends only."""
    key = re.sub(_ENDS, "*", joint.name)
    return [each for each in model.robot.joints if each is not joint and re.sub(_ENDS, "*", each.name) == key]


def _direction_of_left(flip: int, model: Model) -> float:
    """Return the sum of the signs of the offsets of all left joints in the direction between the sides."""
    left = (joint for joint in model.robot.joints if side_of(joint.name) == "left")
    offsets = (offset[flip] for joint in left if (offset := _offset(joint, joint.origin.xyz, model)) is not None)
    return sum((offset > _SMALLEST) - (offset < -_SMALLEST) for offset in offsets)


def _is_line(first: Vector, second: Vector) -> bool:
    return max(abs(abs(a) - abs(b)) for a, b in zip(first, second, strict=True)) < _SAME


def _along_parent(joint: Joint, model: Model) -> float:
    """Return the distance of a joint in the direction of the centre of mass of its parent, where it usually is."""
    parent = model.robot.link_by_name.get(joint.parent or "")
    centre = parent.inertial.origin.xyz if parent is not None and parent.inertial is not None else (0.0, 0.0, 0.0)
    return sum(a * b for a, b in zip(centre, joint.origin.xyz, strict=True))


def _votes(joint: Joint, k: int, model: Model) -> float:
    """Return how many joints like this one confirm its coordinate: its magnitude, and its sign on the same side."""
    value = joint.origin.xyz[k]
    family = _family(joint, model)
    signs = sum(each.origin.xyz[k] == value for each in family if side_of(each.name) == side_of(joint.name))
    return signs + sum(abs(each.origin.xyz[k]) == abs(value) for each in family)
