"""S910 fingers-not-opposed."""

import re
from collections.abc import Iterator
from math import dist, hypot

from urdfkit.description.urdf.geometry import rotate, rotation_of, unit
from urdfkit.description.urdf.robot import Joint, Pose, Vector
from urdfkit.lint.facts.twins import are_alike, twins
from urdfkit.lint.model.placement import Frame
from urdfkit.lint.rule import Findings, Model, RobotRule

_FINGER = re.compile(r"finger|grip|jaw|claw|thumb", re.IGNORECASE)
_FIRST = {"1": "2", "a": "b", "A": "B"}
_NUMBER = re.compile(r"(?<!\d)1(?!\d)|(?<![A-Za-z])[aA](?![A-Za-z])")
_ALONG = 0.3
"""Cosine of the angle from which fingers that move along a line do not approach each other."""


class FingersNotOpposed(RobotRule):
    """Two fingers of a gripper move together, past each other, or at right angles to the line between them.

    ## What it does
    Compares two ``prismatic`` joints of one parent link with ``finger``, ``grip``, ``jaw`` or ``claw`` in their names.
    The joints are compared if one mimics the other, or if their names differ only in a side, in the numbers 1 and 2, or
    in the letters a and b. Between their limits, the distance between the fingers must change, the fingers must not
    pass through each other, and fingers of the same shape must not be in the same place. The rule treats a missing mesh
    as a point.

    ## Why is this bad?
    The gripper does not close. The usual cause is the sign of an axis, or of the multiplier of ``<mimic>``.

    ## Example
    ```diff
     <robot name="gripper">
       <link name="palm"/>
       <link name="left_finger"/>
       <link name="right_finger"/>
       <joint name="left_finger_joint" type="prismatic">
         <parent link="palm"/><child link="left_finger"/>
         <origin xyz="0 0.01 0.1"/>
         <axis xyz="0 1 0"/>
         <limit lower="0" upper="0.03" effort="20" velocity="0.2"/>
       </joint>
       <joint name="right_finger_joint" type="prismatic">
         <parent link="palm"/><child link="right_finger"/>
         <origin xyz="0 -0.01 0.1"/>
    -    <axis xyz="0 1 0"/>
    +    <axis xyz="0 -1 0"/>
         <limit lower="0" upper="0.03" effort="20" velocity="0.2"/>
         <mimic joint="left_finger_joint"/>
       </joint>
     </robot>
    ```
    """

    code = "S910"
    name = "fingers-not-opposed"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each pair of fingers that does not open and close."""
        if model.is_damaged:
            return
        for first, second in _pairs(model):
            found = _defect(first, second, model)
            if found is not None:
                message, help = found
                place = second.element.find("axis") or second.element
                links = (each for each in (second.parent, first.child, second.child) if each is not None)
                names = (first.name, *links)
                yield self.at(model, place, message, attribute="xyz", joint=second.name, help=help, names=names)


def _pairs(model: Model) -> Iterator[tuple[Joint, Joint]]:
    """Yield the pairs of fingers of one parent; of a joint that mimics another one, the other one first."""
    joints = model.robot.joint_by_name
    found: dict[frozenset[str], tuple[Joint, Joint]] = {}
    numbered = [
        (each, joints.get(_NUMBER.sub(lambda found: _FIRST[found[0]], each.name))) for each in model.robot.joints
    ]
    for second in model.robot.joints:
        first = joints.get(second.mimic.joint or "") if second.mimic is not None else None
        if first is not None and first is not second:
            found.setdefault(frozenset((first.name, second.name)), (first, second))
    sides = [(pair.first, pair.second) for pair in twins(model) if pair.are_sides]
    for one, other in (*sides, *numbered):
        if other is not None and other is not one:
            found.setdefault(frozenset((one.name, other.name)), (one, other))
    for first, second in found.values():
        if (
            first.type == second.type == "prismatic"
            and first.parent == second.parent
            and _FINGER.search(f"{first.name} {first.child}")
            and _FINGER.search(f"{second.name} {second.child}")
        ):
            yield first, second


def _defect(first: Joint, second: Joint, model: Model) -> tuple[str, str] | None:
    """Return the message and help for a pair of fingers; None if their distance changes."""
    mimic = second.mimic if second.mimic is not None and second.mimic.joint == first.name else None
    if mimic is None and (first.mimic is not None) != (second.mimic is not None):
        return None  # Each follows another joint.
    own, others = _ends(first), _ends(second)
    if own is None or others is None:
        return None
    (low, high), (least, most) = own, others
    if mimic is not None:
        least, most = (mimic.multiplier * value + mimic.offset for value in (low, high))
    elif (low + high) * (least + most) < 0.0:
        least, most = most, least  # One of them opens towards its lower limit.
    directions = [_turned(joint, unit(joint.axis)) for joint in (first, second)]
    places = [_centre(joint, model) for joint in (first, second)]
    if directions[0] is None or directions[1] is None:
        return None
    names = f"`{first.name}` and `{second.name}`"
    starts = [_moved(places[k], directions[k], value) for k, value in enumerate((low, least))]
    stops = [_moved(places[k], directions[k], value) for k, value in enumerate((high, most))]
    before, after = (tuple(a - b for a, b in zip(*both, strict=True)) for both in (starts, stops))
    travel, change = abs(high - low), dist(before, after)
    if travel <= 0.0:
        return None
    sign = "<mimic>" if mimic is not None and mimic.multiplier < 0.0 else "one of the axes"
    if change < 0.1 * travel:
        return f"fingers {names} move in the same direction, so the gripper does not close", f"check the sign of {sign}"
    nearest = min((before, after), key=lambda each: hypot(*each))
    if _are_alike(first, second, model) and hypot(*nearest) < 0.05 * _length(first, model):
        return f"fingers {names} are in the same place when they are closed", "check the signs of their origins"
    if max(hypot(*before), hypot(*after)) <= 0.05 * travel or first.origin.xyz == second.origin.xyz:
        return None
    along = [sum((b - a) * c for a, b, c in zip(before, after, each, strict=True)) for each in (before, after)]
    if abs(along[(before, after).index(nearest)]) < _ALONG * change * hypot(*nearest):
        return f"fingers {names} do not approach each other", "move them along the line between them"
    if along[0] < 0.0 < along[1] and min(hypot(*before), hypot(*after)) > 0.1 * travel:
        return f"fingers {names} pass through each other", f"check the sign of {sign} and the limits"
    return None


def _are_alike(first: Joint, second: Joint, model: Model) -> bool:
    links = [model.robot.link_by_name.get(joint.child or "") for joint in (first, second)]
    return links[0] is not None and links[1] is not None and are_alike(links[0], links[1], model)


def _length(joint: Joint, model: Model) -> float:
    extent = model.extents.get(joint.child or "")
    return extent.diagonal if extent is not None else 0.0


def _ends(joint: Joint) -> tuple[float, float] | None:
    limit = joint.limit
    return None if limit is None else (limit.lower or 0.0, limit.upper or 0.0)


def _turned(joint: Joint, axis: Vector | None) -> Vector | None:
    return None if axis is None else rotate(rotation_of(joint.origin.rpy), axis)


def _moved(place: Vector, direction: Vector | None, value: float) -> Vector:
    x, y, z = (a + value * b for a, b in zip(place, direction or (0.0, 0.0, 0.0), strict=True))
    return x, y, z


def _centre(joint: Joint, model: Model) -> Vector:
    """Return the centre of the shapes of a finger, or its origin, in the frame of its parent link."""
    extent = model.extents.get(joint.child or "")
    x, y, z = (
        ((a + b) / 2.0 for a, b in zip(extent.low, extent.high, strict=True)) if extent is not None else (0.0,) * 3
    )
    return Frame().moved(joint.origin).moved(Pose((x, y, z))).translation
