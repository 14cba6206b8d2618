"""J421 joint-origin-too-far."""

from math import dist, inf, sqrt

from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.robot import Joint, Pose
from urdfkit.description.xml.source import Position, Span
from urdfkit.lint.facts.root_cause import argument_of_coordinate, written_at_call
from urdfkit.lint.model.placement import Extent, Frame, offset_of, shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_MIN_DISTANCE = 10.0
"""Distance of a joint from its parent frame that only large robots have [m]."""

_TIMES = 20.0
"""Ratio of the distance to the largest link above which the parts of the robot cannot be connected."""

_TIMES_OTHERS = 20.0
"""Ratio of the distance to that of all other joints that stands out if no shape is known."""

_TIMES_ITS_LINKS = 4.0
"""Ratio of a gap to the sizes of both links of a joint above which a part is missing between them."""

_MIN_GAP = 0.05
"""Smallest gap between parts that is checked [m]."""

_PART_OF_LENGTH = 0.6
"""Ratio of the gap to the longer of the two parts of the robot above which they are not connected."""

_MIN_CHAIN = 3
"""Smallest number of moving joints of which one stands out."""

_MIN_OPEN, _OPEN = 0.02, 0.2
"""Smallest distance of a moving joint from its parent link [m], and its ratio to the size of that link."""

_CLOSED = 0.1
"""Largest ratio of the distances of the other moving joints to that distance."""

_MIRRORED = 0.3
"""Smallest ratio of the gap to the size of the parent link for a joint that would be at the link with another sign."""

_MAX_CHECKED = 50
"""Largest number of joints for which the gap is computed."""

Corners = tuple[tuple[float, ...], tuple[float, ...]]
"""Lower and upper corner of a box."""


class OriginTooFar(RobotRule):
    """A joint is implausibly far from its parent link.

    ## What it does
    Reports joints that are at least 10 m, and at least 20 times the extent of the largest link, from the frame of their
    parent link.

    If the sizes of all shapes are known, also reports a joint that separates its child link, with everything attached
    to it, from the rest of the robot. The gap must be longer than 60 % of the larger of these two parts. It must also
    exceed the size of the largest link, or four times the size of the larger of the two links of the joint.

    A moving joint outside the bounding box of its parent link is reported in two cases:

    - Every other moving joint is inside or at the box of its parent link.
    - This joint is the only joint that would be at the box if the sign of one coordinate changed.

    The joints of one macro count as one joint. Joints of a root link without shapes are not checked, because they place
    the robot in the world. If no size is known, because the meshes are missing, the distance is compared with the
    distances of all other joints.

    ## Why is this bad?
    The child link floats far from the robot. The usual cause is a wrong decimal point, or an offset in millimetres,
    copied from a CAD program.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
       </link>
       <link name="arm">
         <visual><geometry><box size="0.05 0.05 0.3"/></geometry></visual>
       </link>
       <joint name="mount" type="fixed">
         <parent link="base"/>
         <child link="arm"/>
    -    <origin xyz="0 0 200"/>
    +    <origin xyz="0 0 0.2"/>
       </joint>
     </robot>
    ```
    """

    code = "J421"
    name = "joint-origin-too-far"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that is too far from its parent link."""
        joints = model.robot.joints
        distances = list(zip(joints, model.facts.of(offset_of, joints), strict=True))
        largest = max((distance for _, distance in distances), default=0.0)
        if largest < _MIN_GAP:
            return
        extents = model.extents
        if not extents:
            yield from self._among_joints(model, distances)
            return
        sizes = {name: extent.diagonal for name, extent in extents.items()}
        size = max(sizes.values())
        children = {joint.child for joint in model.robot.joints}
        is_complete = not model.is_incomplete and all(
            link.name in extents or not shapes_of(link) for link in model.robot.links
        )
        if is_complete:
            yield from self._outside(model)
        checked = 0
        ordinary = max(_MIN_GAP, min(size, _TIMES_ITS_LINKS * min(sizes.values())))
        for joint, distance in distances:
            if distance <= ordinary or distance <= (near := min(size, _times_its_links(joint, sizes))):
                continue
            origin = joint.element.find("origin")
            is_placed_in_world = joint.parent not in children and joint.parent not in extents
            if origin is None or is_placed_in_world:
                continue
            message, help = "", "write offsets in metres"
            if distance >= max(_MIN_DISTANCE, _TIMES * size):
                message = f"joint `{joint.name}` is {distance:.4g} m from `{joint.parent}`; "
                message += f"the largest link extends {size:.3g} m"
            elif is_complete and checked < _MAX_CHECKED:
                checked += 1
                gap = _gap(joint, model)
                if gap > max(near, _MIN_GAP):
                    message = f"joint `{joint.name}` places `{joint.child}` {gap:.3g} m away from all other parts; "
                    compared = f"the largest link extends {size:.3g} m"
                    message += compared if near >= size else f"its links extend {near / _TIMES_ITS_LINKS:.3g} m at most"
                    help = "check the decimal points and units of the origin"
            if message:
                yield self.at(model, origin, message, attribute="xyz", joint=joint.name, help=help)

    def _among_joints(self, model: Model, distances: list[tuple[Joint, float]]) -> Findings:
        """Yield a finding for each joint that is far from its parent compared with all others, if no shape is known."""
        *others, largest = sorted(distance for _, distance in distances)
        typical = max(others, default=0.0)
        roots = {link.name for link in model.robot.roots()}
        for joint, distance in distances:
            origin = joint.element.find("origin")
            is_far = distance == largest >= _MIN_DISTANCE and distance > _TIMES_OTHERS * typical > 0.0
            is_scenery = joint.parent in roots and not shapes_of(model.robot.link_by_name[joint.parent or ""])
            if is_far and joint.parent and origin is not None and not is_scenery:
                message = f"joint `{joint.name}` is {distance:.4g} m from `{joint.parent}`; "
                message += "all other joints are at a distance of at most"
                help = "write offsets in metres"
                yield self.at(model, origin, f"{message} {typical:.3g} m", attribute="xyz", joint=joint.name, help=help)

    def _outside(self, model: Model) -> Findings:
        """Yield a finding for the only moving joint that is not at its parent link."""
        moving = [joint for joint in model.robot.joints if joint.type in ("revolute", "continuous", "prismatic")]
        if not _MIN_CHAIN <= len(moving) <= _MAX_CHECKED:
            return
        parents = [model.extents.get(joint.parent or "") for joint in moving]
        gaps = [
            (_distance((joint.origin.xyz, joint.origin.xyz), (parent.low, parent.high)), joint, parent.diagonal)
            for joint, parent in zip(moving, parents, strict=True)
            if parent is not None
        ]
        if len(gaps) < len(moving):
            return
        largest: dict[Position, tuple[float, Joint, float]] = {}  # The joints of one macro count as one.
        for each in gaps:
            position = (each[1].element.find("origin") or each[1].element).origin.position
            if position not in largest or each[0] > largest[position][0]:
                largest[position] = each
        if len(largest) < 2:
            return
        (second, _, _), (gap, joint, size) = sorted(largest.values(), key=lambda each: each[0])[-2:]
        origin = joint.element.find("origin")
        if gap < max(_MIN_OPEN, _OPEN * size) or origin is None:
            return
        if second > _CLOSED * gap:
            yield from self._mirrored(model, list(largest.values()))
            return
        if _is_carried(joint, model):
            return
        message = f"joint `{joint.name}` is {gap:.3g} m outside its parent link `{joint.parent}`; "
        message += "all other moving joints are at their parent links"
        help = "check the axes, signs and units of the origin"
        place = _argument(joint, moving, model)
        if place is not None:
            yield self.at_span(place, message, joint=joint.name, help=help, kind="argument")
        else:
            yield self.at(model, origin, message, attribute="xyz", joint=joint.name, help=help)

    def _mirrored(self, model: Model, gaps: list[tuple[float, Joint, float]]) -> Findings:
        """Yield a finding for the only moving joint that would be at its parent link with another sign."""
        wrong: list[tuple[Joint, float, float]] = []
        for gap, joint, size in gaps:
            parent = model.extents[joint.parent or ""]
            if gap < max(_MIN_OPEN, _MIRRORED * size):
                continue
            for axis in range(3):
                x, y, z = (-part if k == axis else part for k, part in enumerate(joint.origin.xyz))
                if parent.outside((x, y, z)) <= _OPEN * gap:
                    wrong.append((joint, gap, joint.origin.xyz[axis]))
                    break
        if len(wrong) != 1:
            return
        joint, gap, part = wrong[0]
        message = f"joint `{joint.name}` is {gap:.3g} m outside its parent link `{joint.parent}`, "
        message += f"but would be at the link if {part:.3g} m were {-part:.3g} m"
        help = "check the signs of the origin and of the shapes of the parent link"
        origin = joint.element.find("origin") or joint.element
        yield self.at(model, origin, message, attribute="xyz", joint=joint.name, help=help)


def _argument(joint: Joint, moving: list[Joint], model: Model) -> Span | None:
    """Return the argument that places a joint outside of its parent link, if it is inside for another macro call.

    The argument is at the macro call, or at the property that the call hands on.
    """
    origin, excess = joint.element.find("origin"), _excess(joint, model)
    k = excess.index(max(excess))
    for other in moving:
        right = other.element.find("origin")
        is_alike = right is not None and origin is not None and right.origin.position == origin.origin.position
        if origin is not None and right is not None and is_alike and _excess(other, model)[k] <= 0.0:
            place = argument_of_coordinate(model, origin, right, k)
            return written_at_call(model, place, origin.origin.expansions[1:]) if place is not None else None
    return None


def _excess(joint: Joint, model: Model) -> list[float]:
    """Return the distance of a joint from the box of its parent link along each axis [m]; negative inside of it."""
    parent = model.extents[joint.parent or ""]
    return [max(low - at, at - high) for at, low, high in zip(joint.origin.xyz, parent.low, parent.high, strict=True)]


def _is_carried(joint: Joint, model: Model) -> bool:
    """Return whether the child of a joint is at another part that is fixed to the parent, such as a rail."""
    attached = AttachedBodies(model.robot)
    body, child = attached.body_of(joint.parent or ""), model.extents.get(joint.child or "")
    if child is None or joint.child not in model.frames:
        return False
    box = _corners(model.frames[joint.child], child)
    return any(
        _distance(box, _corners(model.frames[name], extent)) < _MIN_OPEN
        for name, extent in model.extents.items()
        if name != joint.parent and name in model.frames and attached.body_of(name) == body
    )


def _times_its_links(joint: Joint, sizes: dict[str, float]) -> float:
    """Return a multiple of the size of the larger of the two links of a joint [m]; infinite if a size is unknown."""
    return _TIMES_ITS_LINKS * max(sizes.get(joint.parent or "", inf), sizes.get(joint.child or "", inf))


def _gap(joint: Joint, model: Model) -> float:
    """Return the distance between the parts below a joint and the rest of the robot [m]; 0 if either is long."""
    below, pending = {joint.child}, [joint.child]
    children: dict[str | None, list[str | None]] = {}
    for other in model.robot.joints:
        children.setdefault(other.parent, []).append(other.child)
    for name in pending:  # The list grows during the iteration.
        for child in children.get(name, ()):
            if child not in below:
                below.add(child)
                pending.append(child)
    sides: tuple[list[Corners], list[Corners]] = ([], [])
    for name, extent in model.extents.items():
        if name in model.frames:
            sides[name in below].append(_corners(model.frames[name], extent))
    rest, part = sides
    if not rest or not part:
        return 0.0
    gap = min(_distance(a, b) for a in part for b in rest)
    lengths = [_length(boxes) for boxes in sides]
    return gap if gap > _PART_OF_LENGTH * max(lengths) else 0.0


def _corners(frame: Frame, extent: Extent) -> Corners:
    """Return the lower and upper corner of a link's bounding box, along the axes of the root link."""
    half = [(high - low) / 2.0 for low, high in zip(extent.low, extent.high, strict=True)]
    x, y, z = ((low + high) / 2.0 for low, high in zip(extent.low, extent.high, strict=True))
    centre = frame.moved(Pose((x, y, z))).translation
    reach = [sum(abs(part) * length for part, length in zip(row, half, strict=True)) for row in frame.rotation]
    low = tuple(a - b for a, b in zip(centre, reach, strict=True))
    return low, tuple(a + b for a, b in zip(centre, reach, strict=True))


def _distance(first: Corners, second: Corners) -> float:
    """Return the distance between two boxes [m]; 0 if they overlap."""
    (low, high), (other_low, other_high) = first, second
    return sqrt(sum(max(a - d, c - b, 0.0) ** 2 for a, b, c, d in zip(low, high, other_low, other_high, strict=True)))


def _length(boxes: list[Corners]) -> float:
    """Return the diagonal of the box around boxes [m]."""
    lows, highs = zip(*boxes, strict=True)
    return dist([min(parts) for parts in zip(*lows, strict=True)], [max(parts) for parts in zip(*highs, strict=True)])
