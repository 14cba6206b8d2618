"""The bridge to ROS 2, on a node without a network, and variables and options of ROS."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest

from tests.time_limit import PATIENCE
from urdfkit.bridges.actions import ActionServer
from urdfkit.bridges.bridge import CallQueue
from urdfkit.bridges.node import published_topics
from urdfkit.bridges.node.node import Done, End, Quality, UnknownTypeError
from urdfkit.bridges.node.node_bridge import GOAL_DELAY, NodeBridge, check_namespace
from urdfkit.bridges.ros2.environment import keep_on_this_machine, on_this_machine, ros_domain, share_long_messages
from urdfkit.bridges.ros2.rclpy_action_client import UNANSWERED, RclpyGoal
from urdfkit.bridges.service import Service
from urdfkit.bus import Bus
from urdfkit.cli import main
from urdfkit.errors import UsageError
from urdfkit.messages import from_fields, message_type, typestore
from urdfkit.messages.conversion import decode_cdr, encode_cdr

STRING, TWIST = "std_msgs/msg/String", "geometry_msgs/msg/Twist"


@dataclass
class Published:
    quality: Quality
    matched: bool = False
    sent: list[bytes] = field(default_factory=list)

    def publish(self, data: bytes) -> None:
        self.sent.append(data)

    def is_matched(self) -> bool:
        return self.matched


class RecordedNode:
    description, ros, option = "recorded", "ROS 2", "--ros2"
    encode, decode = staticmethod(encode_cdr), staticmethod(decode_cdr)

    def __init__(self, lacks: str = "") -> None:
        self.lacks, self.closed = lacks, False
        self.published: dict[str, Published] = {}
        self.subscribed: dict[str, Callable[[bytes], None]] = {}

    def writer(self, topic: str, type: str, quality: Quality) -> Published:
        if type == self.lacks:
            raise UnknownTypeError(f"no {type}")
        self.published[topic] = Published(quality)
        return self.published[topic]

    def subscribe(self, topic: str, type: str, quality: Quality, receive: Callable[[bytes], None]) -> End:
        self.subscribed[topic] = receive
        return lambda: None

    def topics(self) -> dict[str, str]:
        return {}

    def serve(self, service: Service, call: Callable[[Any, Done], None]) -> None:
        raise UnknownTypeError(service.type)

    def close(self) -> None:
        self.closed = True


def until(condition: Callable[[], Any], calls: CallQueue) -> None:
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, "the condition did not become true in time"
        calls.wait(0.01)
        calls.take()


def string(text: str) -> Any:
    return from_fields(STRING, {"data": text})


def test_a_topic_is_encoded_only_while_a_subscriber_is_matched() -> None:
    bus, calls, node = Bus(), CallQueue(), RecordedNode()
    bus.advertise("/chatter", STRING)
    bridge = NodeBridge(bus, calls, node, report=pytest.fail)
    bus.publish("/chatter", STRING, string("unheard"))
    assert not bus.has_subscribers("/chatter")
    node.published["/chatter"].matched = True
    until(lambda: bus.has_subscribers("/chatter"), calls)
    bus.publish("/chatter", STRING, string("heard"))
    until(lambda: node.published["/chatter"].sent, calls)
    (data,) = node.published["/chatter"].sent
    assert typestore().deserialize_cdr(data, STRING).data == "heard"
    node.published["/chatter"].matched = False
    until(lambda: not bus.has_subscribers("/chatter"), calls)
    bridge.close()
    assert node.closed


def test_latched_topics_are_sent_without_waiting_for_a_subscriber() -> None:
    bus, calls, node = Bus(), CallQueue(), RecordedNode()
    bus.publish("/robot_description", STRING, string("<robot/>"))
    bridge = NodeBridge(bus, calls, node, report=pytest.fail)
    until(lambda: node.published["/robot_description"].sent, calls)
    assert node.published["/robot_description"].quality == Quality(latched=True, depth=1)
    bridge.close()


@pytest.mark.parametrize(
    ("graph", "type", "delays"),
    [
        ("ROS 1", "control_msgs/msg/FollowJointTrajectoryActionGoal", [GOAL_DELAY]),
        ("ROS 1", "actionlib_msgs/msg/GoalID", [GOAL_DELAY]),
        ("ROS 1", TWIST, []),
        ("ROS 2", "control_msgs/msg/FollowJointTrajectoryActionGoal", []),
    ],
)
def test_goals_of_actionlib_wait_until_their_client_expects_the_answer(
    graph: str, type: str, delays: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    bus, calls, node, received = Bus(), CallQueue(), RecordedNode(), list[Any]()
    node.ros = graph
    bus.subscribe("/arm", type, received.append)
    bridge = NodeBridge(bus, calls, node, report=pytest.fail)
    slept = list[float]()
    monkeypatch.setattr("urdfkit.bridges.node.node_bridge.time.sleep", slept.append)
    node.subscribed["/arm"](encode_cdr(from_fields(type, {}), type))
    monkeypatch.undo()
    assert slept == delays
    calls.take()
    assert len(received) == 1
    bridge.close()


def test_commands_reach_the_bus_in_the_thread_of_the_simulation() -> None:
    bus, calls, node = Bus(), CallQueue(), RecordedNode()
    speeds: list[float] = []
    bus.subscribe("/cmd_vel", TWIST, lambda message: speeds.append(message.linear.x))
    lines: list[str] = []
    bridge = NodeBridge(bus, calls, node, namespace="/r1", report=lines.append)
    assert not node.published
    node.subscribed["/r1/cmd_vel"](bytes(typestore().serialize_cdr(from_fields(TWIST, {"linear": {"x": 0.5}}), TWIST)))
    assert speeds == []
    calls.take()
    assert speeds == [0.5]
    node.subscribed["/r1/cmd_vel"](b"\0\1\0\0short")
    calls.take()
    assert speeds == [0.5]
    assert lines[0].startswith("`/cmd_vel`: dropped a message that is not a geometry_msgs/msg/Twist")
    bridge.close()


def test_topics_are_followed_and_missing_types_reported_in_one_line() -> None:
    bus, calls, node, lines = Bus(), CallQueue(), RecordedNode(lacks=STRING), list[str]()
    bridge = NodeBridge(bus, calls, node, namespace="/r1", report=lines.append)
    for name, type in (("/a", STRING), ("/b", STRING), ("/clock", "rosgraph_msgs/msg/Clock"), ("/no-name", TWIST)):
        bus.advertise(name, type)
    bus.advertise("/spawn", "gazebo_msgs/srv/SpawnModel_Request")
    bridge.update()
    assert list(node.published) == ["/clock"]
    assert lines == [
        "`/r1/no-name` is not a valid topic name in ROS 2; it is not bridged",
        f"/r1/a, /r1/b: not on ROS 2; no {STRING}",
    ]
    bridge.close()


def test_a_topic_with_another_type_on_the_graph_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(published_topics, "WATCH_PERIOD", 0.0)

    class Graph(RecordedNode):
        def types(self) -> dict[str, set[str]]:
            checks.append(1)
            return {"/cmd_vel": {TWIST, STRING}, "/chatter": {STRING}}

    bus, calls, node, lines, checks = Bus(), CallQueue(), Graph(), list[str](), list[int]()
    bus.subscribe("/cmd_vel", TWIST, lambda message: None)
    bridge = NodeBridge(bus, calls, node, report=lines.append)
    until(lambda: len(checks) > 1, calls)
    bridge.close()
    assert lines == [f"`/cmd_vel` has type {TWIST}, but a node uses {STRING}; they exchange no messages"]


def test_a_message_that_cannot_be_encoded_is_one_line_and_the_next_ones_are_sent() -> None:
    bus, calls, node, lines = Bus(), CallQueue(), RecordedNode(), list[str]()
    bus.advertise("/a", STRING)
    bridge = NodeBridge(bus, calls, node, report=lines.append)
    node.published["/a"].matched = True
    until(lambda: bus.has_subscribers("/a"), calls)
    for text in ("\ud800", "next"):
        bus.publish("/a", STRING, message_type(STRING)(text))
    until(lambda: node.published["/a"].sent, calls)
    bridge.close()
    assert [decode_cdr(data, STRING).data for data in node.published["/a"].sent] == ["next"]
    assert len(lines) == 1
    assert lines[0].startswith("`/a`: a message cannot be sent to ROS 2: ")


def test_actions_without_a_server_are_one_line() -> None:
    lines: list[str] = []
    bus, calls, node = Bus(), CallQueue(), RecordedNode()
    for name in ("left", "right"):
        bus.advertise(f"/{name}/move/_action/send_goal", "control_msgs/action/FollowJointTrajectory_SendGoal_Request")
    bridge = NodeBridge(bus, calls, node, namespace="/r1", report=lines.append)
    bridge.update()
    bridge.close()
    assert lines == [
        "/r1/left/move, /r1/right/move: not on ROS 2; recorded does not support actions: send goals over --rosbridge"
    ]
    assert not bridge.actions


def test_variables_of_ros() -> None:
    assert ros_domain(None, {}) == 0
    assert ros_domain(None, {"ROS_DOMAIN_ID": "7"}) == 7
    assert ros_domain(3, {"ROS_DOMAIN_ID": "7"}) == 3
    assert on_this_machine({})
    assert not on_this_machine({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"})
    assert not on_this_machine({"ROS_LOCALHOST_ONLY": "0"})
    for before, added in (
        ({}, {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}),
        ({"ROS_DISTRO": "humble"}, {"ROS_LOCALHOST_ONLY": "1"}),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, {}),
    ):
        environment = dict(before)
        keep_on_this_machine(environment)
        assert environment == {**before, **added}
    with pytest.raises(UsageError, match="ROS_DOMAIN_ID is `x`"):
        ros_domain(None, {"ROS_DOMAIN_ID": "x"})
    with pytest.raises(UsageError, match="switches discovery off"):
        on_this_machine({"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"})


def test_fast_dds_shares_memory_for_images_unless_it_is_configured() -> None:
    for before, variable in (
        ({"ROS_DISTRO": "kilted"}, "FASTDDS_DEFAULT_PROFILES_FILE"),
        ({"ROS_DISTRO": "jazzy"}, "FASTRTPS_DEFAULT_PROFILES_FILE"),
    ):
        environment = dict(before)
        share_long_messages(environment)
        assert Path(environment.pop(variable)).is_file()
        assert environment == before
    configured = {"FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}
    share_long_messages(configured)
    assert configured == {"FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}


def test_namespaces() -> None:
    assert [check_namespace(each) for each in ("", "/", "r1", "/a/b/")] == ["", "", "/r1", "/a/b"]
    with pytest.raises(UsageError, match="--namespace is `a-b`"):
        check_namespace("a-b")


@pytest.mark.parametrize(
    ("options", "line"),
    [
        (["--namespace", "r1"], "--namespace is an option of the bridge to ROS: add --ros2 or --ros1"),
        (["--ros1", "--ros-domain", "3"], "--ros-domain is an option of the bridge to ROS: add --ros2"),
        (["--ros2", "--ros-domain", "233"], "--ros-domain is `233`; a ROS domain is a number from 0 to 232"),
    ],
)
def test_invalid_options_are_one_line(options: list[str], line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sim", "run", "simpleton", "--for", "1", *options]) == 2
    assert capsys.readouterr().err == f"urdfkit: {line}\n"


def test_without_a_library_one_line_names_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("urdfkit.bridges.ros2.node_selection.find_spec", lambda name: None)
    assert main(["sim", "run", "simpleton", "--for", "1", "--ros2"]) == 2
    assert "pip install 'urdfkit[ros2]'" in capsys.readouterr().err


@pytest.mark.parametrize("accepted", [True, False])
def test_a_goal_without_a_response_ends(accepted: bool) -> None:
    ended = list[tuple[int, Any, str]]()
    action = ActionServer("/arm/move", "control_msgs/action/FollowJointTrajectory", is_rcl=True)
    goal = RclpyGoal(action, lambda call: call(), lambda _: None, lambda *end: ended.append(end), lambda: True)
    if accepted:
        response, future = Mock(accepted=True), Mock()
        future.result.return_value = response
        goal.take_response(future)
    for _ in range(UNANSWERED - 1):
        goal.check_server()
    assert ended == []
    goal.check_server()
    goal.check_server()
    assert ended == ([] if accepted else [(6, None, "/arm/move has not responded within 30 s")])


def test_a_goal_that_is_accepted_after_its_end_is_cancelled() -> None:
    action = ActionServer("/arm/move", "control_msgs/action/FollowJointTrajectory", is_rcl=True)
    goal = RclpyGoal(action, lambda call: call(), lambda _: None, lambda *_: None, lambda: True)
    for _ in range(UNANSWERED):
        goal.check_server()
    future = Mock()
    goal.take_response(future)
    future.result.return_value.cancel_goal_async.assert_called_once_with()
