"""One client of the Foxglove protocol."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from urdfkit.bridges.foxglove import server_messages
from urdfkit.bridges.foxglove.channels import Channels
from urdfkit.bridges.foxglove.encodings import decode, encode
from urdfkit.bridges.foxglove.frames import (
    ClientMessage,
    ServiceRequest,
    asset_frame,
    message_frame,
    read_frame,
    response_frame,
    time_frame,
)
from urdfkit.bridges.graph import Graph
from urdfkit.bridges.published_message import PublishedMessage
from urdfkit.bridges.websocket.send_queue import Frame, SendQueue, SubscriptionQueue
from urdfkit.bus import absolute
from urdfkit.errors import UrdfkitError, UsageError

CLOCK, CLOCK_TYPE = "/clock", "rosgraph_msgs/msg/Clock"
TIME_PERIOD = 0.02
"""Seconds between two frames with the time."""


class FoxglovePeer:
    """State of one client; used in the thread of the server.

    Args:
        graph: the topics and services of the simulation.
        channels: the numbers of topics and services.
        queue: of the frames for the client.
        read_asset: returns the content of a file by its URI.
        report: receives a line for the user about a message that was dropped.
        closed: called with this object when the connection ends.
    """

    def __init__(
        self,
        graph: Graph,
        channels: Channels,
        queue: SendQueue,
        read_asset: Callable[[str], bytes],
        report: Callable[[str], None],
        closed: Callable[[FoxglovePeer], None],
    ) -> None:
        self._closed = closed
        self._graph, self._channels, self._queue = graph, channels, queue
        self._read_asset, self._report = read_asset, report
        self._announced = 0
        self._subscriptions: dict[int, tuple[SubscriptionQueue, Callable[[], None]]] = {}
        self._published: dict[int, tuple[str, str, str]] = {}
        self._operations: dict[str, Callable[[dict[str, Any]], None]] = {
            "subscribe": self._subscribe,
            "unsubscribe": self._unsubscribe,
            "advertise": self._advertise,
            "unadvertise": self._unadvertise,
            "getParameters": self._get_parameters,
            "setParameters": self._set_parameters,
            "fetchAsset": self._fetch_asset,
        }
        queue.reply(server_messages.server_info(channels.session))
        self.announce()
        queue.reply(server_messages.advertise_services(channels.services))
        self._listen(-1, CLOCK, CLOCK_TYPE, SubscriptionQueue(_time, length=1, period=TIME_PERIOD))

    def announce(self) -> None:
        """Send the channels that this client has not received yet."""
        rows = self._channels.rows[self._announced :]
        if rows:
            self._announced += len(rows)
            self._queue.reply(server_messages.advertise(rows))

    def receive(self, frame: str | bytes) -> None:
        """Process a frame; an error is reported to the client and the user, and has no other effect."""
        try:
            if isinstance(frame, bytes):
                content = read_frame(frame)
                if isinstance(content, ClientMessage):
                    self._publish(content)
                else:
                    self._call(content)
                return
            message = json.loads(frame)
            if not isinstance(message, dict):
                raise UsageError("a message is not a JSON object")
            if (operation := self._operations.get(str(message.get("op")))) is None:
                raise UsageError(f"unknown operation `{message.get('op')}`")
            operation(message)
        except (UrdfkitError, RecursionError, ValueError) as error:
            self._fail(str(error))
        except (AttributeError, KeyError, TypeError) as error:
            self._fail(f"a field is missing or has the wrong type: {error}")

    def close(self) -> None:
        """End all subscriptions."""
        for number in list(self._subscriptions):
            self._end(number)
        self._closed(self)

    def _fail(self, reason: str) -> None:
        self._report(reason)
        self._queue.reply(server_messages.status(reason))

    def _subscribe(self, message: dict[str, Any]) -> None:
        for each in message["subscriptions"]:
            number, (topic, type) = int(each["id"]), self._channels.topic(each["channelId"])
            if not 0 <= number < 2**32 or number in self._subscriptions:
                raise UsageError(f"the subscription {number} already exists or is out of range")

            def frames(published: PublishedMessage, number: int = number) -> list[Frame]:
                return [message_frame(number, round(published.t * 1e9), published.cdr())]

            self._listen(number, topic, type, SubscriptionQueue(frames))

    def _listen(self, number: int, topic: str, type: str, queue: SubscriptionQueue) -> None:
        self._queue.add(queue)
        end = self._graph.subscribe(
            topic, type, lambda published: self._queue.put(queue, published), PublishedMessage.cdr
        )
        self._subscriptions[number] = queue, end

    def _unsubscribe(self, message: dict[str, Any]) -> None:
        for number in message["subscriptionIds"]:
            if number in self._subscriptions and number >= 0:
                self._end(number)

    def _end(self, number: int) -> None:
        queue, end = self._subscriptions.pop(number)
        end()
        self._queue.remove(queue)

    def _advertise(self, message: dict[str, Any]) -> None:
        for each in message["channels"]:
            topic = absolute(each["topic"])
            type = self._graph.type_of(topic, each["schemaName"])
            self._published[int(each["id"])] = topic, type, each["encoding"]

    def _unadvertise(self, message: dict[str, Any]) -> None:
        for number in message["channelIds"]:
            self._published.pop(number, None)

    def _publish(self, message: ClientMessage) -> None:
        if message.channel not in self._published:
            raise UsageError(f"the channel {message.channel} is not advertised")
        topic, type, encoding = self._published[message.channel]
        self._graph.publish(topic, decode(type, encoding, message.content), len(message.content), self._fail)

    def _call(self, request: ServiceRequest) -> None:
        def fail(reason: str) -> None:
            self._queue.reply(server_messages.service_failure(request.service, request.call, reason))

        service = self._channels.services.get(request.service)
        if service is None:
            fail(f"no service {request.service}")
            return

        def done(response: Any, reason: str | None) -> None:
            if reason is not None:
                fail(reason)
            else:
                content = encode(service.response, request.encoding, response)
                self._queue.reply(response_frame(request, content))

        try:
            message = decode(service.request, request.encoding, request.content)
            self._graph.request(service, message, len(request.content), done)
        except UrdfkitError as error:
            fail(str(error))

    def _get_parameters(self, message: dict[str, Any]) -> None:
        names = [absolute(name) for name in message.get("parameterNames", ())]
        self._queue.reply(server_messages.parameter_values(self._graph.parameters, names, message.get("id")))

    def _set_parameters(self, message: dict[str, Any]) -> None:
        raise UsageError("parameters are read-only")

    def _fetch_asset(self, message: dict[str, Any]) -> None:
        number = message["requestId"]
        if not isinstance(number, int) or not 0 <= number < 2**32:
            raise UsageError(f"`requestId` is `{number}`; it must be a number from 0 to {2**32 - 1}")
        try:
            self._queue.reply(asset_frame(number, self._read_asset(str(message["uri"]))))
        except UrdfkitError as error:
            self._queue.reply(asset_frame(number, None, str(error)))


def _time(published: PublishedMessage) -> list[Frame]:
    return [time_frame(round(published.t * 1e9))]
