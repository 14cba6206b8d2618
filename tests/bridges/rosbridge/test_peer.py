"""The rosbridge protocol, frame by frame, as a WebSocket client without a library sends and receives it."""

from __future__ import annotations

import json
import resource
import socket
import tracemalloc
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import websocket

from tests.time_limit import PATIENCE
from urdfkit.bridges.bridge import MOST_BYTES
from urdfkit.bridges.rosbridge.peer import serve_rosbridge
from urdfkit.bridges.websocket.address import Address
from urdfkit.bridges.websocket.server import WebSocketServer
from urdfkit.messages import header, message_type

TWIST = "geometry_msgs/msg/Twist"


@pytest.fixture
def reported() -> list[str]:
    return []


@pytest.fixture
def server(simulated, reported) -> Iterator[WebSocketServer]:
    server = serve_rosbridge(simulated.graph, Address("127.0.0.1", 0), report=reported.append)
    yield server
    server.close()


class Client:
    def __init__(self, server: WebSocketServer, simulated: Any, **options: Any) -> None:
        self.line = websocket.create_connection(server.urls[0], timeout=PATIENCE, **options)
        self._simulated = simulated

    def send(self, **message: Any) -> None:
        self.line.send(json.dumps(message))

    def receive(self) -> Any:
        """Return the next message; the simulation continues meanwhile."""
        self.line.settimeout(0.02)

        def read() -> Any:
            try:
                return json.loads(self.line.recv())
            except websocket.WebSocketTimeoutException:
                return None

        return self._simulated.until(read)

    def call(self, service: str, /, **arguments: Any) -> Any:
        self.send(op="call_service", id="call:1", service=service, args=arguments)
        answer = self.receive()
        assert (answer["op"], answer["id"], answer["service"]) == ("service_response", "call:1", service)
        return answer["values"] if answer["result"] else ("failed", answer["values"])


@pytest.fixture
def client(server, simulated) -> Iterator[Client]:
    client = Client(server, simulated)
    yield client
    client.line.close()


def subscribed(simulated: Any, topic: str) -> None:
    simulated.until(lambda: simulated.bus.has_subscribers(topic))


def test_messages_of_a_topic_come_while_a_client_is_subscribed(client, simulated) -> None:
    assert not simulated.bus.has_subscribers("/odom")
    client.send(op="subscribe", topic="/odom", type="nav_msgs/Odometry")
    subscribed(simulated, "/odom")
    simulated.publish("/odom", "nav_msgs/msg/Odometry", {"child_frame_id": "base"})
    message = client.receive()
    assert (message["op"], message["topic"], message["msg"]["child_frame_id"]) == ("publish", "/odom", "base")
    client.send(op="unsubscribe", topic="/odom")
    simulated.until(lambda: not simulated.bus.has_subscribers("/odom"))


def test_a_client_that_vanishes_ends_its_subscriptions(client, simulated, server) -> None:
    client.send(op="subscribe", topic="/odom")
    subscribed(simulated, "/odom")
    client.line.sock.shutdown(socket.SHUT_RDWR)
    simulated.until(lambda: not simulated.bus.has_subscribers("/odom"))
    assert server.peers == 0


def test_two_clients_share_one_subscription_of_the_bus(client, server, simulated) -> None:
    other = Client(server, simulated)
    for each in (client, other):
        each.send(op="subscribe", topic="/odom")
    assert client.call("/rosapi/nodes") == other.call("/rosapi/nodes") == {"nodes": ["/urdfkit"]}
    subscribed(simulated, "/odom")
    simulated.publish("/odom", "nav_msgs/msg/Odometry", None)
    assert client.receive() == other.receive()
    other.line.close()
    client.send(op="unsubscribe", topic="/odom")
    simulated.until(lambda: not simulated.bus.has_subscribers("/odom"))


def test_a_late_subscriber_gets_the_fixed_transforms(client, simulated) -> None:
    simulated.publish("/tf_static", "tf2_msgs/msg/TFMessage", {"transforms": [{"child_frame_id": "lidar"}]})
    client.send(op="subscribe", topic="/tf_static")
    assert client.receive()["msg"]["transforms"][0]["child_frame_id"] == "lidar"


def test_published_messages_reach_the_bus_in_the_thread_of_the_simulation(client, simulated) -> None:
    received: list[Any] = []
    simulated.bus.subscribe("/cmd_vel", TWIST, received.append)
    client.send(op="advertise", topic="/cmd_vel", type="geometry_msgs/Twist")
    client.send(op="publish", topic="/cmd_vel", msg={"linear": {"x": 0.5}})
    client.send(op="publish", topic="cmd_vel", msg={"linear": {"x": 0.75}})
    simulated.until(lambda: len(received) == 2)
    assert [message.linear.x for message in received] == [0.5, 0.75]


@pytest.mark.parametrize(
    ("frame", "reason"),
    [
        ("nonsense", "Expecting value"),
        ("[]", "not a JSON object"),
        ('{"op": "publish"}', "needs `topic`"),
        ('{"op": "dance"}', "unknown operation `dance`"),
        ('{"op": ["publish"]}', "a field is missing or has the wrong type: unhashable type"),
        ('{"op": "publish", "topic": "/new", "type": 5}', "a field is missing or has the wrong type: 'int' object"),
        ('{"op": "advertise", "topic": "/odom", "type": "std_msgs/String"}', "has type nav_msgs/msg/Odometry"),
        ('{"op": "advertise", "topic": "/new", "type": "std_msgs/Strin"}', "no message type `std_msgs/msg/Strin`"),
        ('{"op": "publish", "topic": "/odom", "msg": {"twits": 1}}', "no field `twits` in nav_msgs/msg/Odometry"),
        ('{"op": "subscribe", "topic": "/odo"}', "no topic `/odo`; did you mean `/odom`"),
        ('{"op": "subscribe", "topic": "/odom", "compression": "gzip"}', "unknown compression `gzip`"),
        ('{"op": "subscribe", "topic": "/odom", "throttle_rate": -1}', "`throttle_rate` is `-1`"),
        ('{"op": "advertise_service", "service": "/x", "type": "x/Y"}', "`advertise_service` is not supported"),
        ("[" * 100_000, "recursion"),
    ],
)
def test_a_wrong_message_is_one_line_and_the_connection_stays(client, simulated, reported, frame, reason) -> None:
    client.send(op="set_level", level="error")
    client.line.send(frame)
    status = client.receive()
    assert (status["op"], status["level"]) == ("status", "error")
    assert reason in status["msg"]
    assert len(reported) == 1
    assert "\n" not in reported[0]
    assert client.call("/rosapi/topic_type", topic="/odom") == {"type": "nav_msgs/msg/Odometry"}


def test_a_client_that_has_not_set_a_level_receives_no_status(client, reported) -> None:
    client.send(op="dance")
    assert client.call("/rosapi/topic_type", topic="/odom") == {"type": "nav_msgs/msg/Odometry"}
    assert len(reported) == 1


def test_a_subscriber_that_cannot_use_a_message_does_not_stop_the_simulation(client, simulated, reported) -> None:
    def refuse(message: Any) -> None:
        raise ValueError("too fast")

    simulated.bus.subscribe("/cmd_vel", TWIST, refuse)
    client.send(op="set_level", level="error")
    client.send(op="publish", topic="/cmd_vel", id="p", msg={"linear": {"x": 9}})
    status = client.receive()
    assert (status["id"], status["msg"]) == ("p", "`/cmd_vel` does not accept this message: too fast")
    assert reported == [status["msg"]]


def test_services_answer_with_values_or_the_reason(client, simulated) -> None:
    assert client.call("/delete", model_name="box") == {"success": True, "status_message": ""}
    assert simulated.deleted == ["box"]
    assert client.call("/delete", model_name="ground") == ("failed", "`ground` cannot be deleted")
    failed, reason = client.call("/delet")
    assert (failed, reason) == ("failed", "no service `/delet`; did you mean `/delete`?")
    failed, reason = client.call("/delete", name="box")
    assert "no field `name`" in reason


def test_rosapi_describes_topics_services_types_and_parameters(client) -> None:
    topics = client.call("/rosapi/topics")
    assert topics == {"topics": ["/odom"], "types": ["nav_msgs/msg/Odometry"]}
    assert client.call("/rosapi/topics_for_type", type="nav_msgs/Odometry") == {"topics": ["/odom"]}
    assert "/delete" in client.call("/rosapi/services")["services"]
    assert client.call("/rosapi/service_type", service="/delete") == {"type": "gazebo_msgs/srv/DeleteModel"}
    assert client.call("/rosapi/services_for_type", type="gazebo_msgs/DeleteModel") == {"services": ["/delete"]}
    (details,) = client.call("/rosapi/service_request_details", type="gazebo_msgs/DeleteModel")["typedefs"]
    assert (details["fieldnames"], details["fieldtypes"], details["fieldarraylen"]) == (
        ["model_name"],
        ["string"],
        [-1],
    )
    first, *others = client.call("/rosapi/message_details", type="nav_msgs/Odometry")["typedefs"]
    assert first["fieldtypes"][0] == "std_msgs/Header"
    covariance = next(each for each in others if each["type"] == "geometry_msgs/PoseWithCovariance")
    assert covariance["fieldarraylen"] == [-1, 36]
    raw = client.call("/rosapi/topics_and_raw_types")
    assert raw["typedefs_full_text"][0].startswith("std_msgs/Header header\nstring child_frame_id")
    assert client.call("/rosapi/get_param_names") == {"names": ["/robot_description"]}
    assert json.loads(client.call("/rosapi/get_param", name="/node:robot_description")["value"]) == "<robot/>"
    assert client.call("/rosapi/get_param", name="/speed", default="1")["value"] == "1"
    assert client.call("/rosapi/get_time")["time"]["nanosec"] == 500_000_000
    assert client.call("/rosapi/nix")[0] == "failed"


def test_throttle_and_queue_length(client, simulated) -> None:
    client.send(op="subscribe", topic="/odom", throttle_rate=300)
    subscribed(simulated, "/odom")
    simulated.publish("/odom", "nav_msgs/msg/Odometry", {"child_frame_id": "first"})
    assert client.receive()["msg"]["child_frame_id"] == "first"
    for number in range(20):
        simulated.publish("/odom", "nav_msgs/msg/Odometry", {"child_frame_id": str(number)})
    assert client.receive()["msg"]["child_frame_id"] == "19"


def connect(url: str, **headers: str) -> int:
    """Return the HTTP status of an attempt to connect; 101 if it was accepted."""
    origin = headers.pop("origin", None)
    try:
        line = websocket.create_connection(
            url, timeout=PATIENCE, suppress_origin=origin is None, origin=origin, host=headers.pop("host", None)
        )
    except websocket.WebSocketBadStatusException as error:
        return error.status_code
    line.close()
    return 101


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 101),
        ({"origin": "http://localhost:8080"}, 101),
        ({"origin": "file://"}, 101),
        ({"origin": "https://evil.example"}, 403),
        ({"origin": "http://localhost.evil.example"}, 403),
        ({"origin": "null"}, 403),
        ({"host": "evil.example"}, 403),
    ],
)
def test_pages_of_other_sites_are_rejected(server, headers, status) -> None:
    assert connect(server.urls[0], **headers) == status


def test_another_address_needs_the_token_and_an_origin_can_be_allowed(simulated) -> None:
    server = serve_rosbridge(
        simulated.graph, Address("0.0.0.0", 0), origins=["https://good.example"], report=lambda _: None
    )
    try:
        url = server.urls[0]
        assert connect(url, origin="https://good.example") == 101
        assert connect(url.partition("?")[0]) == 403
        assert connect(url[:-1]) == 403
        assert server.access.token not in repr(server.access)
    finally:
        server.close()


def test_a_busy_port_is_one_line(server, simulated) -> None:
    port = server.access.port
    with pytest.raises(Exception, match=f"port {port} is in use; \\d+ is free"):
        serve_rosbridge(simulated.graph, Address("127.0.0.1", port), report=lambda _: None)


def test_a_client_that_never_reads_costs_a_fixed_amount_of_memory(server, simulated) -> None:
    line = socket.create_connection(("127.0.0.1", server.access.port))
    line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    line.send(
        b"GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
    )
    request = b'{"op":"subscribe","topic":"/image","type":"sensor_msgs/Image","compression":"cbor"}'
    line.send(b"\x81" + bytes([0x80 | len(request)]) + b"\0\0\0\0" + request)
    subscribed(simulated, "/image")
    image = message_type("sensor_msgs/msg/Image")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(1000):
        pixels = np.ones(1_000_000, np.uint8)
        message = image(header(0.0, "camera"), 1000, 1000, "mono8", 0, 1000, pixels)
        simulated.bus.publish("/image", "sensor_msgs/msg/Image", message)
    other = Client(server, simulated)
    assert other.call("/rosapi/nodes") == {"nodes": ["/urdfkit"]}
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 150_000  # of 1,000,000 kB published
    other.line.close()
    line.close()
    simulated.until(lambda: not simulated.bus.has_subscribers("/image"))


@pytest.mark.slow
@pytest.mark.parametrize(
    "operation",
    [
        {"op": "publish", "topic": "/image", "msg": {"data": "AAAA" * 1_000_000}},
        {"op": "publish", "topic": "/text", "msg": {"data": "AAAA" * 1_000_000}},
        {"op": "call_service", "service": "/delete", "args": {"model_name": "AAAA" * 1_000_000}},
    ],
)
def test_messages_that_wait_for_a_busy_simulation_are_bounded(server, simulated, operation) -> None:
    """A client sends while the simulation takes nothing; the oldest wait, with nothing else, the others are dropped."""
    simulated.bus.subscribe("/image", "sensor_msgs/msg/Image", lambda message: None)
    simulated.bus.subscribe("/text", "std_msgs/msg/String", lambda message: None)
    client = Client(server, simulated)
    client.send(op="set_level", level="error")
    content = json.dumps(operation)
    tracemalloc.start()
    try:
        for _ in range(24):
            client.line.send(content)
        dropped = [client.line.recv() for _ in range(24 - MOST_BYTES // len(content))]
        assert tracemalloc.get_traced_memory()[0] < MOST_BYTES + len(content)
    finally:
        tracemalloc.stop()
    client.line.close()
    for answer in dropped:
        assert "10000 calls or 64 MB of messages are queued for the simulation; this message is dropped" in answer
