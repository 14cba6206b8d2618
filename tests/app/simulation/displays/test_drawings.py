"""The drawing of each type of message and marker, item by item."""

from __future__ import annotations

import base64
import io
import math
from typing import Any

import numpy as np
import pytest

from urdfkit.app.simulation.displays import drawings
from urdfkit.app.simulation.displays.drawings import COLORS, LENGTH, drawing
from urdfkit.app.simulation.displays.markers import drawn_marker, items
from urdfkit.errors import ResourceError
from urdfkit.messages import from_fields

IMAGE = pytest.importorskip("PIL.Image")
POINT = {"x": 1.0, "y": 2.0, "z": 3.0}
TURN = {"x": 0.0, "y": 0.0, "z": 3.0, "w": 4.0}  # its length is 5
POSE = {"position": POINT, "orientation": TURN}
SEVEN = [1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8]
ARROW = {"arrow": SEVEN, "length": LENGTH}
MOTION = {"linear": POINT, "angular": {"x": 4.0, "y": 5.0, "z": 6.0}}


def moved(unit: str, turning: str) -> list[dict[str, Any]]:
    return [
        {"vector": [1.0, 2.0, 3.0], "unit": unit},
        {"vector": [4.0, 5.0, 6.0], "unit": turning, "about": True},
    ]


@pytest.mark.parametrize(
    ("kind", "fields", "expected"),
    [
        ("nav_msgs/msg/Path", {"poses": [{"pose": POSE}] * 2}, [{"line": [1.0, 2.0, 3.0] * 2}]),
        ("geometry_msgs/msg/PoseStamped", {"pose": POSE}, [ARROW]),
        ("geometry_msgs/msg/PoseArray", {"poses": [POSE, POSE]}, [ARROW, ARROW]),
        ("geometry_msgs/msg/PoseWithCovarianceStamped", {"pose": {"pose": POSE}}, [ARROW]),
        (
            "geometry_msgs/msg/PointStamped",
            {"point": POINT},
            [{"shape": "sphere", "pose": [1.0, 2.0, 3.0, 0, 0, 0, 1], "scale": [0.1, 0.1, 0.1]}],
        ),
        (
            "geometry_msgs/msg/PolygonStamped",
            {"polygon": {"points": [POINT, {"x": 7.0}]}},
            [{"line": [1.0, 2.0, 3.0, 7.0, 0.0, 0.0, 1.0, 2.0, 3.0]}],
        ),
        ("geometry_msgs/msg/TwistStamped", {"twist": MOTION}, moved("m/s", "rad/s")),
        ("geometry_msgs/msg/AccelStamped", {"accel": MOTION}, moved("m/s²", "rad/s²")),
        (
            "geometry_msgs/msg/WrenchStamped",
            {"wrench": {"force": POINT, "torque": MOTION["angular"]}},
            moved("N", "N·m"),
        ),
        ("sensor_msgs/msg/Range", {"range": 2.0, "field_of_view": 0.5}, [{"cone": 2.0, "angle": 0.5}]),
        ("sensor_msgs/msg/Range", {"range": math.inf, "field_of_view": 0.5}, []),
        (
            "nav_msgs/msg/GridCells",
            {"cells": [POINT], "cell_width": 0.5, "cell_height": 0.25},
            [{"cells": [1.0, 2.0, 3.0], "size": [0.5, 0.25]}],
        ),
    ],
)
def test_a_message_is_drawn(kind: str, fields: dict[str, Any], expected: list[Any]) -> None:
    assert drawing(from_fields(kind, fields), kind) == expected


def test_values_that_are_not_finite_and_turns_of_length_zero_are_replaced() -> None:
    kind = "geometry_msgs/msg/PoseStamped"
    pose = {"position": {"x": math.nan, "y": math.inf, "z": 1.0}, "orientation": {"w": 0.0}}
    assert drawing(from_fields(kind, {"pose": pose}), kind)[0]["arrow"] == [0, 0, 1, 0, 0, 0, 1]


@pytest.mark.parametrize(
    ("variance", "angles"), [(0.0, []), (0.04, [0.2]), (100.0, [math.pi])], ids=["no yaw", "a yaw", "any yaw"]
)
def test_the_yaw_of_a_covariance_is_a_sector(variance: float, angles: list[float]) -> None:
    kind = "geometry_msgs/msg/PoseWithCovarianceStamped"
    covariance = np.diag([0.09, 0.04, 0.01, 0.0, 0.0, variance]).ravel().tolist()
    _, ellipsoid, *sectors = drawing(from_fields(kind, {"pose": {"pose": POSE, "covariance": covariance}}), kind)
    assert sorted(ellipsoid["axes"]) == pytest.approx([0.1, 0.2, 0.3])
    assert ellipsoid["ellipsoid"][:3] == [1.0, 2.0, 3.0]
    assert sectors == [{"sector": SEVEN, "angle": pytest.approx(angle), "length": LENGTH} for angle in angles]


def test_a_map_has_the_shades_of_its_cells_from_the_top() -> None:
    kind = "nav_msgs/msg/OccupancyGrid"
    info = {"width": 3, "height": 2, "resolution": 0.5, "origin": POSE}
    (item,) = drawing(from_fields(kind, {"info": info, "data": [0, 50, 100, -1, 0, 127]}), kind)
    assert (item["pose"], item["size"]) == (SEVEN, [1.5, 1.0])
    pixels = np.asarray(IMAGE.open(io.BytesIO(base64.b64decode(item["map"]))))
    between = [(a + b) // 2 for a, b in zip(COLORS["free"], COLORS["occupied"], strict=True)]
    unknown, free, occupied = (list(COLORS[name]) for name in ("unknown", "free", "occupied"))
    assert pixels.tolist() == [[unknown, free, occupied], [free, between, occupied]]


def floats(text: str) -> list[float]:
    return [float(value) for value in np.frombuffer(base64.b64decode(text), "<f4")]


SCAN = {
    "angle_min": 0.0,
    "angle_increment": math.pi / 2,
    "range_min": 0.5,
    "range_max": 4.0,
    "ranges": [2.0, 0.4, 4.0, 4.1, math.nan, 0.5],
    "intensities": [10.0, 20.0, 30.0, 40.0, 50.0, 60.0],
}


@pytest.mark.parametrize(
    ("field", "intensities", "values", "fields"),
    [
        ("intensity", True, [10.0, 30.0, 60.0], ["range", "intensity"]),
        ("range", True, [2.0, 4.0, 0.5], ["range", "intensity"]),
        ("", True, [2.0, 4.0, 0.5], ["range", "intensity"]),
        ("intensity", False, [2.0, 4.0, 0.5], ["range"]),
    ],
)
def test_a_scan_has_the_points_within_its_range(
    field: str, intensities: bool, values: list[float], fields: list[str]
) -> None:
    kind = "sensor_msgs/msg/LaserScan"
    message = SCAN if intensities else {**SCAN, "intensities": []}
    (item,) = drawing(from_fields(kind, message), kind, field)
    assert floats(item["points"]) == pytest.approx([2, 0, 0, -4, 0, 0, 0, 0.5, 0], abs=1e-6)
    assert floats(item["values"]) == values
    assert item["range"] == [min(values), max(values)]
    assert (item["count"], item["fields"]) == (3, fields)


def test_a_scan_with_too_few_intensities_shows_ranges() -> None:
    kind = "sensor_msgs/msg/LaserScan"
    (item,) = drawing(from_fields(kind, {**SCAN, "intensities": [1.0]}), kind, "intensity")
    assert floats(item["values"]) == [2.0, 4.0, 0.5]


def test_a_scan_whose_intensities_are_no_numbers_has_the_range_from_0_to_1() -> None:
    kind = "sensor_msgs/msg/LaserScan"
    (item,) = drawing(from_fields(kind, {**SCAN, "intensities": [math.nan] * 6}), kind, "intensity")
    assert (floats(item["values"]), item["range"]) == ([0.0, 0.0, 0.0], [0.0, 1.0])


def cloud(points: np.ndarray, *names: str) -> Any:
    """Return a PointCloud2 with the columns as its fields; bytes of colours are in the field rgb."""
    fields = [{"name": name, "offset": 4 * k, "datatype": 7, "count": 1} for k, name in enumerate(names)]
    data = np.ascontiguousarray(points, "<f4").tobytes()
    return from_fields(
        "sensor_msgs/msg/PointCloud2",
        {"fields": fields, "point_step": 4 * len(names), "width": len(points), "height": 1, "data": list(data)},
    )


def test_points_of_a_cloud_have_the_values_of_a_field_or_their_colours() -> None:
    points = np.array([[1, 2, 3, 7], [4, np.nan, 6, 8], [7, 8, 9, 5]], dtype="<f4")
    kind = "sensor_msgs/msg/PointCloud2"
    for field, values in (("i", [7.0, 5.0]), ("y", [2.0, 8.0])):
        (item,) = drawing(cloud(points, "x", "y", "z", "i"), kind, field)
        assert floats(item["points"]) == [1, 2, 3, 7, 8, 9]
        assert (floats(item["values"]), item["range"]) == (values, [min(values), max(values)])
        assert (item["count"], item["fields"], "colors" in item) == (2, ["x", "y", "z", "i"], False)
    for field in ("", "height", "one colour"):  # the page knows the pose of the frame
        (item,) = drawing(cloud(points, "x", "y", "z", "i"), kind, field)
        assert (item["count"], "values" in item, "colors" in item) == (2, False, False)
    points[:, 3].view("<u4")[:] = [0x102030, 0, 0xFFFEFD]
    for field in ("", "rgb"):
        (item,) = drawing(cloud(points, "x", "y", "z", "rgb"), kind, field)
        assert base64.b64decode(item["colors"]) == bytes([0x10, 0x20, 0x30, 0xFF, 0xFE, 0xFD])
        assert "values" not in item
    assert drawing(cloud(points[:, :2], "x", "y"), kind) == []


def test_large_clouds_are_thinned_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drawings, "MOST_POINTS", 40)
    points = np.zeros((2 * 40 + 1, 3))
    points[:, 0] = np.arange(len(points))
    message = cloud(points, "x", "y", "z")
    (item,) = drawing(message, "sensor_msgs/msg/PointCloud2", "x")
    assert item["count"] == len(points)
    assert floats(item["values"])[:3] == [0.0, 3.0, 6.0]


RED, HALF = {"r": 1.0, "a": 1.0}, {"r": 2.0, "g": 0.5, "b": -1.0, "a": 1.0}
LOOK = {"color": [1.0, 0.5, 0.0, 1.0]}
TWO = [POINT, {"x": 2.0, "y": 4.0, "z": 6.0}]
FLAT = [1.0, 2.0, 3.0, 2.0, 4.0, 6.0]
SCALE = {"scale": [0.1, 0.2, 0.3]}
PLACE = {"pose": SEVEN}


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({"type": 0}, {"arrow": SEVEN, "length": 0.1, "thick": [0.2, 0.4, pytest.approx(0.023)]}),
        ({"type": 0, "scale": {}}, {"arrow": SEVEN, "length": 1.0}),
        (
            {"type": 0, "points": TWO},
            {"vector": [1.0, 2.0, 3.0], "from": [1.0, 2.0, 3.0], "thick": [0.1, 0.2, 0.3], **PLACE},
        ),
        ({"type": 1}, {"shape": "cube", **PLACE, **SCALE}),
        ({"type": 2}, {"shape": "sphere", **PLACE, **SCALE}),
        ({"type": 3}, {"shape": "cylinder", **PLACE, **SCALE}),
        ({"type": 4, "points": TWO}, {"line": FLAT, "width": 0.1, **PLACE}),
        ({"type": 5, "points": TWO}, {"segments": FLAT, "width": 0.1, **PLACE}),
        ({"type": 6, "points": TWO}, {"shape": "cube", "at": FLAT, **PLACE, **SCALE}),
        ({"type": 7, "points": TWO}, {"shape": "sphere", "at": FLAT, **PLACE, **SCALE}),
        ({"type": 8, "points": TWO}, {"dots": FLAT, "size": 0.1, **PLACE}),
        ({"type": 9, "text": "a" * 500}, {"text": "a" * 400, "size": 0.3, **PLACE}),
        ({"type": 9, "text": "a", "scale": {}}, {"text": "a", "size": 0.2, **PLACE}),
        ({"type": 11, "points": TWO}, {"triangles": FLAT, **PLACE, **SCALE}),
        ({"type": 99}, None),
    ],
)
@pytest.mark.parametrize("colors", [[], [RED], [RED, HALF]])
def test_a_marker_is_drawn(fields: dict[str, Any], expected: dict[str, Any] | None, colors: list[Any]) -> None:
    given = {"pose": POSE, "scale": {"x": 0.1, "y": 0.2, "z": 0.3}, "color": HALF, "colors": colors, **fields}
    each = {"colors": [[1, 0, 0, 1], [1, 0.5, 0, 1]]} if len(colors) == 2 and "points" in fields else {}
    found = items(from_fields("visualization_msgs/msg/Marker", given))
    assert found == ([] if expected is None else [{**expected, **LOOK, **each}])


def test_a_mesh_of_a_marker_has_the_name_that_the_page_knows() -> None:
    fields = {"type": 10, "pose": POSE, "scale": {"x": 1.0, "y": 1.0, "z": 2.0}, "color": HALF, "mesh_resource": "uri"}
    for own in (False, True):
        marker = from_fields("visualization_msgs/msg/Marker", {**fields, "mesh_use_embedded_materials": own})
        look = {**LOOK, "own": own}
        assert drawn_marker(marker, str.upper) == ([{"mesh": "URI", "scale": [1, 1, 2], **PLACE, **look}], "")

    def fails(uri: str) -> str:
        raise ResourceError(f"{uri} does not exist")

    assert drawn_marker(marker, fails) == ([], "a marker is not shown: uri does not exist")
