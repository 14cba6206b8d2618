"""A packet: the rays that go through the tree together, as the kernels see them.

Rays side by side mostly meet the same things, so `WIDTH` of them share one walk through the tree, and every test of a
shape is one loop over the packet that the compiler turns into vector instructions (Wald et al., *Interactive Rendering
with Coherent Ray Tracing*, 2001). A packet is one block of numbers, `WIDTH` per row; the rows' starts are constants, so
that the compiler sees that rows do not overlap.
"""

from __future__ import annotations

from typing import Any

from urdfkit.scene.rays.compilation import compiled, inlined

WIDTH = 16
"""Rays in a packet."""

OX, OY, OZ, DX, DY, DZ, REACH, HIT, PART = (row * WIDTH for row in range(9))
"""Origin [m], direction (unit), the nearest hit so far [m], its shape and triangle (-1: none), in the world."""

LX, LY, LZ, MX, MY, MZ = (row * WIDTH for row in range(9, 15))
"""Origin and direction in the frame of the mesh that is being looked at."""

BEAM = 15 * WIDTH
LOCAL_BEAM = BEAM + 24
"""Bounds of all rays of a packet, in the world and in the frame of a mesh: 24 numbers each, see `bound`."""

PACKET = LOCAL_BEAM + 24
"""Numbers in a packet."""

FAR = 1e300
"""Stands for infinity where infinity minus infinity must not happen."""


@compiled
def bound(packet: Any, origin: int, direction: int, beam: int) -> None:
    """Work out the bounds of the packet's rays, for `enters`.

    Per axis, the rays lie between ``low + t·slowest`` and ``high + t·fastest`` at distance t. Stored are low and high
    of the origins, 1/fastest where some ray ascends, 1/-slowest where some descends (else `FAR`: none gets there), and
    1/slowest where all ascend, 1/-fastest where all descend (else zero with `FAR` beside it: some never leave).
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
def enters(packet: Any, beam: int, bounds: Any, at: int, near: float, reach: float) -> float:
    """Return a distance at which no ray has entered a box yet; `FAR` where none enters it between `near` and `reach`.

    Args:
        packet: the rays.
        beam: which of their bounds.
        bounds: lowest and highest corners of boxes, six numbers each.
        at: where in `bounds` the box starts.
        near: where the rays begin [m].
        reach: where they end [m].
    """
    enter, leave = near, reach
    for axis in range(3):
        b = beam + 8 * axis
        low, high = bounds[at + axis], bounds[at + 3 + axis]
        enter = max(enter, (low - packet[b + 1]) * packet[b + 2], (packet[b] - high) * packet[b + 3])
        up = (high - packet[b]) * packet[b + 4] + packet[b + 5]
        down = (packet[b + 1] - low) * packet[b + 6] + packet[b + 7]
        leave = min(leave, up, down)
    # One part in 1e12 for what rounding may have taken.
    return enter if enter <= leave + 1e-12 * abs(leave) else FAR


@inlined
def farthest(packet: Any) -> float:
    """Return how far the packet's longest ray still reaches [m]."""
    reach = packet[REACH]
    for k in range(1, WIDTH):
        reach = max(reach, packet[REACH + k])
    return float(reach)
