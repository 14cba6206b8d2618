"""Links of the left and the right side that overlap with every joint at zero."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.urdf.robot import Link, Vector
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.twins import mirrored
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import shapes_of

_MEETING = re.compile(r"(?i)finger|jaw|grip|hand|palm|claw|thumb|knuckle|clamp|pad|tip|door|eye|ear|lens|stereo|camera")
"""Names of parts that may touch those of the other side."""

_OVERLAP = 0.15
"""Part of the width of a link by which it lies in its counterpart."""

_ALIGNED = 1e-3
"""Largest component of a direction along which a box is not, for a box along the axes of the root link."""


def overlapping_twins(model: Model) -> Iterator[tuple[Link, Element, str]]:
    """Yield a link of the right side, the element of its first shape, and the message."""
    links = model.robot.link_by_name
    for link in model.robot.links:
        for name in mirrored(link.name) if not _MEETING.search(link.name) and link.collisions else ():
            other = links.get(name)
            if other is None or not other.collisions or link.name > name:
                continue
            boxes = [_box(each, model) for each in (link, other)]
            if boxes[0] is None or boxes[1] is None:
                continue
            (low, high), (low2, high2) = boxes[0], boxes[1]
            depths = [min(b, d) - max(a, c) for a, b, c, d in zip(low, high, low2, high2, strict=True)]
            # Links at exactly one place are not placed yet, or reported by the origins of their joints.
            width = min(high[1] - low[1], high2[1] - low2[1])
            if min(depths) > 0.0 and depths[1] > _OVERLAP * width and low[1] + high[1] != low2[1] + high2[1]:
                first = shapes_of(other)[0]
                offset, geometry = first.element.find("origin"), first.element.find("geometry")
                shape = next(iter(geometry.children), None) if geometry is not None else None
                if offset is not None and first.origin.xyz[1] != 0.0:
                    shape = offset
                message = f"links `{link.name}` and `{name}` overlap by {depths[1]:.3g} m"
                yield other, shape or other.element, message


def _box(link: Link, model: Model) -> tuple[Vector, Vector] | None:
    """Return two corners of the box of a link in the root link; None if it is not along the axes there, or unknown."""
    frame, extent = model.frames.get(link.name), model.extents.get(link.name)
    if frame is None or extent is None:
        return None
    if any(_ALIGNED < abs(part) < 1.0 - _ALIGNED for row in frame.rotation for part in row):
        return None
    x, y, z = zip(*extent.corners_in(frame), strict=True)
    return (min(x), min(y), min(z)), (max(x), max(y), max(z))
