"""J424 slide-off-its-parent."""

from math import hypot

from urdfkit.description.urdf.geometry import rotate, rotation_of, unit
from urdfkit.description.urdf.robot import Joint, Pose, Vector
from urdfkit.lint.facts.root_cause import parent_at
from urdfkit.lint.model.placement import Extent, Frame
from urdfkit.lint.rule import Findings, Model, RobotRule

_PART = 0.05
"""Smallest gap between the links at a limit, as a part of the stroke."""

_RAIL = 3.0
"""Smallest ratio of the length of a rail along the axis to its other sizes."""

_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

Corners = tuple[Vector, Vector]


class SlideOffItsParent(RobotRule):
    """A prismatic joint moves its child link off the parent link.

    ## What it does
    Compares the bounding boxes of both links of each ``prismatic`` joint at its limits. Reports the joint if the boxes
    touch with the joint at zero but are at least 5 % of the stroke apart at a limit. In addition, one of two
    conditions must hold:

    - Along exactly one other axis of the joint frame, the boxes would touch at both limits.
    - The boxes would not touch at both limits along any axis, and the joint moves along a rail, that is, a parent link
      at least three times as long as it is wide.

    A column that is longer than its stroke may rise out of its parent link.

    ## Why is this bad?
    The carriage leaves its rail. Usually the ``<axis>`` was copied from another joint, or is missing and defaults to x.
    Sometimes each limit is set to the whole stroke, so that the range is twice as large as intended.

    ## Example
    ```diff
     <robot name="gantry">
       <link name="world"/>
       <joint name="mount" type="fixed"><parent link="world"/><child link="rail"/></joint>
       <link name="rail"><visual><geometry><box size="2 0.1 0.1"/></geometry></visual></link>
       <link name="carriage">
         <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
         <inertial><mass value="6"/><inertia ixx="0.025" ixy="0" ixz="0" iyy="0.025" iyz="0" izz="0.04"/></inertial>
       </link>
       <joint name="rail_joint" type="prismatic">
         <parent link="rail"/><child link="carriage"/>
         <origin xyz="0 0 0.1"/>
    -    <axis xyz="0 1 0"/>
    +    <axis xyz="1 0 0"/>
         <limit lower="-0.8" upper="0.8" effort="100" velocity="1"/>
       </joint>
     </robot>
    ```
    """

    code = "J424"
    name = "slide-off-its-parent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each prismatic joint that separates its links."""
        for joint in model.robot.joints:
            if joint.type != "prismatic":
                continue
            parent, child = (model.extents.get(name or "") for name in (joint.parent, joint.child))
            limit, axis = joint.limit, unit(joint.axis)
            if parent is None or child is None or limit is None or axis is None:
                continue
            low, high = limit.lower or 0.0, limit.upper or 0.0
            if high <= low or _gap(joint, axis, (0.0,), parent, child) > 0.02 * (high - low):
                continue
            gap = _gap(joint, axis, (low, high), parent, child)
            if gap < _PART * (high - low) or _rises(joint, axis, high - low, parent, child):
                continue
            message = f"joint `{joint.name}` moves `{joint.child}` {gap:.3g} m away from `{joint.parent}`"
            at_parent = parent_at(model, joint)
            fitting = [each for each in _AXES if _gap(joint, each, (low, high), parent, child) < 0.02 * (high - low)]
            if len(fitting) == 1:
                right = " ".join(f"{part:g}" for part in fitting[0])
                element = joint.element.find("axis") or joint.element
                help = f'with <axis xyz="{right}"/> the links stay in contact'
                yield self.at(model, element, message, attribute="xyz", joint=joint.name, help=help, other=at_parent)
            elif not fitting and _is_along(joint, axis, parent):
                help = "the range of motion is longer than the rail; check whether each limit should be half as large"
                yield self.at(model, limit.element, message, joint=joint.name, help=help, other=at_parent)


def _sizes(extent: Extent) -> list[float]:
    return [high - low for low, high in zip(extent.low, extent.high, strict=True)]


def _rises(joint: Joint, axis: Vector, stroke: float, parent: Extent, child: Extent) -> bool:
    """Return whether a column, at least as long as the stroke, moves out of the side of the parent that it touches."""
    length = max(abs(part) * size for part, size in zip(axis, _sizes(child), strict=True))
    small = 1e-3 * stroke
    x, y, z = (small * part for part in axis)
    away = max(_gap(joint, axis, (sign * 1.01 * small,), parent, child) for sign in (1.0, -1.0))
    return length >= stroke and away > 0.9 * hypot(x, y, z)


def _is_along(joint: Joint, axis: Vector, parent: Extent) -> bool:
    """Return whether a joint moves along the longest side of a rail."""
    direction, sizes = rotate(rotation_of(joint.origin.rpy), axis), _sizes(parent)
    longest = max(range(3), key=lambda k: sizes[k])
    return abs(direction[longest]) > 0.99 and sizes[longest] >= _RAIL * max(
        size for k, size in enumerate(sizes) if k != longest
    )


def _gap(joint: Joint, axis: Vector, positions: tuple[float, ...], parent: Extent, child: Extent) -> float:
    """Return the largest distance between the boxes of both links at some positions of a joint [m]."""
    direction = rotate(rotation_of(joint.origin.rpy), axis)
    largest = 0.0
    for position in positions:
        x, y, z = (a + position * b for a, b in zip(joint.origin.xyz, direction, strict=True))
        low, high = _around(Frame().moved(Pose((x, y, z), joint.origin.rpy)), child)
        sides = zip(parent.low, parent.high, low, high, strict=True)
        largest = max(largest, hypot(*(max(a - d, c - b, 0.0) for a, b, c, d in sides)))
    return largest


def _around(frame: Frame, extent: Extent) -> Corners:
    """Return the corners of the box of a link in another frame."""
    (a, b, c), (x, y, z) = ([side(part) for part in zip(*extent.corners_in(frame), strict=True)] for side in (min, max))
    return (a, b, c), (x, y, z)
