"""Maps, paths and markers as coloured points."""

from __future__ import annotations

from typing import Any

import numpy as np

from urdfkit.app.replay.display_points import display_points
from urdfkit.messages import from_fields
from urdfkit.scene.pose_matrices import pose_matrices

FRAME = pose_matrices(np.array((1.0, 2.0, 0.0, 0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5))))[0]
"""A frame that is turned by 90 degrees."""


def shown(type: str, fields: Any) -> tuple[Any, Any]:
    rows = np.frombuffer(display_points(from_fields(type, fields), FRAME), dtype=np.uint8).reshape(-1, 16)
    return np.ascontiguousarray(rows[:, :12]).view("<f4"), rows[:, 12:15]


def test_occupied_cells_of_a_map() -> None:
    info = {"resolution": 0.5, "width": 3, "height": 2, "origin": {"position": {"x": -1.0}, "orientation": {"w": 1.0}}}
    points, _ = shown("nav_msgs/msg/OccupancyGrid", {"info": info, "data": [0, 100, -1, 49, 0, 60]})
    # centres (-0.25, 0.25) and (0.25, 0.75) in the frame
    np.testing.assert_allclose(points, [(1 - 0.25, 2 - 0.25, 0), (1 - 0.75, 2 + 0.25, 0)], atol=1e-6)


def test_a_path_is_a_line_of_points() -> None:
    poses = [{"pose": {"position": {"x": x}}} for x in (0.0, 1.0)]
    points, _ = shown("nav_msgs/msg/Path", {"poses": poses})
    assert len(points) == 51
    np.testing.assert_allclose(points[[0, -1]], [(1, 2, 0), (1, 3, 0)], atol=1e-6)


def test_markers_have_their_colours_and_deleted_ones_are_left_out() -> None:
    sphere = {"type": 2, "pose": {"position": {"x": 1.0}}, "color": {"r": 1.0, "a": 1.0}}
    points, colors = shown("visualization_msgs/msg/MarkerArray", {"markers": [sphere, {**sphere, "action": 2}]})
    np.testing.assert_allclose(points, [(1, 3, 0)], atol=1e-6)
    assert colors.tolist() == [[255, 0, 0]]
