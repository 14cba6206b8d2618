"""RosbridgeNode: the graph of another program that serves rosbridge, such as a real robot with rosbridge_suite."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from threading import Thread
from typing import Any

from tornado.httpclient import HTTPClientError
from tornado.websocket import WebSocketClientConnection, WebSocketClosedError, websocket_connect

from urdfkit.bridges.json_messages import from_json, to_json
from urdfkit.bridges.node.node import RESPONSE, Done, End, Quality, UnknownTypeError
from urdfkit.bridges.service import Service
from urdfkit.errors import ResourceError
from urdfkit.messages import full_type_name

TIMEOUT = 10.0
"""Seconds to wait for a connection."""
MAX_FRAME = 256 * 1024 * 1024
"""Bytes of the longest frame that is accepted."""
THROTTLED = ("sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/CompressedImage")
THROTTLE = 100
"""Milliseconds between two messages of these types, which are long in JSON."""


class RosbridgeNode:
    """A client of a server of rosbridge.

    Args:
        url: ``rosbridge://HOST:PORT``, with ``/?token=…`` if the server requires one.
        report: receives a line when the server is gone.

    Raises:
        ResourceError: no server responds there.

    Attributes:
        operations: operation of a frame → function that takes its message, in the thread of the connection.
        gone: called when the server is gone, in that thread.
    """

    ros, option = "rosbridge", "--live"

    def __init__(self, url: str, report: Callable[[str], None]) -> None:
        self.description, self._report = url, report
        self._receivers: dict[str, Callable[[bytes], None]] = {}
        self._responses: dict[str, Future[Any]] = {}
        self.operations: dict[str, Callable[[dict[str, Any]], object]] = {}
        self.gone: Callable[[], object] = lambda: None
        self._number, self._closed = 0, False
        self._sent: Future[Any] | None = None
        self._loop = asyncio.new_event_loop()
        Thread(target=self._loop.run_forever, name="rosbridge", daemon=True).start()
        try:
            address = url.replace("rosbridge://", "ws://", 1)
            self._socket = self._run(_connect(address)).result(TIMEOUT)
        except (OSError, HTTPClientError, TimeoutError, ValueError) as error:
            self._loop.call_soon_threadsafe(self._loop.stop)
            raise ResourceError(f"{url}: no rosbridge server responds ({error or 'timeout'})") from error
        self._run(self._read())

    def writer(self, topic: str, type: str, quality: Quality) -> _RosbridgeWriter:
        """Create a publisher."""
        self._send(op="advertise", topic=topic, type=type, latch=quality.latched)
        return _RosbridgeWriter(self, topic)

    def subscribe(self, topic: str, type: str, quality: Quality, receive: Callable[[bytes], None]) -> End:
        """Call `receive`, in the thread of the connection, with each message as JSON."""
        self._receivers[topic] = receive
        slow = {"throttle_rate": THROTTLE, "queue_length": 1} if type in THROTTLED else {}
        self._send(op="subscribe", topic=topic, type=type, **slow)

        def end() -> None:
            self._receivers.pop(topic, None)
            self._send(op="unsubscribe", topic=topic)

        return end

    def encode(self, message: Any, type: str) -> bytes:
        """Return a message as JSON."""
        return to_json(message).encode()

    def decode(self, data: bytes, type: str) -> Any:
        """Return the message of its JSON."""
        return from_json(type, json.loads(data))

    def topics(self) -> dict[str, str]:
        """Return topic → type, by the service ``/rosapi/topics``."""
        values = self._call("/rosapi/topics", {})
        return {name: full_type_name(type) for name, type in zip(values["topics"], values["types"], strict=True)}

    def subscribers(self, topic: str) -> list[str]:
        """Return the names of the nodes that subscribe to a topic, by the service ``/rosapi/subscribers``."""
        return list(self._call("/rosapi/subscribers", {"topic": topic})["subscribers"])

    def services(self) -> list[str]:
        """Return the names of the services, by the service ``/rosapi/services``."""
        return sorted(self._call("/rosapi/services", {})["services"])

    def service_type(self, service: str) -> str:
        """Return the type of a service, by the service ``/rosapi/service_type``."""
        return full_type_name(self._call("/rosapi/service_type", {"service": service})["type"], "srv")

    def call(self, service: str, type: str, fields: Any) -> Any:
        """Call a service and return the fields of its response."""
        return self._call(service, fields or {})

    def _call(self, service: str, fields: Any) -> Any:
        self._number += 1
        number = str(self._number)
        answered = self._responses[number] = Future()
        self._send(op="call_service", service=service, args=fields, id=number)
        try:
            message = answered.result(RESPONSE)
        except TimeoutError as error:
            raise ResourceError(f"{self.description}: {service} does not respond") from error
        finally:
            del self._responses[number]
        if not message.get("result", True):
            raise ResourceError(f"{service}: {message.get('values')}")
        return message.get("values") or {}

    def serve(self, service: Service, call: Callable[[Any, Done], None]) -> None:
        """Refuse the service: a client serves none.

        Raises:
            UnknownTypeError: always.
        """
        raise UnknownTypeError(f"a rosbridge client cannot serve {service.name}")

    def send(self, text: str) -> None:
        """Send a frame; it is dropped when the server is gone."""
        if not self._closed:
            self._sent = self._run(self._write(text))

    def close(self) -> None:
        """Disconnect, after the last frame was sent."""
        if self._sent is not None:
            with suppress(TimeoutError):
                self._sent.result(1.0)
        self._closed = True
        self._loop.call_soon_threadsafe(self._socket.close)
        self._loop.call_soon_threadsafe(self._loop.stop)

    def _send(self, **fields: Any) -> None:
        self.send(json.dumps(fields))

    def _run(self, work: Any) -> Future[Any]:
        return asyncio.run_coroutine_threadsafe(work, self._loop)

    async def _write(self, text: str) -> None:
        try:
            await self._socket.write_message(text)
        except WebSocketClosedError:
            self._closed = True

    async def _read(self) -> None:
        while (frame := await self._socket.read_message()) is not None:
            try:
                message = json.loads(frame)
                op = message.get("op")
            except (ValueError, AttributeError):
                continue
            if op == "publish" and (receive := self._receivers.get(message.get("topic"))) is not None:
                receive(json.dumps(message.get("msg")).encode())
            elif op == "service_response" and (waiting := self._responses.get(message.get("id"))) is not None:
                waiting.set_result(message)
            elif op in self.operations:
                self.operations[op](message)
        if not self._closed:
            self._closed = True
            self._report(f"{self.description}: the server has disconnected")
            self.gone()


async def _connect(address: str) -> WebSocketClientConnection:
    return await websocket_connect(address, connect_timeout=TIMEOUT, max_message_size=MAX_FRAME)


class _RosbridgeWriter:
    def __init__(self, node: RosbridgeNode, topic: str) -> None:
        self._node, self._topic = node, topic

    def publish(self, data: bytes) -> None:
        """Publish a message."""
        self._node.send(f'{{"op":"publish","topic":{json.dumps(self._topic)},"msg":{data.decode()}}}')

    def is_matched(self) -> bool:
        """Return whether the topic has a subscriber, or whether the server lacks rosapi."""
        try:
            return bool(self._node.subscribers(self._topic))
        except ResourceError:
            return True
