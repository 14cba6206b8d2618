"""Where the frames of joints lie in the shapes of their parent links: on the surface, outside or inside."""

from collections.abc import Iterator

from urdfkit.description.urdf.geometry import box_around, rpy_of
from urdfkit.description.urdf.robot import Joint, Vector
from urdfkit.description.xml.element import Element
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import Extent, Frame
from urdfkit.record import record

EXACT = 1e-4
"""Largest distance of a joint from the surface of its parent link that counts as zero [m]."""

_FAR, _DEEP = 0.003, 0.005
"""Smallest distances outside and inside of the shape that are a defect [m]."""

PART = 0.02
"""Smallest part of the size of the parent link that these distances are."""

_DETACHED = 0.1
"""Smallest gap between links on a wrong side, as a part of the size of the smaller one."""

_NEARER = 0.1
"""Largest gap between these links with the opposite sign, as a part of the gap."""

_OVERLAP = 0.3
"""Smallest part of the child link that is inside of the shape of the parent link of a joint that is too deep."""

_FEWEST = 4
"""Smallest number of joints on the surfaces of their parent links of which one stands out."""


@record(eq=False)
class Place:
    """Place of a joint at its parent link.

    Attributes:
        joint: the joint.
        element: its ``<origin>``.
        depth: depth of the joint below the surface of the parent link; negative outside [m].
        parent: extent of the parent link.
        child: extent of the child link; None without shapes.
    """

    joint: Joint
    element: Element
    depth: float
    parent: Extent
    child: Extent | None


def misplaced(model: Model) -> Iterator[Place]:
    """Yield the place that is off the surface of its parent link, if all other joints are on theirs.

    Compares joints that turn or slide within limits, and fixed joints with such joints below, but not the joints of
    steered wheels, which are next to the chassis, nor fixed joints at the centre of their child links. The joints of
    one macro count as one.
    """
    off: dict[object, Place] = {}
    compared = _compared(model)
    for (joint, parent), below in zip(compared, model.facts.of(depth_of, compared), strict=True):
        if abs(below) <= EXACT:
            continue
        element = origin_of(joint)
        position = element.origin.position
        if position not in off or abs(below) > abs(off[position].depth):
            off[position] = Place(joint, element, below, parent, model.extents.get(joint.child or ""))
            if len(off) > 1:
                return
    one = next(iter(off.values()), None)
    if one is None or model.is_unresolved(one.element, "xyz"):
        return
    if len({origin_of(joint).origin.position for joint, _ in compared}) > _FEWEST:
        size = one.parent.diagonal
        is_in_tube = one.joint.type == "prismatic"  # The stage of a telescope is inside of the one before.
        is_deep = one.depth >= max(_DEEP, PART * size) and one.child is not None and not is_in_tube
        if -one.depth >= max(_FAR, PART * size) or (is_deep and _overlap(one) >= _OVERLAP):
            yield one


def on_wrong_side(model: Model) -> Iterator[tuple[Joint, float, int]]:
    """Yield the fixed joints whose links are apart, but meet with the opposite sign of one coordinate.

    One link then ends exactly where the other starts along that axis. The values are the joint, the gap between the
    boxes of its links, and the index of the coordinate.
    """
    meshed = {link.name for _, _, link in model.meshes}
    for joint in model.robot.joints:
        parent, child = (model.extents.get(name or "") for name in (joint.parent, joint.child))
        if joint.type != "fixed" or parent is None or child is None or any(joint.origin.rpy):
            continue
        gap = max(_gaps(joint.origin.xyz, parent, child))
        if gap < _DETACHED * min(parent.diagonal, child.diagonal) or {joint.parent, joint.child} & meshed:
            continue
        if model.is_unresolved(origin_of(joint), "xyz"):
            continue
        for k in range(3):
            x, y, z = (-part if axis == k else part for axis, part in enumerate(joint.origin.xyz))
            gaps = _gaps((x, y, z), parent, child)
            if abs(gaps[k]) <= EXACT and max(gaps) <= _NEARER * gap:
                yield joint, gap, k


def _gaps(offset: Vector, parent: Extent, child: Extent) -> list[float]:
    """Return the gaps between the boxes of two links along each axis [m]; negative where they overlap."""
    sides = zip(offset, parent.low, parent.high, child.low, child.high, strict=True)
    return [max(at + low - outer, inner - at - high) for at, inner, outer, low, high in sides]


def _compared(model: Model) -> list[tuple[Joint, Extent]]:
    """Return the joints that are compared, with the extents of their parent links."""
    joints, extents = model.robot.joints, model.extents
    axles = {joint.parent for joint in joints if joint.type == "continuous"}
    carriers = _carriers(model) if any(joint.type == "fixed" for joint in joints) else set()
    meshed = {link.name for _, _, link in model.meshes}
    return [
        (joint, parent)
        for joint in joints
        if (joint.type in ("revolute", "prismatic") or (joint.type == "fixed" and joint.child in carriers))
        and not (joint.type == "fixed" and _is_centred(joint, model))
        and (parent := extents.get(joint.parent or "")) is not None
        and joint.parent not in meshed
        and not (joint.type == "revolute" and joint.child in axles)
    ]


def depth_of(joint_and_parent: tuple[Joint, Extent]) -> float:
    """Return the depth of a joint below the surface of its parent link, whose extent is given; see `depth`."""
    joint, parent = joint_and_parent
    return depth(joint.origin.xyz, parent)


def _is_centred(joint: Joint, model: Model) -> bool:
    """Return whether a joint is in the middle of its child link, so that it is not where both links touch."""
    child = model.extents.get(joint.child or "")
    return child is not None and depth((0.0, 0.0, 0.0), child) > PART * child.diagonal


def origin_of(joint: Joint) -> Element:
    """Return the ``<origin>`` of a joint; the joint without one."""
    return joint.element.find("origin") or joint.element


def _carriers(model: Model) -> set[str]:
    """Return the links with joints that turn or slide within limits below them."""
    found: set[str] = set()
    parents = {joint.child: joint.parent for joint in model.robot.joints}
    for joint in model.robot.joints:
        link = joint.parent if joint.type in ("revolute", "prismatic") else None
        while link is not None and link not in found:
            found.add(link)
            link = parents.get(link)
    return found


def depth(point: Vector, extent: Extent) -> float:
    """Return the depth of a point below the surface of the box around the shapes of a link; negative outside [m]."""
    (a, b, c), (x, y, z), (d, e, f) = extent.low, point, extent.high
    least = min(x - a, d - x, y - b, e - y, z - c, f - z)
    return least if least >= 0.0 else -extent.outside(point)


def _overlap(place: Place) -> float:
    """Return the part of the box around a child link that is inside of the box around its parent link."""
    frame, part, whole = Frame().moved(place.joint.origin), 0.0, 0.0
    for shape, pose in place.child.shapes if place.child is not None else ():
        at = frame.moved(pose)
        low, high = box_around(shape, type(pose)(at.translation, _rpy(at)))
        sides = [
            (max(min(b, d) - max(a, c), 0.0), d - c)
            for a, b, c, d in zip(place.parent.low, place.parent.high, low, high, strict=True)
        ]
        part += sides[0][0] * sides[1][0] * sides[2][0]
        whole += sides[0][1] * sides[1][1] * sides[2][1]
    return part / whole if whole > 0.0 else 0.0


def _rpy(frame: Frame) -> Vector:
    return rpy_of(frame.rotation)
