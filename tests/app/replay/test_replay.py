"""Recordings on the page: read in all formats, poses as recorded, and the controls of time."""

from __future__ import annotations

import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("rosbags.rosbag2")

from tests.app.replay.written_bags import Messages, Written, write_bag
from tests.app.simulation.displays.test_displays import Page, shown
from urdfkit.app.page import Page as ServedPage
from urdfkit.app.replay.observed_session import ObservedDisplays
from urdfkit.app.replay.recorded_frames import RecordedFrames
from urdfkit.app.replay.recorded_robot import RecordedRobot
from urdfkit.app.replay.recorded_values import PoseTimeline, Timeline
from urdfkit.app.replay.replaying import replaying
from urdfkit.bridges.bag_file import BagFile
from urdfkit.bridges.recorder import Recorder
from urdfkit.cli import main
from urdfkit.errors import ResourceError, UsageError
from urdfkit.kinematics import Kinematics
from urdfkit.messages import from_fields
from urdfkit.resources import find_model
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim import Simulator

ARM = """<robot name="arm">
  <link name="base"/><link name="upper"/><link name="hand"/><link name="camera"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="wrist" type="prismatic"><parent link="upper"/><child link="hand"/><origin xyz="1 0 0" rpy="0 0.3 0"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="mount" type="fixed"><parent link="hand"/><child link="camera"/><origin xyz="0.1 0 0"/></joint>
</robot>"""


def turned(x: float, y: float, yaw: float) -> tuple[float, ...]:
    return x, y, 0.0, 0.0, 0.0, float(np.sin(yaw / 2)), float(np.cos(yaw / 2))


def arm(tmp_path: Path) -> Kinematics:
    from urdfkit.description.loading import load

    file = tmp_path / "arm.urdf"
    file.write_text(ARM)
    return Kinematics(load(file))


def matrices(poses: Any) -> Any:
    return pose_matrices(poses)


@pytest.mark.parametrize("name", ["a.bag", "a.db3", "a.mcap"])
def test_poses_are_those_of_the_recording_in_every_format(name: str, tmp_path: Path) -> None:
    kinematics, ros = arm(tmp_path), Messages(1 if name.endswith("bag") else 2)
    written: list[Written] = [("/tf_static", 10.0, ros.transforms(10.0, ("map", "odom", turned(5, 0, 0))))]
    for k in range(20):
        t = 10.0 + 0.1 * k
        positions = {"shoulder": 0.1 * k, "wrist": 0.02 * k}
        written.append(("/joint_states", t, ros.joints(t, positions)))
        written.append(("/tf", t, ros.transforms(t, ("odom", "base", turned(0.3 * k, 0, 0.05 * k)))))
    with BagFile(write_bag(tmp_path / name, written)) as bag:
        assert (bag.ros, bag.count, bag.begin) == (1 if name.endswith("bag") else 2, 41, 10.0)
        assert bag.end == pytest.approx(11.9, abs=1e-6)
        robot = RecordedRobot(bag, kinematics)
        assert robot.fixed_frame == "map"
        for k in range(20):
            relative = kinematics.link_poses(kinematics.configuration({"shoulder": 0.1 * k, "wrist": 0.02 * k}))
            base = matrices(turned(5 + 0.3 * k, 0, 0.05 * k))[0]
            found = matrices(robot.link_poses(10.0 + 0.1 * k))
            np.testing.assert_allclose(found, base @ matrices(relative), atol=1e-9)


@pytest.mark.slow
def test_a_recorded_simulation_is_replayed_with_its_poses(tmp_path: Path) -> None:
    simulator = Simulator("simpleton")
    simulator.command((0.5, 0, 0), (0, 0, 0.8))
    expected = []
    with Recorder(simulator.bus, tmp_path / "run.mcap", lambda: simulator.t) as recorder:
        for _ in range(20):
            simulator.run(0.1)
            recorder.subscribe_new_topics()
            expected.append((simulator.t, simulator.link_poses().copy()))
    with BagFile(tmp_path / "run.mcap") as bag:
        robot = RecordedRobot(bag, simulator.kinematics)
        worst = 0.0
        for t, poses in expected:
            found, true = robot.link_poses(t), matrices(poses)
            worst = max(worst, float(np.abs(matrices(found)[:, :3] - true[:, :3]).max()))
    assert worst < 2e-3  # odometry: the height of the root link and slip are not in it


def test_displays_are_drawn_in_the_recorded_frames(tmp_path: Path) -> None:
    ros, kind = Messages(2), "nav_msgs/msg/Path"
    written: list[Written] = [
        ("/tf_static", 0.0, ros.transforms(0.0, ("map", "odom", turned(5, 0, 0)))),
        ("/tf", 0.0, ros.transforms(0.0, ("odom", "base", turned(1, 0, 0)))),
        ("/joint_states", 30.0, ros.joints(30.0, {"wrist": 0.0})),
    ]
    arm(tmp_path)
    with (
        BagFile(write_bag(tmp_path / "a.mcap", written)) as bag,
        replaying(ServedPage("sim", port=0), bag, find_model([str(tmp_path / "arm.urdf")])) as session,
    ):
        page = Page()
        displays = ObservedDisplays(session, page, lambda: session.t)  # type: ignore[arg-type]
        for frame, x in (("odom", 5.0), ("map", 0.0), ("base", 6.0), ("mars", None)):
            session.bus.publish(f"/in_{frame}", kind, from_fields(kind, {"header": {"frame_id": frame}}))
            drawn = shown((session, page, displays), f"/in_{frame}")  # type: ignore[arg-type]
            if x is None:
                assert drawn["fault"] == "no transform from frame mars to a link of the robot"
            else:
                (group,) = drawn["groups"]
                assert group["pose"] == pytest.approx([x, 0, 0, 0, 0, 0, 1])


def test_recorded_transforms_of_links_win_over_joint_states(tmp_path: Path) -> None:
    kinematics, ros = arm(tmp_path), Messages(2)
    written: list[Written] = [
        ("/joint_states", 0.0, ros.joints(0.0, {"shoulder": 1.0})),
        ("/tf", 0.0, ros.transforms(0.0, ("r1/base", "r1/upper", turned(0, 2, 0)))),
    ]
    with BagFile(write_bag(tmp_path / "a.mcap", written)) as bag:
        robot = RecordedRobot(bag, kinematics)
        assert robot.fixed_frame == "r1/base"
        poses = dict(zip(kinematics.link_names, robot.link_poses(0.0), strict=True))
    np.testing.assert_allclose(poses["upper"][:3], (0, 2, 0))
    np.testing.assert_allclose(poses["hand"][:3], (1, 2, 0))


def test_values_between_two_messages_are_interpolated() -> None:
    line, poses = Timeline(), PoseTimeline()
    for t, value in ((1.0, 2.0), (2.0, 4.0), (1.5, 2.5)):
        line.add(t, (value,))
    assert [float(line.at(t)[0]) for t in (0.0, 1.0, 1.25, 1.75, 9.0)] == [2.0, 2.0, 2.25, 3.25, 4.0]
    poses.add(0.0, turned(0, 0, 0.0))
    poses.add(1.0, tuple(-x for x in turned(0, 0, 0.4)))
    np.testing.assert_allclose(np.abs(poses.at(0.5)), np.abs(turned(0, 0, 0.2)), atol=1e-12)
    poses.add(2.0, (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0))  # half a turn about x
    assert np.linalg.norm(poses.at(1.5)[3:]) == pytest.approx(1.0)


def test_a_value_replaces_one_of_the_same_time_and_the_oldest_ones_are_dropped() -> None:
    line, short = Timeline(), Timeline(2)
    for t, value in ((1.0, 1.0), (2.0, 2.0), (3.0, 3.0), (3.0, 5.0), (1.0, 4.0), (2.0, 6.0), (0.0, 8.0)):
        line.add(t, (value,))
        short.add(t, (value,))
    assert [float(line.at(t)[0]) for t in (0.0, 1.0, 2.0, 2.5, 3.0)] == [8.0, 4.0, 6.0, 5.5, 5.0]
    assert [float(short.at(t)[0]) for t in (0.0, 2.0, 2.5, 3.0)] == [6.0, 6.0, 5.5, 5.0]


def test_frames_without_a_common_ancestor_have_no_transform_and_loops_end() -> None:
    frames, ros = RecordedFrames(), Messages(2)
    frames.add(0.0, ros.transforms(0.0, ("a", "b", turned(1, 0, 0)), ("c", "d", turned(0, 0, 0))))
    assert frames.transform("a", "d", 0.0) is None
    found = frames.transform("b", "a", 0.0)
    assert found is not None
    np.testing.assert_allclose(found[:3, 3], (-1, 0, 0))
    frames.add(0.0, ros.transforms(0.0, ("b", "a", turned(0, 0, 0)), ("x", "x", turned(0, 0, 0))))
    assert frames.ancestors("a") == ["a", "b"]
    assert "x" not in frames


def test_bag_info(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ros = Messages(1)
    joints = [("/joint_states", 0.5 * k, ros.joints(k, {})) for k in range(21)]
    late = [("/late", 1.55 + 0.1 * k, ros.joints(k, {})) for k in range(4)]
    file = write_bag(tmp_path / "a.bag", sorted(joints + late, key=lambda message: message[1]))
    assert main(["bag", "info", str(file)]) == 0
    assert capsys.readouterr().out.splitlines() == [
        f"{file}: ROS 1, 25 messages in 10.000 s, from 0.000 s",
        "/joint_states  sensor_msgs/msg/JointState       21     2.00 Hz",
        "/late          sensor_msgs/msg/JointState        4    10.00 Hz",
    ]
    assert main(["bag", "info", str(file), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["topics"][0] == {"name": "/joint_states", "type": "sensor_msgs/msg/JointState", "messages": 21}
    file = write_bag(tmp_path / "empty.bag", [])
    assert main(["bag", "info", str(file)]) == 0
    assert capsys.readouterr().out == f"{file}: ROS 1, 0 messages in 0.000 s, from 0.000 s\n"


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("a.mcap", b"nothing", "its content does not have the format of a .mcap file"),
        ("a.db3", b"\x89PNG", "its content does not have the format of a .db3 file"),
        ("a.bag", b"\x89PNG", "its content does not have the format of a .bag file"),
        ("a.bag", b"", "its content does not have the format of a .bag file"),
        ("a.txt", b"", "recordings are .mcap, .db3, .bag files"),
    ],
)
def test_files_that_are_no_recordings_are_refused(name: str, content: bytes, reason: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ResourceError) as refused:
        BagFile(tmp_path / name)
    assert str(refused.value) == f"{tmp_path / name} is not a recording: {reason}"
    with pytest.raises(ResourceError, match="no such file"):
        BagFile(tmp_path / "missing.mcap")


def test_unfinished_files_and_folders_without_metadata_are_named(tmp_path: Path) -> None:
    ros = Messages(2)
    file = write_bag(tmp_path / "a.mcap", [("/joint_states", 0.1 * k, ros.joints(k, {})) for k in range(5)])
    unfinished = tmp_path / "b.mcap"
    unfinished.write_bytes(next(file.glob("*.mcap")).read_bytes()[:-20])
    with pytest.raises(ResourceError, match="its end is missing"):
        BagFile(unfinished)
    (tmp_path / "folder").mkdir()
    with pytest.raises(ResourceError, match=r"metadata\.yaml"):
        BagFile(tmp_path / "folder")


def test_an_unknown_fixed_frame_is_refused(tmp_path: Path) -> None:
    kinematics, ros = arm(tmp_path), Messages(2)
    written: list[Written] = [("/tf", 0.0, ros.transforms(0.0, ("odom", "base", turned(0, 2, 0))))]
    with BagFile(write_bag(tmp_path / "a.mcap", written)) as bag:
        with pytest.raises(UsageError, match="no frame `nope` in the recording"):
            RecordedRobot(bag, kinematics, fixed_frame="nope")
        assert RecordedRobot(bag, kinematics, fixed_frame="base").fixed_frame == "base"


def test_without_a_description_the_robot_has_to_be_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ros = Messages(2)
    file = write_bag(tmp_path / "a.mcap", [("/joint_states", 0.0, ros.joints(0.0, {}))])
    assert main(["replay", str(file), "--no-browser", "--port", "0"]) == 2
    assert "contains no robot description: name the robot" in capsys.readouterr().err


def test_messages_can_be_pickled_after_a_recording_was_read(tmp_path: Path) -> None:
    ros = Messages(2)
    sent = from_fields("gazebo_msgs/msg/ModelStates", {"name": ["box"]})
    with BagFile(write_bag(tmp_path / "a.mcap", [("/joint_states", 0.0, ros.joints(0.0, {}))])):
        assert pickle.loads(pickle.dumps(sent)).name == ["box"]
