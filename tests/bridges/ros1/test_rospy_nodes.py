"""`--ros1` seen by Debian's rospy and rosbag, and by a master that disappears."""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread
from typing import Any

import pytest
import yaml

from tests.bridges.ros1.conftest import Master, debian_environment
from tests.processes import running
from tests.time_limit import PATIENCE
from urdfkit.app.simulation.bridging.bridges import BridgeOptions, bridged
from urdfkit.app.simulation.bridging.real_time import RunControls, advance_in_real_time
from urdfkit.app.simulation.bridging.ros_connection import RosOptions, connect_to_ros
from urdfkit.bridges.bag_file import BagFile
from urdfkit.bridges.bridge import Bridges
from urdfkit.bridges.node.node import Quality
from urdfkit.bridges.ros1 import ros1_node
from urdfkit.bridges.ros1.ros1_node import Ros1Node
from urdfkit.bridges.ros1.xml_rpc import call
from urdfkit.cli import main
from urdfkit.messages import from_fields
from urdfkit.sim import Simulator

pytestmark = pytest.mark.rospy
STRING = "std_msgs/msg/String"


@contextmanager
def on_ros1(simulator: Simulator, lines: list[str]) -> Iterator[None]:
    """Simulate in real time with ``--ros1`` until the end of the block."""
    stopped: list[bool] = []
    controls = RunControls(simulator)
    with bridged(simulator, BridgeOptions(ros=RosOptions(ros1=True)), controls, lines.append) as bridges:
        thread = Thread(target=advance_in_real_time, args=(simulator, bridges, lambda: bool(stopped)))
        thread.start()
        try:
            yield
        finally:
            stopped.append(True)
            thread.join()


def until(condition: Any) -> None:
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, "the condition did not become true in time"
        time.sleep(0.02)


@pytest.mark.slow
def test_a_rospy_node_drives_the_robot_a_metre_and_rosbag_records_it(master: Master, tmp_path: Path) -> None:
    bag, lines = tmp_path / "run.bag", list[str]()
    topics = ["/simpleton/odom", "/tf", "/tf_static", "/clock"]
    with on_ros1(Simulator("simpleton"), lines):
        record = ["/usr/lib/rosbag/record", "-O", str(bag), *topics]
        recorder = subprocess.Popen(record, env=debian_environment(master.uri), stdout=subprocess.DEVNULL)
        try:
            node = ["/usr/bin/python3", str(Path(__file__).parent / "rospy_node.py")]
            done = subprocess.run(
                node, env=debian_environment(master.uri), capture_output=True, text=True, timeout=PATIENCE, check=False
            )
        finally:
            recorder.terminate()
            recorder.wait(PATIENCE)
    assert done.returncode == 0, done.stderr
    seen = json.loads(done.stdout.splitlines()[-1])
    assert seen["driven"] > 1.0 > 0.5 > seen["x"]
    assert seen["stamps"] > 10
    assert seen["description"] == seen["parameter"] == "</robot>"
    assert "camera" in seen["links"]
    assert (seen["width"], seen["K"][8]) == (800, 1.0)
    assert {"/gazebo/reset_simulation", "/gazebo/spawn_sdf_model"} <= set(seen["services"])
    assert seen["type"] == "gazebo_msgs/SpawnModel"
    with BagFile(bag) as recorded:
        assert {each.name for each in recorded.topics} == set(topics)
        last = [recorded.message(each) for each in recorded.messages(topics=["/simpleton/odom"])]
    assert max(each.pose.pose.position.x for each in last) > 1.0
    assert lines == []


@pytest.mark.slow
def test_a_client_of_actionlib_moves_an_arm(master: Master) -> None:
    lines, simulator = list[str](), Simulator("heterogeneous")
    (goals,) = [each.name for each in simulator.bus.topics if each.type.endswith("FollowJointTrajectoryActionGoal")]
    with on_ros1(simulator, lines):
        node = ["/usr/bin/python3", str(Path(__file__).parent / "actionlib_client.py"), goals.removesuffix("/goal")]
        done = subprocess.run(
            node, env=debian_environment(master.uri), capture_output=True, text=True, timeout=PATIENCE, check=False
        )
    assert done.returncode == 0, done.stderr
    seen = json.loads(done.stdout.splitlines()[-1])
    assert seen["feedback"] > 2
    assert "jarmLink0" in seen["joints"]
    preempted, succeeded, aborted, rejected = 2, 3, 4, 5
    assert seen["reached"][:2] == [succeeded, 0]
    assert seen["unknown"][:2] == [rejected, -2]
    assert "unknown joint `jarmLink9`" in seen["unknown"][2]
    assert seen["cancelled"][0] == preempted
    assert seen["off"][:2] == [aborted, -4]
    assert lines == []


@pytest.mark.slow
def test_the_command_sends_goals_over_ros1(master: Master, capsys: pytest.CaptureFixture[str]) -> None:
    lines, simulator = list[str](), Simulator("heterogeneous", note=lambda _: None)
    name = "/heterogeneous/arm_controller/follow_joint_trajectory"
    goal = "{trajectory: {joint_names: [%s], points: [{positions: [0.2], time_from_start: 1}]}}"
    with on_ros1(simulator, lines):
        assert main(["action", "list", "--live", "ros1"]) == 0
        assert capsys.readouterr().out == f"{name}\n"
        assert main(["action", "send", name, goal % "jarmLink0", "--feedback", "--json", "--live", "ros1"]) == 0
        *feedback, result = map(json.loads, capsys.readouterr().out.splitlines())
        assert result == {"error_code": 0, "error_string": ""}
        assert "jarmLink0" in feedback[0]["joint_names"]
        assert main(["action", "send", name, goal % "jarmLink9", "--json", "--live", "ros1"]) == 1
        assert json.loads(capsys.readouterr().out)["error_code"] == -2
    assert lines == []


@pytest.mark.slow
def test_nodes_find_each_other_and_again_after_the_master_was_gone(master: Master) -> None:
    lines, received = list[str](), list[Any]()
    first, second = Ros1Node(report=lines.append), Ros1Node(name="/other", report=lines.append)
    try:
        writer = first.writer("/chatter", STRING, Quality(latched=True))
        writer.publish(first.encode(from_fields(STRING, {"data": "early"}), STRING))
        second.subscribe("/chatter", STRING, Quality(), lambda data: received.append(second.decode(data, STRING)))
        until(lambda: received)
        assert received[0].data == "early"
        assert second.topics() == {"/chatter": STRING}
        first.set_parameter("/use_sim_time", True)
        master.stop()
        until(lambda: lines)
        assert lines[0] == f"ros1: the master at {master.uri} has stopped; urdfkit continues"
        writer.publish(first.encode(from_fields(STRING, {"data": "alone"}), STRING))
        until(lambda: len(received) == 2)
        master.start()
        until(lambda: "ros1: the master runs again" in lines)
        until(lambda: second.topics() == {"/chatter": STRING})
        assert call(master.uri, "getParam", "/test", "/use_sim_time") is True
    finally:
        second.close()
        first.close()


@pytest.mark.slow
def test_a_master_that_is_replaced_between_two_checks_is_told_everything_again(
    master: Master, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ros1_node, "WATCH", 5.0)  # seconds, in which the master is stopped and started
    lines = list[str]()
    node = Ros1Node(report=lines.append)
    try:
        node.writer("/chatter", STRING, Quality())
        master.stop()
        master.start()
        until(lambda: "ros1: the master runs again" in lines)
        assert node.topics() == {"/chatter": STRING}
    finally:
        node.close()


@pytest.mark.slow
def test_simulations_with_namespaces_share_a_master_and_others_are_told_of(master: Master) -> None:
    lines, bus = list[str](), Simulator("simpleton").bus
    bridges = [Bridges(), Bridges(), Bridges()]
    try:
        for each, namespace in zip(bridges, ("/a", "/b", "/a"), strict=True):
            connect_to_ros(bus, RosOptions(ros1=True, namespace=namespace), each, {}, lines.append)
            if namespace == "/b":
                assert lines == []
                publishers = dict(call(master.uri, "getSystemState", "/test")[0])
                assert publishers["/a/simpleton/odom"] == ["/a/urdfkit"]
                assert publishers["/b/simpleton/odom"] == ["/b/urdfkit"]
        until(lambda: lines)
        assert "another node has taken the name /a/urdfkit" in lines[0]
    finally:
        for each in bridges:
            each.close()


@pytest.mark.slow
def test_services_are_called_as_rosservice_calls_them(master: Master, capsys: pytest.CaptureFixture[str]) -> None:
    environment = debian_environment(master.uri)

    def rosservice(*words: str) -> str:
        done = subprocess.run(
            ["/usr/bin/rosservice", *words], env=environment, capture_output=True, text=True, check=True
        )
        return done.stdout

    def service(*words: str) -> tuple[int, str]:
        code = main(["service", *words, "--live", "ros1"])
        return code, capsys.readouterr().out

    command = ["/usr/bin/python3", str(Path(__file__).parent / "rospy_service.py")]
    with running(command, env=environment, stdout=subprocess.PIPE, text=True) as lamp:
        assert lamp.stdout is not None
        assert lamp.stdout.readline() == "ready\n"
        assert service("list") == (0, rosservice("list"))
        assert service("type", "/switch") == (0, rosservice("type", "/switch").replace("/", "/srv/"))
        for value, code in (("true", 0), ("false", 1)):
            assert service("call", "/switch", f"{{data: {value}}}")[0] == code
            expected = yaml.safe_load(rosservice("call", "/switch", value))
            assert yaml.safe_load(service("call", "/switch", value)[1]) == expected
        assert main(["service", "call", "/lamp/get_loggers", "--live", "ros1"]) == 2
        assert "no definition of roscpp/srv/GetLoggers" in capsys.readouterr().err


@pytest.mark.slow
def test_a_node_with_another_type_is_refused_in_one_line(master: Master) -> None:
    lines = list[str]()
    first, second = Ros1Node(), Ros1Node(name="/other", report=lines.append)
    try:
        first.writer("/chatter", STRING, Quality())
        second.subscribe("/chatter", "std_msgs/msg/Bool", Quality(), lambda data: None)
        until(lambda: lines)
    finally:
        second.close()
        first.close()
    assert "has type std_msgs/String" in lines[0]
