"""Segmentation and bounding-box cameras: labels, instances, boxes."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.sensors.conftest import heard, wall
from tests.sim.sensors.test_cameras import camera, eye, pixels

LABEL = '<plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>{label}</label></plugin>'


def thing(name: str, y: float, label: int | None, inner: str = "") -> str:
    """Return a model: a post 2 m ahead, 0.2 m wide, and whatever else is in it."""
    written = "" if label is None else LABEL.format(label=label)
    shape = wall("l", 2.0, y, 0.1, 0.2, role="visual").replace("</visual>", f"{inner}</visual>")
    return f'</model><model name="{name}"><static>true</static>{written}{shape}'


ROOM = (
    wall("back", 4.0, 0, 0.1, 50, role="visual")
    + thing("a", 0.6, 7)
    + thing("b", 0.0, 7)
    + thing("c", -0.6, None, LABEL.format(label=9))
)
"""Two of label 7, one of label 9, by its visual; a wall behind that has none."""


def columns(y: float, width: int = 201) -> tuple[float, float]:
    """Return where the sides of the post at `y` are in the picture [px]."""
    f = width / (2 * np.tan(0.6))
    low, high = sorted((width - 1) / 2 - f * (y + half) / 1.95 for half in (-0.1, 0.1))
    return low, high


def segmentation(kind: str) -> str:
    inside = camera(201, 100, more=f"<segmentation_type>{kind}</segmentation_type>")
    return eye(inside=inside, type="segmentation", more="<topic>seg</topic>")


def test_labels_are_where_things_are(post) -> None:
    notes: list[str] = []
    simulator = post(segmentation("semantic"), room=ROOM, note=notes.append)
    (message,) = heard(simulator, "/seg/labels_map")
    found = pixels(message)
    assert (found == found[..., :1]).all()
    for y, label in ((0.6, 7), (0.0, 7), (-0.6, 9)):
        low, high = columns(y)
        assert (found[50, int(low) + 2 : int(high) - 1, 0] == label).all()
    assert found[50, 0, 0] == 0
    assert set(np.unique(found)) == {0, 7, 9}
    (colored,) = heard(simulator, "/seg/colored_map")
    colors = pixels(colored)
    assert len(np.unique(colors.reshape(-1, 3), axis=0)) == 3
    assert (colors[found[..., 0] == 0] == 0).all()
    assert {t.name for t in simulator.bus.topics} >= {"/seg/camera_info"}
    assert not notes


def test_instances_are_counted_for_each_label(post) -> None:
    simulator = post(segmentation("panoptic"), room=ROOM)
    (message,) = heard(simulator, "/seg/labels_map")
    found = pixels(message)[50]
    middles = [found[round(sum(columns(y)) / 2)].tolist() for y in (0.6, 0.0, -0.6)]
    assert middles == [[1, 0, 7], [2, 0, 7], [1, 0, 9]]
    (colored,) = heard(simulator, "/seg/colored_map")
    assert len(np.unique(pixels(colored).reshape(-1, 3), axis=0)) == 4


def test_boxes_go_round_what_is_seen(post) -> None:
    simulator = post(eye(inside=camera(201, 100), type="boundingbox_camera", more="<topic>boxes</topic>"), room=ROOM)
    (message,) = heard(simulator, "/boxes")
    assert [each.results[0].hypothesis.class_id for each in message.detections] == ["7", "9", "7"]
    sides = {
        (each.bbox.center.position.x, each.bbox.size_x, each.bbox.center.position.y, each.bbox.size_y)
        for each in message.detections
    }
    for y in (0.6, 0.0, -0.6):
        low, high = columns(y)
        # A side that is turned towards the middle is seen, too, 5 cm behind and in front of the face at 1.95 m.
        ((x, width, row, height),) = [each for each in sides if abs(each[0] - (low + high) / 2) < 4]
        assert width == pytest.approx(high - low, abs=4)
        assert (row, height) == (49.5, 99.0)
        assert x is not None
    (picture,) = heard(simulator, "/boxes_image")
    green = (pixels(picture) == (0, 255, 0)).all(axis=2)
    assert green[0].sum() > 40
    assert 0 < green.mean() < 0.2


@pytest.mark.parametrize(
    ("sensor", "said"),
    [
        (segmentation("panoptick"), "<segmentation_type> is `panoptick`; did you mean `panoptic`?; it must be"),
        (
            eye(inside=camera(more="<box_type>3d</box_type>"), type="boundingbox"),
            "boxes of type `3d` are not made; there are 2d, visible_2d, visible_box_2d",
        ),
    ],
)
def test_what_is_not_made_is_left_out_by_name(post, sensor: str, said: str) -> None:
    notes: list[str] = []
    post(sensor, room=ROOM, note=notes.append)
    (note,) = [each for each in notes if "left out" in each]
    assert said in note
