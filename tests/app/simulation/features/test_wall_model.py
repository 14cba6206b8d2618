"""Walls drawn on the page: where their boxes are, the doors, and what cannot be built."""

from __future__ import annotations

import re
from math import atan2
from xml.etree import ElementTree

import pytest

from urdfkit.app.simulation.features.wall_model import walls
from urdfkit.errors import SimulationError

Corners = list[tuple[float, float]]


def boxes(document: str) -> list[tuple[tuple[float, ...], tuple[float, ...]]]:
    """Return (x, y, z, yaw) and size of each box; collisions and visuals must be the same."""
    link = ElementTree.fromstring(document).find("model/link")
    assert link is not None
    found: dict[str, list[tuple[tuple[float, ...], tuple[float, ...]]]] = {"collision": [], "visual": []}
    for part in link:
        x, y, z, roll, pitch, yaw = (float(each) for each in part.findtext("pose", "").split())
        size = tuple(float(each) for each in part.findtext("geometry/box/size", "").split())
        assert (roll, pitch) == (0.0, 0.0)
        assert part.get("name") == f"{part.tag[0]}{len(found[part.tag])}"
        found[part.tag].append(((x, y, z, yaw), size))
    assert found["collision"] == found["visual"]
    return found["collision"]


def near(*rows: tuple[tuple[float, ...], tuple[float, ...]]) -> list[tuple[object, object]]:
    return [(pytest.approx(pose, abs=1e-5), pytest.approx(size, abs=1e-5)) for pose, size in rows]


def test_each_wall_is_a_box_from_corner_to_corner_and_half_its_thickness_beyond() -> None:
    corners: Corners = [(1, 2), (4, 6), (4, 6.01), (4, -1)]  # the second one is too short to be built
    document = walls("room", corners, height=1.5, thickness=0.2)
    assert ElementTree.fromstring(document).find("model").attrib == {"name": "room"}  # type: ignore[union-attr]
    assert ElementTree.fromstring(document).findtext("model/static") == "true"
    assert boxes(document) == near(
        ((2.5, 4.0, 0.75, atan2(4, 3)), (5.2, 0.2, 1.5)),
        ((4.0, 2.505, 0.75, -atan2(1, 0)), (7.21, 0.2, 1.5)),
    )


def test_a_wall_as_long_as_the_shortest_piece_is_built() -> None:
    assert len(boxes(walls("w", [(0, 0), (0.02, 0)]))) == 1


def test_a_wall_continues_above_its_doors_where_it_is_higher() -> None:
    corners: Corners = [(0, 0), (3, 4)]
    doors = [{"segment": 0, "at": 4.0, "width": 1.0}, {"segment": 0, "at": 1.0, "width": 0.5}]
    yaw = atan2(4, 3)

    def part(start: float, end: float, low: float, high: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
        middle = (start + end) / 2
        return (0.6 * middle, 0.8 * middle, (low + high) / 2, yaw), (end - start, 0.1, high - low)

    pieces = [(-0.05, 0.75), (1.25, 3.5), (4.5, 5.05)]
    low = [part(*piece, 0.0, 2.0) for piece in pieces]
    assert boxes(walls("w", corners, doors, height=2.0, thickness=0.1)) == near(*low)
    high = [part(*piece, 0.0, 2.5) for piece in pieces] + [part(0.75, 1.25, 2.0, 2.5), part(3.5, 4.5, 2.0, 2.5)]
    assert boxes(walls("w", corners, doors, height=2.5, thickness=0.1)) == near(*high)


def test_doors_touch_each_other_and_the_ends_of_their_wall() -> None:
    corners: Corners = [(0, 0), (2, 0), (2, 2)]
    doors = [{"segment": 1, "at": 0.5, "width": 1.0}, {"segment": 1, "at": 1.5, "width": 1.0}]
    found = boxes(walls("w", corners, doors, height=2.0))
    assert [size[0] for _, size in found] == pytest.approx([2.15, 0.075, 0.075])  # what reaches beyond the corners


@pytest.mark.parametrize(
    ("corners", "doors", "line"),
    [
        ([(0, 0), (0, 0)], [], "a wall needs two different corners"),
        ([(0, 0), (0, 0.019)], [], "a wall needs two different corners"),
        ([(0, 0), (1, 0)], [(1, 0.5, 0.5)], "a door is in wall 1, but the last wall is 0"),
        ([(0, 0), (1, 0)], [(0, 0.76, 0.5)], "a door 0.5 m wide does not fit at 0.76 m into a wall of 1 m"),
        ([(0, 0), (1, 0)], [(0, 0.24, 0.5)], "a door 0.5 m wide does not fit at 0.24 m into a wall of 1 m"),
        ([(1, 1), (5, 1)], [(0, 1, 1), (0, 1.9, 1)], "two doors of wall 0 overlap"),
    ],
)
def test_walls_that_cannot_be_built(corners: Corners, doors: list[tuple[int, float, float]], line: str) -> None:
    given = [{"segment": segment, "at": at, "width": width} for segment, at, width in doors]
    with pytest.raises(SimulationError, match=re.escape(line)):
        walls("w", corners, given)
