"""A live robot on the page, and the command ``topic`` on its graph: a simulation stands for the robot."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from tests.app.replay.written_bags import Messages, write_bag
from tests.served_simulation import rosbridge
from tests.time_limit import PATIENCE
from urdfkit.app.page import Page
from urdfkit.app.replay.live_view import following
from urdfkit.app.replay.observed_session import ObservedSession
from urdfkit.app.replay.replaying import replaying
from urdfkit.app.simulation.bridging.bridges import BridgeOptions
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.bridges.bag_file import BagFile
from urdfkit.bridges.node.node import Quality
from urdfkit.bridges.rosbridge.rosbridge_node import RosbridgeNode
from urdfkit.bridges.websocket.address import Address
from urdfkit.cli import main
from urdfkit.resources import find_model
from urdfkit.sim import Simulator
from urdfkit.view.protocol.websocket_messages import Axes

pytestmark = pytest.mark.slow


def until(session: ObservedSession, condition: Callable[[], Any]) -> None:
    for _ in range(int(PATIENCE / 0.01)):
        session.tick()
        if condition():
            return
        session._sleep(0.01)
    pytest.fail("the condition did not become true in time")


def test_the_page_follows_a_robot_on_rosbridge_and_drives_it() -> None:
    simulator = Simulator("simpleton")
    with rosbridge(simulator) as url:
        shown = ShownRobot.read(find_model(["simpleton"]))
        with following(Page("sim", port=0), shown, url, pytest.fail) as session:
            until(session, lambda: session.bus.latest("/simpleton/odom"))
            forward = Axes((1.0, 0.0, 0.0, 0.0), speed=1.0, turn=1.0)
            session.server.drive_lock.update(1, forward)
            root = shown.kinematics.link_names.index(shown.kinematics.root)

            def ahead() -> bool:
                session.server.drive_lock.update(1, forward)
                return bool(session._robot.link_poses(0.0)[root][0] > 0.2)

            until(session, ahead)
            assert session._robot.fixed_frame == "odom"
            session.act("stop")
            until(session, lambda: abs(simulator.state.v[0]) < 1e-3)
            x = simulator.state.base_pose[0]
            until(session, lambda: session._robot.link_poses(0.0)[root][0] == pytest.approx(x, abs=0.01))


def test_topic_lists_echoes_and_publishes_on_another_graph(capsys: pytest.CaptureFixture[str]) -> None:
    simulator = Simulator("simpleton")
    speeds: list[float] = []
    simulator.bus.subscribe("/simpleton/cmd_vel", "geometry_msgs/msg/Twist", lambda it: speeds.append(it.linear.x))
    with rosbridge(simulator) as url:
        assert main(["topic", "list", "-t", "--json", "--live", url]) == 0
        rows = {row["name"]: row["type"] for row in json.loads(capsys.readouterr().out)}
        assert rows["/simpleton/odom"] == "nav_msgs/msg/Odometry"
        assert main(["topic", "echo", "/simpleton/odom", "--once", "--json", "--live", url]) == 0
        assert json.loads(capsys.readouterr().out)["child_frame_id"] == "base_footprint"
        assert main(["service", "call", "/get_current_world", "--json", "--live", url]) == 0
        assert json.loads(capsys.readouterr().out)["world"]["name"] == "empty"
        assert main(["service", "type", "/gazebo/delete_model", "--live", url]) == 0
        assert capsys.readouterr().out == "gazebo_msgs/srv/DeleteModel\n"
        words = ["pub", "/simpleton/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.25}}", "--once"]
        assert main(["topic", *words, "--live", url]) == 0
        end = time.monotonic() + PATIENCE
        while not speeds and time.monotonic() < end:
            time.sleep(0.01)
    assert speeds == [0.25]
    assert main(["topic", "list", "--live", "ros3"]) == 2
    assert "use ros1, ros2 or rosbridge://HOST:PORT" in capsys.readouterr().err
    assert main(["topic", "list", "--live", "rosbridge://127.0.0.1:9"]) == 2
    assert "no server of rosbridge responds" in capsys.readouterr().err


def test_a_recording_is_published_on_rosbridge_with_the_time(tmp_path: Path) -> None:
    ros, type = Messages(1), "sensor_msgs/msg/JointState"
    times = [10.0 + 0.1 * k for k in range(20)]
    written = [("/joint_states", t, ros.joints(t, {"left_wheel_joint": t})) for t in times]
    received: dict[str, Any] = {}
    with (
        BagFile(write_bag(tmp_path / "a.bag", written)) as bag,
        replaying(Page("sim", port=0), bag, find_model(["simpleton"]), loop=True) as session,
    ):
        session.open_bridges(BridgeOptions(rosbridge=Address("127.0.0.1", 0)), pytest.fail)
        (server,) = session.bridges._open
        node = RosbridgeNode(server.urls[0].replace("ws", "rosbridge", 1), lambda line: None)  # type: ignore[attr-defined]
        for name, kind in (("/joint_states", type), ("/clock", "rosgraph_msgs/msg/Clock")):
            node.subscribe(name, kind, Quality(), partial(received.__setitem__, name))
        until(session, lambda: len(received) == 2)
        node.close()
    assert node.decode(received["/joint_states"], type).name == ["left_wheel_joint"]
    assert 10 <= node.decode(received["/clock"], "rosgraph_msgs/msg/Clock").clock.sec <= 12
