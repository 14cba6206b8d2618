"""Each number of a sensor is checked up to its bounds, and a missing one counts with sdformat's default."""

from __future__ import annotations

import pytest

from urdfkit.description.plugins.invalid_sensor_values import senseless_camera, senseless_numbers, senseless_scan
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source


def element(text: str):
    return document_of(Source("f", text))


def scan(fan: str = "", bounds: str = "<min>0.1</min><max>9</max>") -> str:
    return f"<ray><scan><horizontal>{fan}</horizontal></scan><range>{bounds}</range></ray>"


@pytest.mark.parametrize(
    ("inside", "expected"),
    [
        ("<update_rate>0</update_rate>", []),
        (
            "<update_rate>-1</update_rate>",
            ["<update_rate> is -1 Hz; it must not be negative; with zero, the sensor updates at every step"],
        ),
        ("<update_rate>fast</update_rate>", ["<update_rate> is `fast`, not a number"]),
        ("<update_rate/><samples>nan</samples>", []),
        ("<ray><samples>many</samples></ray>", ["<samples> is `many`, not a number"]),
        ("<plugin><samples>many</samples></plugin>", []),
        ("<topic>many</topic>", []),
        ("<max_angle>6.2832</max_angle><min_angle>-6.3</min_angle>", []),
        ("<max_angle>6.4</max_angle>", ["<max_angle> is 6.4 rad, more than a full turn: angles are in radians"]),
        ("<min_angle>-90</min_angle>", ["<min_angle> is -90 rad, more than a full turn: angles are in radians"]),
        ("<samples>90</samples>", []),
    ],
)
def test_numbers(inside: str, expected: list[str]) -> None:
    assert [message for _, message in senseless_numbers(element(f"<sensor>{inside}</sensor>"))] == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<ray/>", [("ray", "the range of the lidar, 0 m to 0 m, is empty")]),
        (scan(), []),
        (scan(bounds="<max>9</max>"), []),
        (scan(bounds="<min>0.1</min>"), [("min", "the range of the lidar, 0.1 m to 0 m, is empty")]),
        (scan(bounds="<min>-1</min><max>-2</max>"), [("min", "<min> is -1 m; it must be zero or greater")]),
        (scan(bounds="<min>5</min><max>5</max>"), [("min", "the range of the lidar, 5 m to 5 m, is empty")]),
        (scan(bounds="<min>5</min><max>far</max>"), []),
        (scan("<samples>1</samples>"), []),
        (scan("<samples>0.5</samples>"), [("samples", "<horizontal> has 0.5 samples; it must have at least one")]),
        (scan("<samples>1.5</samples>"), [("samples", "<samples> is 1.5; it must be a whole number")]),
        (scan("<resolution>0.001</resolution>"), []),
        (
            scan("<resolution>0</resolution>"),
            [("resolution", "<resolution> is 0; it must be greater than zero: it is multiplied by <samples>")],
        ),
        (
            scan("<samples>4</samples><resolution>0.1</resolution>"),
            [("horizontal", "<horizontal> has 4 samples at a resolution of 0.1, which is less than one")],
        ),
        (scan("<min_angle>0</min_angle>"), []),
        (
            scan("<min_angle>1</min_angle>"),
            [("min_angle", "<horizontal> goes from 1 to 0 rad: <min_angle> must be the smaller angle")],
        ),
        (
            scan("<samples>9</samples><min_angle>1</min_angle><max_angle>1</max_angle>"),
            [("min_angle", "<horizontal> has 9 samples, but <min_angle> and <max_angle> are both 1 rad")],
        ),
        (scan("<samples>1</samples><min_angle>1</min_angle><max_angle>1</max_angle>"), []),
        (scan("<samples>9</samples><min_angle>0</min_angle><max_angle>0</max_angle>"), []),
        (
            scan("<max_angle>-1</max_angle>"),
            [("max_angle", "<horizontal> goes from 0 to -1 rad: <min_angle> must be the smaller angle")],
        ),
    ],
)
def test_lidars(text: str, expected: list[tuple[str, str]]) -> None:
    assert [(place.tag, message) for place, message in senseless_scan(element(text))] == expected


@pytest.mark.parametrize(
    ("inside", "is_wide", "expected"),
    [
        ("", False, []),
        ("<horizontal_fov>3.14</horizontal_fov>", False, []),
        (
            "<horizontal_fov>3.15</horizontal_fov>",
            False,
            [("horizontal_fov", "<horizontal_fov> is 3.15 rad; it must be between 0 and π")],
        ),
        ("<horizontal_fov>6.2832</horizontal_fov>", True, []),
        (
            "<horizontal_fov>6.4</horizontal_fov>",
            True,
            [("horizontal_fov", "<horizontal_fov> is 6.4 rad; it must be between 0 and 2π")],
        ),
        (
            "<horizontal_fov>0</horizontal_fov>",
            True,
            [("horizontal_fov", "<horizontal_fov> is 0 rad; it must be between 0 and 2π")],
        ),
        ("<image><width>1</width></image>", False, []),
        (
            "<image><width>0.5</width><height>1.5</height></image>",
            False,
            [
                ("width", "<width> is 0.5; it must be a whole number, one or greater"),
                ("height", "<height> is 1.5; it must be a whole number, one or greater"),
            ],
        ),
        ("<clip><far>0.2</far></clip>", False, []),
        ("<clip><far>0.1</far></clip>", False, [("far", "the range of the camera, 0.1 m to 0.1 m, is empty")]),
        ("<clip><near>99</near></clip>", False, []),
        ("<clip><near>100</near></clip>", False, [("near", "the range of the camera, 100 m to 100 m, is empty")]),
        ("<clip><near>close</near></clip>", False, []),
    ],
)
def test_cameras(inside: str, is_wide: bool, expected: list[tuple[str, str]]) -> None:
    found = senseless_camera(element(f"<camera>{inside}</camera>"), is_wide=is_wide)
    assert [(place.tag, message) for place, message in found] == expected
