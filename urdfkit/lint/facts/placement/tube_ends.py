"""Joints that are not at the end of the slender link that carries them."""

from collections import Counter
from collections.abc import Iterator

from urdfkit.description.urdf.robot import Joint
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.placement.joint_places import EXACT, PART, origin_of
from urdfkit.lint.facts.placement.solids import local
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import Extent
from urdfkit.record import record

_SLENDER = 2.5
"""Smallest ratio of the length of a tube to its other sizes."""

_ENDS = 2
"""Smallest number of joints at the ends of their tubes of which one stands out."""

_BESIDE = 1.5
"""Largest distance of a joint from the axis of its tube, as a multiple of the width of the tube."""

_ALONG = 0.7
"""Smallest cosine of the angle between an axis and the tube that it turns about."""


@record
class Tube:
    """A slender link that starts at its own frame.

    Attributes:
        axis: index of the axis of the frame along the link.
        end: coordinate of its end on this axis [m].
        width: its largest size across this axis [m].
    """

    axis: int
    end: float
    width: float


@record
class Misplaced:
    """A joint that is not at the end of the tube that carries it.

    Attributes:
        joint: the joint.
        element: its ``<origin>``.
        place: distance from the frame of the tube in the direction of its end [m]; negative on the other side.
        length: length of the tube [m].
    """

    joint: Joint
    element: Element
    place: float
    length: float


def along_tubes(model: Model) -> Iterator[Misplaced]:
    """Yield joints that are not at the end of the tube that carries them.

    Yields:
        A joint at the opposite end: as far from the frame of its tube as the tube is long, with the other sign, where
        no other link that is fixed to the tube reaches. A joint as far along its tube as the next tube is long, if
        another tube has a joint at its end. Or the only joint that is not at the end of its tube, if it carries a tube,
        does not turn about the axis of its own tube and several others are at the ends of theirs. Only tubes with one
        moving link count for the last two.
    """
    tubes = {link: tube for link, extent in model.extents.items() if (tube := _tube(extent)) is not None}
    carried = Counter(joint.parent for joint in model.robot.joints if joint.is_movable)
    meshed = {link.name for _, _, link in model.meshes}
    ends: set[object] = set()
    ended: set[str | None] = set()
    opposite: dict[object, Misplaced] = {}
    at_length_of_next: dict[object, Misplaced] = {}
    off: dict[object, Misplaced] = {}
    for joint in model.robot.joints:
        tube, element = tubes.get(joint.parent or ""), origin_of(joint)
        if tube is None or model.is_unresolved(element, "xyz"):
            continue
        sign = -1.0 if tube.end < 0.0 else 1.0
        found = Misplaced(joint, element, sign * joint.origin.xyz[tube.axis], sign * tube.end)
        gap = abs(found.place - found.length)
        across, position = _across(joint, tube), element.origin.position
        own = tubes.get(joint.child or "")
        if gap <= EXACT:
            ended.add(joint.parent)
        is_only = carried[joint.parent] == 1 and joint.type in ("revolute", "continuous")
        is_off = gap > PART * found.length
        is_length_of_next = own is not None and abs(abs(own.end) - found.place) <= EXACT
        if across <= tube.width and abs(found.place + found.length) <= EXACT and joint.child in model.extents:
            if not _is_carried(joint, model):
                opposite.setdefault(position, found)
        elif is_only and is_off and across <= _BESIDE * tube.width and is_length_of_next:
            at_length_of_next.setdefault(position, found)
        elif is_only and across <= EXACT and joint.parent not in meshed:
            if gap <= EXACT:
                ends.add(position)
            elif is_off:
                off.setdefault(position, found)
    yield from opposite.values()
    yield from (each for each in at_length_of_next.values() if ended - {each.joint.parent})
    if len(off) != 1 or opposite or at_length_of_next or len(ends) < _ENDS:
        return
    [last] = off.values()
    carrier = tubes[last.joint.parent or ""]
    if last.place > 0.0 and last.joint.child in tubes and abs(last.joint.axis[carrier.axis]) < _ALONG:
        yield last


def _is_carried(joint: Joint, model: Model) -> bool:
    """Return whether another link that is fixed to the parent of a joint reaches the joint."""
    parent = model.frames.get(joint.parent or "")
    if parent is None:
        return False
    place = parent.moved(joint.origin).translation
    for other in model.robot.joints:
        frame, extent = model.frames.get(other.child or ""), model.extents.get(other.child or "")
        is_fixed = other.type == "fixed" and other.parent == joint.parent and other is not joint
        if is_fixed and frame is not None and extent is not None and extent.outside(local(frame, place)) <= EXACT:
            return True
    return False


def _across(joint: Joint, tube: Tube) -> float:
    """Return the largest distance of a joint from the axis of its tube, along an axis of the frame [m]."""
    return max(abs(part) for k, part in enumerate(joint.origin.xyz) if k != tube.axis)


def _tube(extent: Extent) -> Tube | None:
    """Return the slender link that starts at its own frame; None for other links."""
    sizes = [high - low for low, high in zip(extent.low, extent.high, strict=True)]
    axis = max(range(3), key=sizes.__getitem__)
    low, high = extent.low[axis], extent.high[axis]
    others = [k for k in range(3) if k != axis]
    is_centred = all(abs(extent.low[k] + extent.high[k]) <= PART * sizes[axis] for k in others)
    width = max(sizes[k] for k in others)
    if not is_centred or sizes[axis] < _SLENDER * width or min(abs(low), abs(high)) > EXACT:
        return None
    return Tube(axis, high if abs(high) > abs(low) else low, width)
