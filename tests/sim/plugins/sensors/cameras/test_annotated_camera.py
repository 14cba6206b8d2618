"""Segmentation and bounding-box cameras: labels, instances, boxes."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.plugins.sensors.cameras.test_cameras import camera, eye, pixels
from tests.sim.plugins.sensors.conftest import heard, wall
from urdfkit.description.urdf.robot import Pose
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.pose_matrices import pose_matrices, pose_matrix
from urdfkit.sim.plugins.sensors.cameras.bounding_boxes import Box3D, draw

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
    assert not [note for note in notes if not note.startswith("compiling")]


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
    ("sensor", "reported"),
    [
        (segmentation("panoptick"), "<segmentation_type> is `panoptick`; it must be semantic, "),
        (
            eye(inside=camera(more="<box_type>full_3d</box_type>"), type="boundingbox"),
            "<box_type> is `full_3d`; it must be 2d, visible_2d, visible_box_2d, ",
        ),
    ],
)
def test_what_is_not_made_is_left_out_by_name(post, sensor: str, reported: str) -> None:
    notes: list[str] = []
    post(sensor, room=ROOM, note=notes.append)
    (note,) = [each for each in notes if "is ignored" in each]
    assert reported in note


def box(name: str, label: int, pose: str, size: str) -> str:
    """Return a model of one box."""
    return (
        f'</model><model name="{name}"><static>true</static>{LABEL.format(label=label)}<link name="l">'
        f'<pose>{pose}</pose><visual name="v"><geometry><box><size>{size}</size></box></geometry></visual></link>'
    )


def boxed(kind: str) -> str:
    inside = camera(201, 101, more=f"<box_type>{kind}</box_type>")
    return eye(inside=inside, type="boundingbox_camera", more="<topic>boxes</topic>")


def sides(message) -> dict[str, tuple[float, ...]]:
    return {
        each.results[0].hypothesis.class_id: (
            each.bbox.center.position.x - each.bbox.size_x / 2,
            each.bbox.center.position.y - each.bbox.size_y / 2,
            each.bbox.center.position.x + each.bbox.size_x / 2,
            each.bbox.center.position.y + each.bbox.size_y / 2,
        )
        for each in message.detections
    }


HALF_HIDDEN = wall("back", 9.0, 0, 0.1, 50, role="visual") + (
    box("front", 3, "2 0.3 0.5 0 0 0", "0.02 0.6 0.9") + box("behind", 4, "3 0 0.5 0 0 0", "0.02 0.8 0.6")
)
"""The camera is 0.5 m up; the left half of what is behind is hidden."""
F = 201 / (2 * np.tan(0.6))


def test_full_boxes_go_round_what_is_hidden_too(post) -> None:
    (message,) = heard(post(boxed("full_2d"), room=HALF_HIDDEN), "/boxes")
    found = sides(message)
    for label, (x, half_y, half_z, y) in {"3": (1.99, 0.3, 0.45, 0.3), "4": (2.99, 0.4, 0.3, 0.0)}.items():
        wanted = (100 - F * (y + half_y) / x, 50 - F * half_z / x, 100 - F * (y - half_y) / x, 50 + F * half_z / x)
        assert np.abs(np.array(found[label]) - wanted).max() <= 0.5
    (message,) = heard(post(boxed("visible_2d"), room=HALF_HIDDEN), "/boxes")
    assert sides(message)["4"][0] == pytest.approx(100, abs=2)  # begins where the front one ends


def test_full_boxes_end_at_the_picture_whatever_is_beside_or_behind_the_camera(post) -> None:
    around = wall("back", 9.0, 0, 0.1, 50, role="visual") + box("wide", 5, "0 -1 0.5 0 0 0", "8 0.02 0.1")
    (message,) = heard(post(boxed("full_2d"), room=around), "/boxes")
    left, top, right, bottom = sides(message)["5"]
    assert right == 200
    assert left == pytest.approx(100 + F * 0.99 / 4, abs=0.5)  # its far end, at 4 m
    assert (top, bottom) == (pytest.approx(0, abs=60), 100 - top)


def test_what_is_not_seen_has_no_box(post) -> None:
    hidden = wall("front", 1.0, 0, 0.1, 50, role="visual") + box("behind", 4, "3 0 0.5 0 0 0", "0.5 0.5 0.5")
    for kind in ("2d", "full_2d", "3d"):
        (message,) = heard(post(boxed(kind), room=hidden), "/boxes")
        assert not message.detections


def test_boxes_in_space_have_place_axes_and_size_of_the_thing(post) -> None:
    room = wall("back", 9.0, 0, 0.1, 50, role="visual") + box("b", 6, "3 0.4 0.7 0.1 0.2 0.3", "0.2 0.4 0.6")
    simulator = post(boxed("3d"), room=room)
    (message,) = heard(simulator, "/boxes")
    (detection,) = message.detections
    (result,) = detection.results
    assert (result.hypothesis.class_id, result.pose.pose.orientation.w) == ("6", 1.0)
    assert result.pose.covariance.tolist() == [0.0] * 36
    assert message.header.frame_id
    centre, turn, size = detection.bbox.center.position, detection.bbox.center.orientation, detection.bbox.size
    assert (centre.x, centre.y, centre.z) == pytest.approx((3.0, 0.4, 0.2), abs=1e-6)
    assert (size.x, size.y, size.z) == pytest.approx((0.2, 0.4, 0.6), abs=1e-6)
    axes = pose_matrices([[0, 0, 0, turn.x, turn.y, turn.z, turn.w]])[0, :3, :3]
    assert axes == pytest.approx(pose_matrix(Pose((0, 0, 0), (0.1, 0.2, 0.3)))[:3, :3], abs=1e-6)
    (picture,) = heard(simulator, "/boxes_image")
    assert 100 < (pixels(picture) == (0, 255, 0)).all(axis=2).sum() < 1000


def test_a_box_that_is_wider_than_the_picture_is_drawn_to_its_borders() -> None:
    lens = Lens(20, 10, 2 * np.arctan(1.0))  # focal length 10 px
    picture = np.zeros((10, 20), dtype=np.uint8)
    draw(picture, Box3D(1, np.array([5.0, 0.0, 0.0]), np.eye(3), np.array([2.0, 12.0, 2.0])), lens, 255)  # type: ignore[arg-type]
    assert np.flatnonzero(picture.all(axis=1)).tolist() == [2, 3, 6, 7]  # edges 4 m and 6 m away
    picture[:] = 0
    draw(picture, Box3D(1, np.array([5.0, 0.0, 0.0]), np.eye(3), np.array([2.0, 2.0, 12.0])), lens, 255)  # type: ignore[arg-type]
    assert np.flatnonzero(picture.all(axis=0)).tolist() == [7, 8, 11, 12]


def test_a_thing_of_several_shapes_has_the_principal_axes_of_its_corners(post) -> None:
    parts = "".join(
        f'<visual name="v{k}"><pose>{x} 0 0 0 0 0</pose>'
        "<geometry><box><size>0.4 0.2 0.1</size></box></geometry></visual>"
        for k, x in enumerate((-0.4, 0.4))
    )
    room = wall("back", 9.0, 0, 0.1, 50, role="visual") + (
        f'</model><model name="two"><static>true</static>{LABEL.format(label=2)}<link name="l">'
        f"<pose>3 0 0.5 0 0 0.5</pose>{parts}</link>"
    )
    (message,) = heard(post(boxed("3d"), room=room), "/boxes")
    (detection,) = message.detections
    centre, size = detection.bbox.center, detection.bbox.size
    assert (centre.position.x, centre.position.y, centre.position.z) == pytest.approx((3, 0, 0), abs=1e-6)
    assert sorted((size.x, size.y, size.z)) == pytest.approx([0.1, 0.2, 1.2], abs=1e-6)
    turn = centre.orientation
    axes = pose_matrices([[0, 0, 0, turn.x, turn.y, turn.z, turn.w]])[0, :3, :3]
    long = axes[:, int(np.argmax((size.x, size.y, size.z)))]
    assert abs(long @ (np.cos(0.5), np.sin(0.5), 0)) == pytest.approx(1, abs=1e-6)
    assert np.linalg.det(axes) == pytest.approx(1)
