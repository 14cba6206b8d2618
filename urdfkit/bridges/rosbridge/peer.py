"""Rosbridge: the server for one simulation, and the operations of its clients by the protocol, version 2.

https://github.com/RobotWebTools/rosbridge_suite/blob/ros2/ROSBRIDGE_PROTOCOL.md
"""

import json
from collections.abc import Callable, Sequence
from typing import Any

from urdfkit.bridges.graph import Graph
from urdfkit.bridges.json_messages import from_json, to_json
from urdfkit.bridges.published_message import PublishedMessage
from urdfkit.bridges.rosbridge.incoming_goals import ClientGoals
from urdfkit.bridges.rosbridge.rosapi import Rosapi
from urdfkit.bridges.rosbridge.subscription import encoder
from urdfkit.bridges.websocket.address import Address
from urdfkit.bridges.websocket.send_queue import MAX_MESSAGES, SendQueue, SubscriptionQueue
from urdfkit.bridges.websocket.server import WebSocketServer
from urdfkit.bus import absolute, similar_topic
from urdfkit.errors import UrdfkitError, UsageError

LEVELS = ("none", "error", "warning", "info")
IGNORED = ("unadvertise", "auth", "unadvertise_service", "service_response")
"""Operations without an effect here."""
UNSUPPORTED = ("advertise_service", "advertise_action", "unadvertise_action")


class RosbridgePeer:
    """State of one client; used in the thread of the server.

    Args:
        graph: the topics and services of the simulation.
        queue: of the frames for the client.
        report: receives a line for the user about a message that was dropped.
    """

    def __init__(self, graph: Graph, queue: SendQueue, report: Callable[[str], None]) -> None:
        self._graph, self._queue, self._report = graph, queue, report
        self._size = 0  # of the frame that is processed [bytes]
        self._level = "none"  # as rosbridge_suite, which sends no status: roslibpy fails at one
        self._subscriptions: dict[tuple[str, str], tuple[SubscriptionQueue, Callable[[], None]]] = {}
        self._advertised: dict[str, str] = {}
        self._rosapi = Rosapi(graph)
        self._goals = ClientGoals(graph, queue.reply)
        self._operations: dict[str, Callable[[dict[str, Any]], None]] = {
            "advertise": self._advertise,
            "publish": self._publish,
            "subscribe": self._subscribe,
            "unsubscribe": self._unsubscribe,
            "call_service": self._call_service,
            "send_action_goal": self._goals.send,
            "cancel_action_goal": self._goals.cancel,
            "set_level": self._set_level,
        }

    def receive(self, frame: str | bytes) -> None:
        """Process a frame; an error is reported to the client and the user, and has no other effect."""
        number: Any = None
        self._size = len(frame)
        try:
            message = json.loads(frame)
            if not isinstance(message, dict):
                raise UsageError("a message is not a JSON object")
            number = message.get("id")
            op = message.get("op")
            if op in UNSUPPORTED:
                raise UsageError(f"`{op}` is not supported by a simulation")
            if op not in self._operations and op not in IGNORED:
                raise UsageError(f"unknown operation `{op}`{similar_topic(str(op), list(self._operations))}")
            if op in self._operations:
                self._operations[op](message)
        except (UrdfkitError, RecursionError, ValueError) as error:
            self._fail(number, str(error))
        except (AttributeError, KeyError, TypeError) as error:
            self._fail(number, f"a field is missing or has the wrong type: {error}")

    def close(self) -> None:
        """End all subscriptions."""
        for queue, end in self._subscriptions.values():
            end()
            self._queue.remove(queue)
        self._subscriptions.clear()
        self._goals.close()

    def _fail(self, number: Any, reason: str) -> None:
        self._report(reason)
        if self._level != "none":
            self._send(op="status", level="error", msg=reason, **({} if number is None else {"id": number}))

    def _send(self, **values: Any) -> None:
        self._queue.reply(json.dumps(values))

    def _set_level(self, message: dict[str, Any]) -> None:
        if (level := message.get("level")) not in LEVELS:
            raise UsageError(f"unknown level `{level}`; use {', '.join(LEVELS)}")
        self._level = level

    def _advertise(self, message: dict[str, Any]) -> None:
        topic = _text(message, "topic")
        self._advertised[topic] = self._graph.type_of(topic, _text(message, "type"))
        from_json(self._advertised[topic], None)  # raises if the type is unknown

    def _publish(self, message: dict[str, Any]) -> None:
        topic, number = _text(message, "topic"), message.get("id")
        type = self._graph.type_of(topic, self._advertised.get(topic) or message.get("type"))
        built = from_json(type, message.get("msg") or None)
        self._graph.publish(topic, built, self._size, lambda reason: self._fail(number, reason))

    def _subscribe(self, message: dict[str, Any]) -> None:
        topic = _text(message, "topic")
        type = self._graph.type_of(topic, message.get("type"))
        from_json(type, None)
        throttle, length = _number(message, "throttle_rate"), _number(message, "queue_length")
        queue = SubscriptionQueue(
            encoder(message.get("compression") or "none", _number(message, "fragment_size") or None),
            length=min(length, MAX_MESSAGES) or (1 if throttle else MAX_MESSAGES),
            period=throttle / 1000.0,
        )
        key = topic, str(message.get("id") or "")
        self._end(key)

        def receive(sample: PublishedMessage) -> None:
            self._queue.put(queue, sample)

        self._queue.add(queue)
        self._subscriptions[key] = queue, self._graph.subscribe(topic, type, receive, queue.encode)

    def _unsubscribe(self, message: dict[str, Any]) -> None:
        topic, number = _text(message, "topic"), message.get("id")
        for key in [key for key in self._subscriptions if key[0] == topic and number in (None, key[1])]:
            self._end(key)

    def _end(self, key: tuple[str, str]) -> None:
        if key in self._subscriptions:
            queue, end = self._subscriptions.pop(key)
            end()
            self._queue.remove(queue)

    def _call_service(self, message: dict[str, Any]) -> None:
        name, number, requested = _text(message, "service"), message.get("id"), message["service"]
        arguments = message.get("args") or {}

        def respond(values: str, result: bool) -> None:
            head = {"op": "service_response", "service": requested, "result": result}
            if number is not None:
                head["id"] = number
            self._queue.reply(f'{json.dumps(head)[:-1]}, "values": {values}}}')

        def done(response: Any, reason: str | None) -> None:
            respond(to_json(response) if reason is None else json.dumps(reason), reason is None)

        try:
            if self._rosapi.has(name):
                respond(json.dumps(self._rosapi.call(name, arguments)), True)
                return
            service = self._graph.services.get(name)
            if service is None:
                near = similar_topic(name, list(self._graph.services))
                raise UsageError(f"no service `{name}`{near}")
            self._graph.request(service, from_json(service.request, arguments or None), self._size, done)
        except UrdfkitError as error:
            respond(json.dumps(str(error)), False)


def _text(message: dict[str, Any], name: str) -> str:
    value = message.get(name)
    if not isinstance(value, str) or not value:
        raise UsageError(f"`{message.get('op')}` needs `{name}`, a string")
    return absolute(value) if name in ("topic", "service") else value


def _number(message: dict[str, Any], name: str) -> int:
    value = message.get(name) or 0
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value < 1e9:
        raise UsageError(f"`{name}` is `{value}`; it must be a number, zero or greater")
    return int(value)


def serve_rosbridge(
    graph: Graph, address: Address, *, origins: Sequence[str] = (), report: Callable[[str], None]
) -> WebSocketServer:
    """Serve a simulation to the clients of rosbridge until the server is closed.

    Args:
        graph: the topics and services of the simulation.
        address: to listen on.
        origins: origins of web pages that may connect, in addition to pages of this machine.
        report: receives a line about each kind of message that was dropped.

    Raises:
        UsageError: the port is in use or the address cannot be bound.
    """
    return WebSocketServer(graph, address, lambda queue: RosbridgePeer(graph, queue, report), origins=origins)
