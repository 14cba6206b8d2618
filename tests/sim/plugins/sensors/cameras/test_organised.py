"""Organised clouds next to closed forms: every point where its ray meets a sphere or a box, edges included."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import heard
from tests.sim.plugins.sensors.test_cloud_messages import rows

BALLS = (((4.0, 0.3, 1.1), 0.7), ((2.2, -0.9, 0.8), 0.25))
BOXES = (
    ((3.2, 1.2, 0.5), (0.6, 0.8, 1.0), 0.4),
    ((2.0, 0.45, 0.9), (0.1, 0.2, 0.3), 1.0),
    ((5.0, 0.0, -0.1), (9.0, 8.0, 0.2), 0.0),
)
"""Centre [m], size [m] and yaw [rad]."""
EYE = np.array([0.0, 0.0, 0.5])

CAMERA = """<sensor name="camera" type="depth_camera"><topic>camera</topic><update_rate>10</update_rate><camera>
<horizontal_fov>1.2</horizontal_fov><image><width>320</width><height>240</height></image>
<clip><near>0.05</near><far>60</far></clip></camera></sensor>"""
LIDAR = """<sensor name="lidar" type="gpu_lidar"><topic>lidar</topic><update_rate>10</update_rate><lidar><scan>
<horizontal><samples>400</samples><min_angle>-0.9</min_angle><max_angle>0.9</max_angle></horizontal>
<vertical><samples>64</samples><min_angle>-0.6</min_angle><max_angle>0.4</max_angle></vertical></scan>
<range><min>0.1</min><max>60</max></range></lidar></sensor>"""


def room() -> str:
    solids = [(at, 0.0, f"<sphere><radius>{radius}</radius></sphere>") for at, radius in BALLS]
    solids += [(at, yaw, f"<box><size>{' '.join(map(str, size))}</size></box>") for at, size, yaw in BOXES]
    return "".join(
        f'<link name="l{k}"><pose>{" ".join(map(str, at))} 0 0 {yaw}</pose><visual name="v"><geometry>{solid}'
        "</geometry></visual></link>"
        for k, (at, yaw, solid) in enumerate(solids)
    )


def meet(rays: np.ndarray) -> np.ndarray:
    """Return how far off the first solid is along unit vectors from `EYE`, by the quadratic formula and by slabs."""
    found = np.full(len(rays), np.inf)
    for at, radius in BALLS:
        off = EYE - np.array(at)
        half = rays @ off
        under = half**2 - (off @ off - radius**2)
        found = np.where(under >= 0.0, np.minimum(found, -half - np.sqrt(np.maximum(under, 0.0))), found)
    for at, size, yaw in BOXES:
        c, s = np.cos(yaw), np.sin(yaw)
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        one, other = ((side * np.array(size) / 2 - (EYE - at) @ turn) / (rays @ turn) for side in (-1, 1))
        into, out = np.minimum(one, other).max(axis=1), np.maximum(one, other).min(axis=1)
        found = np.where((into <= out) & (into > 0.0), np.minimum(found, into), found)
    return found


def pixels() -> np.ndarray:
    """Return where each pixel of the camera looks, by its field of view; shape (320 · 240, 3)."""
    row, column = np.mgrid[0:240, 0:320]
    f = 160 / np.tan(0.6)
    rays = np.dstack([np.full(row.shape, f), 159.5 - column, 119.5 - row]).reshape(-1, 3)
    return rays / np.linalg.norm(rays, axis=1, keepdims=True)


def beams() -> np.ndarray:
    """Return where each beam of the lidar looks, by its angles; shape (64 · 400, 3)."""
    up, left = (
        each.ravel() for each in np.meshgrid(np.linspace(-0.6, 0.4, 64), np.linspace(-0.9, 0.9, 400), indexing="ij")
    )
    return np.column_stack([np.cos(up) * np.cos(left), np.cos(up) * np.sin(left), np.sin(up)])


@pytest.mark.parametrize(
    ("sensor", "topic", "rays"), [(CAMERA, "/camera/points", pixels()), (LIDAR, "/lidar/points", beams())]
)
def test_every_point_is_where_its_ray_meets_something(post, sensor: str, topic: str, rays: np.ndarray) -> None:
    (message,) = heard(post(sensor, room=room()), topic)
    points = rows(message)
    xyz = np.column_stack([points[axis] for axis in "xyz"]).astype(float)
    seen, true = np.isfinite(xyz).all(axis=1), meet(rays)
    assert np.array_equal(seen, np.isfinite(true))
    assert seen.sum() > 0.4 * len(rays)
    assert np.abs(xyz[seen] - true[seen, None] * rays[seen]).max() < 3e-6
