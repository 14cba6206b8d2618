"""The controls of a replay: time, speed, pause, end, jumps and repetition."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("rosbags.rosbag2")

from tests.app.replay.test_replay import arm
from tests.app.replay.written_bags import Messages, Written, write_bag
from urdfkit.app.replay.recorded_robot import RecordedRobot
from urdfkit.app.replay.replay_session import ReplaySession
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.bridges.bag_file import BagFile
from urdfkit.resources import find_model
from urdfkit.view.protocol.page_requests import check
from urdfkit.view.protocol.websocket_messages import RawRequest
from urdfkit.view.server.server import Server

BEGIN, DURATION = 10.0, 4.0


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


class Replay:
    """A session with a clock that a test sets, and the values that a subscriber has received."""

    def __init__(self, bag: BagFile, file: Path, *, loop: bool) -> None:
        self.clock, self.received = Clock(), list[float]()
        self.server = Server("sim", port=0)
        shown = ShownRobot.read(find_model([str(file)]))
        robot = RecordedRobot(bag, shown.kinematics)
        self.session = ReplaySession(bag, shown, robot, self.server, loop=loop, clock=self.clock)
        self.session.bus.subscribe(
            "/joint_states", "sensor_msgs/msg/JointState", lambda message: self.received.append(message.position[0])
        )

    def after(self, seconds: float) -> float:
        """Return the time of the replay after some time."""
        self.clock.now += seconds
        self.session.advance()
        return self.session.t

    def request(self, name: str, **values: Any) -> None:
        self.server.inbox.put_request(check(self.server.requests, 1, RawRequest(1, name, values)))
        self.session.tick()


@pytest.fixture(params=[False])
def replay(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Replay]:
    arm(tmp_path)
    ros = Messages(2)
    written: list[Written] = [
        ("/joint_states", BEGIN + k, ros.joints(BEGIN + k, {"shoulder": float(k)})) for k in range(int(DURATION) + 1)
    ]
    with BagFile(write_bag(tmp_path / "a.mcap", written)) as bag:
        found = Replay(bag, tmp_path / "arm.urdf", loop=request.param)
        yield found
        found.server.stop()


def test_messages_are_published_at_their_time_and_the_replay_stops_at_the_end(replay: Replay) -> None:
    session = replay.session
    assert (session.duration, session.t, session.time_of_poses()) == (DURATION, 0.0, BEGIN)
    assert replay.after(0.5) == 0.5
    assert replay.received == [0.0]
    assert replay.after(1.5) == 2.0
    assert replay.received == [0.0, 1.0, 2.0]
    assert session.time_of_poses() == BEGIN + 2.0
    assert replay.after(1.9) == pytest.approx(3.9)
    assert session.running
    assert replay.after(3.0) == DURATION
    assert replay.received == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert not session.running
    status = session.status()
    assert (status["paused"], status["real_time_factor"], status["factor"]) == (True, 1.0, 1.0)
    session.act("play")  # at the end, from the beginning
    assert session.running
    assert replay.after(0.25) == 0.25
    assert replay.received[5:] == [0.0]


@pytest.mark.parametrize("replay", [True], indirect=True)
def test_a_replay_in_a_loop_begins_again(replay: Replay) -> None:
    assert replay.after(DURATION) == 0.0
    assert replay.session.running
    assert replay.received == [0.0]
    assert replay.after(1.0) == 1.0


def test_buttons_pause_continue_and_begin_again(replay: Replay) -> None:
    session = replay.session
    assert replay.after(1.0) == 1.0
    session.act("pause")
    assert session.status()["paused"]
    assert replay.after(1.0) == 1.0
    session.act("play")
    assert replay.after(0.5) == 1.5
    session.act("reset")
    assert replay.after(0.5) == 0.5


def test_requests_jump_and_set_the_speed(replay: Replay) -> None:
    session = replay.session
    replay.request("replay", action="pause", at=2.5, speed=2.0)
    assert (session.t, session.running, session.speed) == (2.5, False, 2.0)
    assert replay.after(1.0) == 2.5
    assert replay.received == []  # those before are not published
    replay.request("replay", action="play")
    assert replay.after(0.25) == 3.0
    assert replay.received == [3.0]
    replay.request("replay", action="show", at=99.0)
    assert session.t == DURATION
    replay.request("replay", action="play", at=1.0)
    replay.request("speed", factor=0.5)
    assert replay.after(1.0) == 1.5
    replay.request("replay", action="end")
    assert not session.running


def test_the_page_gets_the_state_of_the_controls(replay: Replay, monkeypatch: pytest.MonkeyPatch) -> None:
    sent: dict[str, dict[str, Any]] = {}
    monkeypatch.setattr(replay.server, "broadcast", lambda name, **values: sent.update({name: values}))
    replay.after(1.5)
    replay.session.act("pause")
    replay.session.report()
    assert sent["recorder"] == {
        "recording": False,
        "topics": False,
        "begin": 0.0,
        "end": DURATION,
        "frames": 5,
        "playing": True,
        "running": False,
        "at": 1.5,
        "file": "a",
    }
