"""The Foxglove protocol, frame by frame, as a WebSocket client without a library sends and receives it."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import websocket

from tests.time_limit import PATIENCE
from urdfkit.bridges.foxglove.bridge import FoxgloveServer
from urdfkit.bridges.websocket.address import Address
from urdfkit.errors import ResourceError
from urdfkit.messages import from_fields, typestore

TWIST = "geometry_msgs/msg/Twist"


@pytest.fixture
def reported() -> list[str]:
    return []


@pytest.fixture
def server(simulated, reported, tmp_path: Path) -> Iterator[FoxgloveServer]:
    (tmp_path / "package.xml").write_text("<package/>")
    (tmp_path / "base.stl").write_bytes(b"solid")
    (tmp_path.parent / "secret.stl").write_bytes(b"secret")

    def find(name: str) -> Path:
        if name != "robot":
            raise ResourceError(f"no package `{name}`")
        return tmp_path

    server = FoxgloveServer(simulated.graph, Address("127.0.0.1", 0), find, report=reported.append)
    yield server
    server.close()


class Client:
    def __init__(self, server: FoxgloveServer, simulated: Any) -> None:
        self.line = websocket.create_connection(
            server.urls[0], timeout=PATIENCE, subprotocols=["foxglove.websocket.v1"]
        )
        self._simulated, self._server = simulated, server

    def send(self, **message: Any) -> None:
        self.line.send(json.dumps(message))

    def receive(self) -> Any:
        """Return the next message, or the bytes of a frame; the simulation continues meanwhile."""
        self.line.settimeout(0.02)

        def read() -> Any:
            self._server.update()
            try:
                return self.line.recv()
            except websocket.WebSocketTimeoutException:
                return None

        frame = self._simulated.until(read)
        return json.loads(frame) if isinstance(frame, str) else frame

    def frame(self) -> bytes:
        """Return the next binary frame."""
        while isinstance(frame := self.receive(), dict):
            assert frame["op"] == "advertise"
        return bytes(frame)


@pytest.fixture
def client(server, simulated) -> Iterator[Client]:
    client = Client(server, simulated)
    yield client
    client.line.close()


@pytest.fixture
def greeted(client) -> Client:
    """A client that has read the first three messages."""
    assert [client.receive()["op"] for _ in range(3)] == ["serverInfo", "advertise", "advertiseServices"]
    return client


def test_a_client_learns_capabilities_channels_and_services(client) -> None:
    information, channels, services = (client.receive() for _ in range(3))
    assert {"clientPublish", "services", "assets", "parameters", "time"} == set(information["capabilities"])
    (channel,) = channels["channels"]
    assert (channel["topic"], channel["schemaName"]) == ("/odom", "nav_msgs/msg/Odometry")
    assert (channel["encoding"], channel["schemaEncoding"]) == ("cdr", "ros2msg")
    assert channel["schema"].startswith("std_msgs/Header header\nstring child_frame_id\n")
    (service,) = services["services"]
    assert (service["name"], service["request"]["schema"]) == ("/delete", "string model_name\n")


def test_messages_come_in_cdr_with_the_simulated_time(greeted, simulated) -> None:
    greeted.send(op="subscribe", subscriptions=[{"id": 7, "channelId": 1}])
    simulated.until(lambda: simulated.bus.has_subscribers("/odom"))
    simulated.publish("/odom", "nav_msgs/msg/Odometry", {"child_frame_id": "base"})
    frame = greeted.frame()
    assert struct.unpack_from("<BIQ", frame) == (1, 7, 2_500_000_000)
    assert typestore().deserialize_cdr(frame[13:], "nav_msgs/msg/Odometry").child_frame_id == "base"
    greeted.send(op="unsubscribe", subscriptionIds=[7])
    simulated.until(lambda: not simulated.bus.has_subscribers("/odom"))


def test_new_topics_are_announced_and_the_clock_is_the_time(greeted, simulated) -> None:
    simulated.until(lambda: simulated.bus.has_subscribers("/clock"))
    message = greeted.receive()
    assert [row["topic"] for row in message["channels"]] == ["/clock"]
    simulated.publish("/clock", "rosgraph_msgs/msg/Clock", {"clock": 2.5})
    assert greeted.receive() == struct.pack("<BQ", 2, 2_500_000_000)


@pytest.mark.parametrize("encoding", ["cdr", "json"])
def test_published_messages_reach_the_bus(greeted, simulated, encoding: str) -> None:
    received: list[Any] = []
    simulated.bus.subscribe("/cmd_vel", TWIST, received.append)
    twist = from_fields(TWIST, {"linear": {"x": 0.5}})
    content = bytes(typestore().serialize_cdr(twist, TWIST)) if encoding == "cdr" else b'{"linear": {"x": 0.5}}'
    greeted.send(op="advertise", channels=[{"id": 3, "topic": "/cmd_vel", "encoding": encoding, "schemaName": TWIST}])
    greeted.line.send_binary(struct.pack("<BI", 1, 3) + content)
    simulated.until(lambda: received)
    assert received[0].linear.x == 0.5


@pytest.mark.parametrize("encoding", ["cdr", "json"])
def test_services_answer_in_the_encoding_of_the_request(greeted, simulated, encoding: str) -> None:
    def call(name: str) -> Any:
        type = "gazebo_msgs/srv/DeleteModel_Request"
        request = from_fields(type, {"model_name": name})
        content = bytes(typestore().serialize_cdr(request, type))
        if encoding == "json":
            content = json.dumps({"model_name": name}).encode()
        head = struct.pack("<BIII", 2, 1, 99, len(encoding))
        greeted.line.send_binary(head + encoding.encode() + content)
        answer = greeted.receive()
        while isinstance(answer, dict) and answer["op"] == "advertise":
            answer = greeted.receive()
        return answer

    frame = call("box")
    assert struct.unpack_from("<BIII", frame) == (3, 1, 99, len(encoding))
    content = frame[13 + len(encoding) :]
    if encoding == "json":
        assert json.loads(content) == {"success": True, "status_message": ""}
    else:
        assert typestore().deserialize_cdr(content, "gazebo_msgs/srv/DeleteModel_Response").success is True
    assert simulated.deleted == ["box"]
    failure = call("ground")
    assert (failure["op"], failure["callId"], failure["message"]) == (
        "serviceCallFailure", 99, "`ground` cannot be deleted",
    )  # fmt: skip


def test_parameters_are_read_only(greeted) -> None:
    greeted.send(op="getParameters", parameterNames=[], id="all")
    answers = [greeted.receive(), greeted.receive()]
    values = next(each for each in answers if each["op"] == "parameterValues")
    assert (values["parameters"], values["id"]) == ([{"name": "/robot_description", "value": "<robot/>"}], "all")
    greeted.send(op="setParameters", parameters=[])
    assert greeted.receive()["message"] == "parameters are read-only"


@pytest.mark.parametrize(
    ("uri", "reason"),
    [
        ("package://robot/base.stl", None),
        ("package://robot/package.xml", "is not a mesh or texture inside the package"),
        ("package://robot/../secret.stl", "is not a mesh or texture inside the package"),
        ("package://robot//etc/passwd", "is not a mesh or texture inside the package"),
        ("package://robot/none.stl", "No such file"),
        ("package://other/base.stl", "no package `other`"),
        ("file:///etc/passwd", "use package://NAME/PATH"),
        ("", "use package://NAME/PATH"),
    ],
)
def test_only_meshes_and_textures_of_packages_are_sent(greeted, uri: str, reason: str | None) -> None:
    greeted.send(op="fetchAsset", uri=uri, requestId=5)
    frame = greeted.frame()
    kind, request, status, length = struct.unpack_from("<BIBI", frame)
    assert (kind, request) == (4, 5)
    if reason is None:
        assert (status, frame[10 + length :]) == (0, b"solid")
    else:
        assert status == 1
        assert reason in frame[10 : 10 + length].decode()


@pytest.mark.parametrize(
    ("frame", "reason"),
    [
        ("nonsense", "Expecting value"),
        ('{"op": "dance"}', "unknown operation `dance`"),
        ('{"op": "subscribe"}', "a field is missing"),
        ('{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 99}]}', "no channel 99"),
        ('{"op": "advertise", "channels": [{"id": 1, "topic": "/odom", "encoding": "cdr", "schemaName": "a/B"}]}',
         "topic `/odom` has type nav_msgs/msg/Odometry"),
        (b"\x01", "too short"),
        (b"\x09", "unknown type 9"),
        (struct.pack("<BI", 1, 8) + b"x", "the channel 8 is not advertised"),
    ],
)  # fmt: skip
def test_a_wrong_message_is_one_line_and_the_connection_stays(greeted, reported, frame, reason) -> None:
    if isinstance(frame, bytes):
        greeted.line.send_binary(frame)
    else:
        greeted.line.send(frame)
    status = greeted.receive()
    while status["op"] == "advertise":
        status = greeted.receive()
    assert (status["op"], status["level"]) == ("status", 2)
    assert reason in status["message"]
    assert len(reported) == 1
    greeted.send(op="getParameters", parameterNames=["/robot_description"])
    answer = greeted.receive()
    assert "parameterValues" in (answer["op"], greeted.receive()["op"] if answer["op"] == "advertise" else "")


@pytest.mark.parametrize("content", [b"", b"\x00", b"\x00\x01\x00\x00" + b"\xff" * 7, b"\x09\x09\x09\x09"])
def test_a_truncated_cdr_message_is_reported_in_one_line(greeted, simulated, reported, content: bytes) -> None:
    greeted.send(op="advertise", channels=[{"id": 3, "topic": "/cmd_vel", "encoding": "cdr", "schemaName": TWIST}])
    greeted.line.send_binary(struct.pack("<BI", 1, 3) + content)
    simulated.until(lambda: reported)
    assert "is not a geometry_msgs/msg/Twist in CDR" in reported[0]
    assert "\n" not in reported[0]


def test_a_client_without_the_subprotocol_is_rejected(server) -> None:
    with pytest.raises(websocket.WebSocketBadStatusException, match="400"):
        websocket.create_connection(server.urls[0], timeout=PATIENCE)
    websocket.create_connection(
        server.urls[0], timeout=PATIENCE, subprotocols=["foxglove.websocket.v1"], origin="https://app.foxglove.dev"
    ).close()


def test_a_client_that_closes_ends_its_subscriptions(greeted, simulated, server) -> None:
    simulated.until(lambda: simulated.bus.has_subscribers("/clock"))
    greeted.line.close()
    simulated.until(lambda: not simulated.bus.has_subscribers("/clock"))
    assert server._connected == []
