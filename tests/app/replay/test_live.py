"""A live robot on the page, and the command ``topic`` on its graph: a simulation stands for the robot."""

from __future__ import annotations

import asyncio
import json
import math
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

from tests.app.replay.written_bags import Messages, write_bag
from tests.served_simulation import rosbridge
from tests.time_limit import PATIENCE
from urdfkit.app.page import Page
from urdfkit.app.replay import topic_session
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
from urdfkit.view.protocol.client import connect
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


def test_tools_of_the_page_publish_a_goal_and_an_initial_pose_on_the_graph() -> None:
    simulator = Simulator("simpleton")
    received: dict[str, Any] = {}
    speeds: list[float] = []
    kinds = {
        "/goal_pose": "geometry_msgs/msg/PoseStamped",
        "/initialpose": "geometry_msgs/msg/PoseWithCovarianceStamped",
    }
    answers: list[Any] = []

    async def click(url: str) -> None:
        async with await connect(url) as client:
            for tool in ("goal", "estimate"):
                values = {"as": tool, "position": [1.0, -2.0], "yaw": 0.5}
                answers.append(await client.request("publish_pose", **values))

    with rosbridge(simulator) as url:
        other = RosbridgeNode(url, pytest.fail)
        for name, kind in kinds.items():
            other.subscribe(name, kind, Quality(), partial(received.__setitem__, name))
        twist = "geometry_msgs/msg/Twist"
        other.subscribe(
            "/simpleton/cmd_vel", twist, Quality(), lambda data: speeds.append(other.decode(data, twist).linear.x)
        )
        shown = ShownRobot.read(find_model(["simpleton"]))

        def drive() -> bool:
            session.server.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), speed=1.0, turn=1.0))
            return 1.0 in speeds and len(received) == len(kinds)

        with following(Page("sim", port=0), shown, url, pytest.fail) as session:
            until(session, lambda: session.bus.latest("/simpleton/odom") and session.bus.latest("/tf"))
            clicking = Thread(target=lambda: asyncio.run(click(session.server.url)))
            clicking.start()
            until(session, lambda: len(answers) == 2)
            clicking.join()
            until(session, drive)
        other.close()
    assert answers == [{"topic": "/goal_pose", "frame": "odom"}, {"topic": "/initialpose", "frame": "odom"}]
    goal, estimate = (other.decode(received[name], kind) for name, kind in kinds.items())
    assert (goal.header.frame_id, goal.pose.position.x, goal.pose.position.y) == ("odom", 1.0, -2.0)
    assert goal.pose.orientation.z == pytest.approx(math.sin(0.25))
    assert 0.0 < goal.header.stamp.sec + 1e-9 * goal.header.stamp.nanosec <= simulator.t
    assert estimate.pose.covariance[0] == 0.25


def test_a_service_of_the_graph_answers_while_the_page_goes_on_and_a_missing_one_is_silent() -> None:
    with rosbridge(Simulator("simpleton")) as url:
        shown, answers = ShownRobot.read(find_model(["simpleton"])), []
        with following(Page("sim", port=0), shown, url, pytest.fail) as session:
            session.request_markers("/tool/update", answers.append)
            session.topics.call("/get_current_world", "simulation_interfaces/srv/GetCurrentWorld", answers.append)
            until(session, lambda: answers)
    assert [each.world.name for each in answers] == ["empty"]


def test_topic_lists_echoes_and_publishes_on_another_graph(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
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
        monkeypatch.setattr(topic_session, "DISCOVERY", 0.2)  # seconds to wait for a subscriber
        assert main(["topic", "pub", "/stop", "geometry_msgs/Twist", "--once", "--live", url]) == 0
        assert "/stop has no subscribers; topics of this type: /simpleton/cmd_vel" in capsys.readouterr().err
        assert main(["topic", "pub", "/cmd_vel", "geometry_msgs/Twist", "--once", "--live", url]) == 0
        assert "urdfkit: /cmd_vel has no subscribers; did you mean `/simpleton/cmd_vel`?" in capsys.readouterr().err
        words = ["pub", "/simpleton/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.25}}", "--once"]
        assert main(["topic", *words, "--live", url]) == 0
        end = time.monotonic() + PATIENCE
        while not speeds and time.monotonic() < end:
            time.sleep(0.01)
    assert speeds == [0.25]
    assert main(["topic", "list", "--live", "ros3"]) == 2
    assert "use ros1, ros2 or rosbridge://HOST:PORT" in capsys.readouterr().err
    assert main(["topic", "list", "--live", "rosbridge://127.0.0.1:9"]) == 2
    assert "no rosbridge server responds" in capsys.readouterr().err


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
