"""Ray packets: the rays that traverse the tree together.

Neighbouring rays mostly hit the same shapes, so `WIDTH` of them share one traversal of the tree, and each test of a
shape is one loop over the packet that the compiler vectorizes (Wald et al., *Interactive Rendering with Coherent Ray
Tracing*, 2001). A packet is one array with `WIDTH` numbers per row. The offsets of the rows are constants, so the
compiler knows that rows do not overlap.
"""

from typing import Any

from urdfkit.scene.rays.compilation import compiled, inlined

WIDTH = 16
"""Rays in a packet."""

OX, OY, OZ, DX, DY, DZ, REACH, HIT, PART = (row * WIDTH for row in range(9))
"""Origin [m], direction (unit), the nearest hit so far [m], its shape and triangle (-1: none), in the world."""

LX, LY, LZ, MX, MY, MZ = (row * WIDTH for row in range(9, 15))
"""Origin and direction in the frame of the current mesh."""

BEAM = 15 * WIDTH
LOCAL_BEAM = BEAM + 24
"""Bounds of all rays of a packet, in the world and in the frame of a mesh: 24 numbers each, see `bound`."""

CHILDREN = 8
"""Maximum number of children per node."""

PACKET = LOCAL_BEAM + 24
"""Size of a packet."""

FAR = 1e300
"""Used as infinity where a difference of two infinities would be NaN."""


@compiled
def bound(packet: Any, origin: int, direction: int, beam: int) -> None:
    """Compute the bounds of the packet's rays for `entered_children` and `entry`.

    Per axis, the rays lie between ``low + t·slowest`` and ``high + t·fastest`` at distance t. Stored are low and high
    of the origins, 1/fastest if some ray ascends, 1/-slowest if some descends (else `FAR`: no ray enters), and
    1/slowest if all ascend, 1/-fastest if all descend (else zero followed by `FAR`: some rays never leave).
    """
    for axis in range(3):
        o, d, at = origin + axis * WIDTH, direction + axis * WIDTH, beam + 8 * axis
        low = high = packet[o]
        slowest = fastest = packet[d]
        for k in range(1, WIDTH):
            low, high = min(low, packet[o + k]), max(high, packet[o + k])
            slowest, fastest = min(slowest, packet[d + k]), max(fastest, packet[d + k])
        packet[at] = low
        packet[at + 1] = high
        packet[at + 2] = 1.0 / fastest if fastest > 1e-200 else FAR
        packet[at + 3] = -1.0 / slowest if slowest < -1e-200 else FAR
        packet[at + 4] = 1.0 / slowest if slowest > 1e-200 else 0.0
        packet[at + 5] = 0.0 if slowest > 1e-200 else FAR
        packet[at + 6] = -1.0 / fastest if fastest < -1e-200 else 0.0
        packet[at + 7] = 0.0 if fastest < -1e-200 else FAR


@inlined
def entered_children(packet: Any, beam: int, boxes: Any, node: int, near: float, reach: float) -> int:
    """Return a bit mask of the children of a node that some ray may enter between `near` and `reach`.

    The loop has no branches and no stores, so the compiler vectorizes it.

    Args:
        packet: the rays.
        beam: offset of their bounds, `BEAM` or `LOCAL_BEAM`.
        boxes: boxes of the children: lowest x of each, then y, z, and the highest; shape (nodes, 6 `CHILDREN`).
        node: the node.
        near: start of the rays [m].
        reach: end of the rays [m].
    """
    x0, x1, x2, x3, x4, x5, x6, x7 = along(packet, beam)
    y0, y1, y2, y3, y4, y5, y6, y7 = along(packet, beam + 8)
    z0, z1, z2, z3, z4, z5, z6, z7 = along(packet, beam + 16)
    found = 0
    for c in range(CHILDREN):
        low, high = boxes[node, c], boxes[node, 3 * CHILDREN + c]
        enter = max(near, (low - x1) * x2, (x0 - high) * x3)
        leave = min(reach, (high - x0) * x4 + x5, (x1 - low) * x6 + x7)
        low, high = boxes[node, CHILDREN + c], boxes[node, 4 * CHILDREN + c]
        enter = max(enter, (low - y1) * y2, (y0 - high) * y3)
        leave = min(leave, (high - y0) * y4 + y5, (y1 - low) * y6 + y7)
        low, high = boxes[node, 2 * CHILDREN + c], boxes[node, 5 * CHILDREN + c]
        enter = max(enter, (low - z1) * z2, (z0 - high) * z3)
        leave = min(leave, (high - z0) * z4 + z5, (z1 - low) * z6 + z7)
        # A relative tolerance of 1e-12 for rounding errors.
        found |= (1 << c) if enter <= leave + 1e-12 * abs(leave) else 0
    return found


@inlined
def along(packet: Any, at: int) -> Any:
    """Return the bounds along one axis."""
    return (
        packet[at], packet[at + 1], packet[at + 2], packet[at + 3],
        packet[at + 4], packet[at + 5], packet[at + 6], packet[at + 7],
    )  # fmt: skip


@inlined
def entry(packet: Any, beam: int, boxes: Any, node: int, c: int, near: float) -> float:
    """Return a lower bound of the distances at which rays enter child `c` of a node, see `entered_children`."""
    enter = near
    for axis in range(3):
        b = beam + 8 * axis
        low, high = boxes[node, CHILDREN * axis + c], boxes[node, CHILDREN * (axis + 3) + c]
        enter = max(enter, (low - packet[b + 1]) * packet[b + 2], (packet[b] - high) * packet[b + 3])
    return float(enter)


@inlined
def farthest(packet: Any) -> float:
    """Return the length of the longest ray of the packet [m]."""
    reach = packet[REACH]
    for k in range(1, WIDTH):
        reach = max(reach, packet[REACH + k])
    return float(reach)
