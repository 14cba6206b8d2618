"""Walls drawn on the page, with doors, as a static SDF model."""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import atan2, hypot
from typing import Any

from urdfkit.errors import SimulationError

DOOR = 2.0
"""Height of a door [m]; a higher wall continues above it."""
LEAST = 0.02
"""Shortest piece of a wall [m]."""
MOST = 1000.0
"""Maximum coordinate of a corner [m]."""
COLOR = "0.86 0.84 0.8 1"


def walls(
    name: str,
    corners: Sequence[Sequence[float]],
    doors: Sequence[Mapping[str, Any]] = (),
    *,
    height: float = 2.5,
    thickness: float = 0.15,
) -> str:
    """Return the SDF of walls along a line of corners.

    Args:
        name: name of the model.
        corners: x y of each [m]; the last may be the first again.
        doors: each with ``segment`` (index of its wall), ``at`` (position of its centre on the wall [m]) and
            ``width`` [m].
        height: height of the walls [m].
        thickness: thickness of the walls [m].

    Raises:
        SimulationError: the corners coincide, or a door does not fit.
    """
    boxes: list[tuple[float, float, float, float, float, float]] = []  # x, y, z, yaw, length, height
    lengths = [hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(corners)]
    if not any(length >= LEAST for length in lengths):
        raise SimulationError("a wall needs two different corners")
    for door in doors:
        segment, at, width = int(door["segment"]), float(door["at"]), float(door["width"])
        if segment >= len(lengths):
            raise SimulationError(f"a door is in wall {segment}, but the last wall is {len(lengths) - 1}")
        if not width / 2 <= at <= lengths[segment] - width / 2:
            raise SimulationError(
                f"a door {width:g} m wide does not fit at {at:g} m into a wall of {lengths[segment]:.3g} m"
            )
    for k, (a, b, length) in enumerate(zip(corners, corners[1:], lengths, strict=False)):
        if length < LEAST:
            continue
        ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
        gaps = sorted((d["at"] - d["width"] / 2, d["at"] + d["width"] / 2) for d in doors if d["segment"] == k)
        if any(after[0] < before[1] for before, after in pairwise(gaps)):
            raise SimulationError(f"two doors of wall {k} overlap")
        # Walls overlap at corners: each is extended by half its thickness.
        pieces = _between(-thickness / 2, length + thickness / 2, gaps)
        spans = [(start, end, 0.0, height) for start, end in pieces]
        if height > DOOR:
            spans += [(start, end, DOOR, height) for start, end in gaps]
        for start, end, low, high in spans:
            middle = (start + end) / 2
            boxes.append(
                (a[0] + ux * middle, a[1] + uy * middle, (low + high) / 2, atan2(uy, ux), end - start, high - low)
            )
    parts = "".join(
        _part(k, f"{x:.6g} {y:.6g} {z:.6g} 0 0 {yaw:.9g}", f"{length:.6g} {thickness:g} {tall:.6g}")
        for k, (x, y, z, yaw, length, tall) in enumerate(boxes)
    )
    return (
        f'<sdf version="1.9"><model name="{name}"><static>true</static><link name="link">{parts}</link></model></sdf>'
    )


def _between(begin: float, end: float, gaps: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    found = []
    for low, high in (*gaps, (end, end)):
        if low - begin >= LEAST:
            found.append((begin, low))
        begin = high
    return found


def _part(number: int, pose: str, size: str) -> str:
    shape = f"<pose>{pose}</pose><geometry><box><size>{size}</size></box></geometry>"
    look = f"<material><ambient>{COLOR}</ambient><diffuse>{COLOR}</diffuse></material>"
    return f'<collision name="c{number}">{shape}</collision><visual name="v{number}">{shape}{look}</visual>'
