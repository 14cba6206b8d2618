"""Stereo pairs: topics, frames, baselines, and that each eye sees from where it is."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.plugins.sensors.cameras.test_cameras import camera, pixels
from tests.sim.plugins.sensors.conftest import heard, noise, sensor, wall
from urdfkit.sim.plugins.sensors.cameras.multicamera import MultiCamera

POST = wall("post", 2.0, 0.0, 0.1, 0.1, role="visual").replace("0 0 20", "0 0 20")
"""A post ahead, against nothing."""


def pair(left: str = "left", right: str = "right", more: str = "") -> str:
    one = camera(321, 240, more=f"<pose>0 0 0 0 0 0</pose>{more}").replace("<camera>", f'<camera name="{left}">')
    other = camera(321, 240, more=f"<pose>0 -0.2 0 0 0 0</pose>{more}").replace("<camera>", f'<camera name="{right}">')
    return one + other


def ros1(more: str = "") -> str:
    return (
        '<plugin name="m" filename="libgazebo_ros_multicamera.so"><cameraName>head</cameraName>'
        f"<frameName>left_optical</frameName><hackBaseline>0.2</hackBaseline>{more}</plugin>"
    )


ROS_2 = """<plugin name="m" filename="libgazebo_ros_camera.so"><ros><namespace>n</namespace></ros>
<camera_name>head</camera_name><hack_baseline>0.2</hack_baseline></plugin>"""


def middle(message) -> float:
    """Return the column in the middle of what is not background."""
    row = pixels(message)[100].astype(int)
    return float(np.flatnonzero(np.abs(row - row[0]).max(axis=1) > 5).mean())


@pytest.mark.parametrize(
    ("plugin", "names", "topics"),
    [
        (ros1(), ("stereo_left", "stereo_right"), ("/head/left", "/head/right")),
        (ROS_2, ("a", "b"), ("/n/head/a", "/n/head/b")),
    ],
)
def test_a_pair_sees_as_far_apart_as_it_is(post, plugin: str, names, topics) -> None:
    simulator = post(sensor(plugin, inside=pair(*names), type="multicamera"), room=POST)
    left, right = (heard(simulator, f"{topic}/image_raw")[-1] for topic in topics)
    infos = [heard(simulator, f"{topic}/camera_info")[-1] for topic in topics]
    assert left.header.frame_id == right.header.frame_id == infos[1].header.frame_id
    f = 321 / (2 * np.tan(0.6))
    assert middle(left) == pytest.approx(160, abs=0.6)
    # The face of the post is at 1.95 m; its sides reach back, which the right eye sees.
    assert middle(left) - middle(right) == pytest.approx(f * 0.2 / 1.95, abs=1.5)
    assert infos[1].p[3] == pytest.approx(-f * 0.2)
    assert infos[0].p[3] == (0.0 if plugin != ROS_2 else pytest.approx(-f * 0.2))
    assert simulator.t > 0


def test_each_eye_has_noise_of_its_own_whoever_listens(post) -> None:
    def seen(*topics: str) -> list[np.ndarray]:
        inside = pair(more=noise(0.05))
        simulator = post(sensor(ros1(), inside=inside, type="multicamera"), room="")
        found: dict[str, list] = {topic: [] for topic in topics}
        for topic in topics:
            simulator.subscribe(topic, "sensor_msgs/msg/Image", found[topic].append)
        simulator.run(0.1)
        return [pixels(found[topic][-1]).astype(int) for topic in topics]

    left, right = seen("/head/left/image_raw", "/head/right/image_raw")
    (alone,) = seen("/head/right/image_raw")
    assert np.array_equal(right, alone)
    assert abs(np.corrcoef(left.ravel(), right.ravel())[0, 1]) < 0.02


def test_only_the_eye_that_is_listened_to_looks(post, monkeypatch) -> None:
    asked: list[int] = []
    seen = MultiCamera._image_of
    monkeypatch.setattr(MultiCamera, "_image_of", lambda self, k, looks: asked.append(k) or seen(self, k, looks))
    simulator = post(sensor(ros1(), inside=pair(), type="multicamera"), room=POST)
    heard(simulator, "/head/right/image_raw", 0.2)
    assert set(asked) == {1}


def test_cameras_that_are_neither_left_nor_right_are_refused_by_name(post) -> None:
    notes: list[str] = []
    post(sensor(ros1(), inside=pair("a", "b"), type="multicamera"), room=POST, note=notes.append)
    (note,) = [each for each in notes if "is ignored" in each]
    assert "recognizes cameras by `left` and `right` in their names; this sensor has `a`, `b`" in note
