"""Joints that are not at the end of the slender link that carries them."""

from collections import Counter
from collections.abc import Iterator

from urdfkit.description.urdf.robot import Joint
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.placement.joint_places import EXACT, PART, origin_of
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


def along_tubes(model: Model) -> Iterator[tuple[Joint, Element, float, float]]:
    """Yield joints that are not at the end of the tube that carries them: joint, ``<origin>``, its place, the length.

    Yields:
        A joint at the opposite end: as far from the frame of its tube as the tube is long, with the other sign. A
        joint as far along its tube as the next tube is long. Or the only joint that is not at the end of its tube, if
        it carries a tube, does not turn about the axis of its own tube and several others are at the ends of theirs.
        Only tubes with one moving link count for the last two.
    """
    tubes = {link: tube for link, extent in model.extents.items() if (tube := _tube(extent)) is not None}
    carried = Counter(joint.parent for joint in model.robot.joints if joint.is_movable)
    meshed = {link.name for _, _, link in model.meshes}
    ends: set[object] = set()
    off: dict[object, tuple[Joint, Element, float, float]] = {}
    seen: set[object] = set()
    for joint in model.robot.joints:
        tube, element = tubes.get(joint.parent or ""), origin_of(joint)
        if tube is None or model.is_unresolved(element, "xyz"):
            continue
        place, across = joint.origin.xyz[tube.axis], _across(joint, tube)
        own, position = tubes.get(joint.child or ""), element.origin.position
        is_only = carried[joint.parent] == 1 and joint.type in ("revolute", "continuous")
        is_off = abs(place - tube.end) > PART * abs(tube.end)
        is_length_of_next = own is not None and abs(abs(own.end) - place * _sign(tube.end)) <= EXACT
        if across <= tube.width and abs(place + tube.end) <= EXACT and joint.child in model.extents:
            if position not in seen:
                seen.add(position)
                yield joint, element, place * _sign(tube.end), abs(tube.end)
        elif is_only and is_off and across <= _BESIDE * tube.width and is_length_of_next:
            if position not in seen:
                seen.add(position)
                yield joint, element, abs(place), abs(tube.end)
        elif is_only and across <= EXACT and joint.parent not in meshed:
            if abs(place - tube.end) <= EXACT:
                ends.add(position)
            elif is_off:
                off.setdefault(position, (joint, element, place, abs(tube.end)))
    if len(off) != 1 or seen:
        return
    [(joint, element, place, length)] = off.values()
    carrier = tubes[joint.parent or ""]
    is_folding = joint.child in tubes and abs(joint.axis[carrier.axis]) < _ALONG
    if place > 0.0 and is_folding and len(ends) >= _ENDS:
        yield joint, element, place, length


def _sign(number: float) -> float:
    return -1.0 if number < 0.0 else 1.0


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
