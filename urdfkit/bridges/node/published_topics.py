"""Topics that a bridge publishes, encoded and sent by a thread of its own while subscribers are matched."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from threading import Event, Thread
from typing import Any

from urdfkit.bridges.bridge import CallQueue
from urdfkit.bridges.message_builder import MessageBuilder
from urdfkit.bridges.node.node import Node, Quality, Writer
from urdfkit.bus import Bus, Subscription, Topic
from urdfkit.errors import UsageError

MATCH_PERIOD = 0.05
"""Seconds between two checks for subscribers."""
WATCH_PERIOD = 1.0
"""Seconds between two calls of the function that watches the graph."""


class PublishedTopic:
    """One topic that is published; the bus is subscribed to while the writer has a subscriber, or for good if latched.

    Args:
        bus: of the simulation.
        topic: of the bus.
        node: encodes the messages.
        writer: its publisher.
        quality: of the publisher.
        builder: builds messages that take long; None to build them in the thread of the simulation.
        ready: receives the output for each message.
    """

    def __init__(
        self,
        bus: Bus,
        topic: Topic,
        node: Node,
        writer: Writer,
        quality: Quality,
        builder: MessageBuilder | None,
        ready: Callable[[PublishedTopic], None],
    ) -> None:
        self.writer, self.is_latched, self.was_matched = writer, quality.latched, False
        self._bus, self._topic, self._node, self._ready = bus, topic, node, ready
        self._builder = builder
        self._pending: deque[Any] = deque(maxlen=quality.depth)
        self._subscription: Subscription | None = None
        if quality.latched:
            self.open()
            if topic.count and (latest := topic.latest) is not None:
                self._receive(latest)

    def open(self) -> None:
        """Subscribe to the bus, in the thread of the simulation."""
        if self._subscription is None:
            builder, receive = self._builder, self._receive
            self._subscription = self._bus.subscribe(
                self._topic.name,
                self._topic.type,
                receive,
                defer=None if builder is None else lambda build: builder.add(self._topic.name, build, receive),
            )

    def close(self) -> None:
        """End the subscription, in the thread of the simulation."""
        if self._subscription is not None:
            self._subscription.close()
            self._subscription = None

    def send(self) -> None:
        """Encode and publish the oldest message that waits, if it was not replaced by newer ones.

        Raises:
            UsageError: it cannot be encoded.
        """
        if self._pending:
            message = self._pending.popleft()
            try:
                data = self._node.encode(message, self._topic.type)
            except Exception as error:  # of several classes: a number or text that the type cannot contain
                line = f"`{self._topic.name}`: a message cannot be sent to {self._node.ros}: {error}"
                raise UsageError(line.splitlines()[0]) from error
            self.writer.publish(data)

    def _receive(self, message: Any) -> None:
        self._pending.append(message)
        self._ready(self)


class OutputThread:
    """Encodes and sends messages, and reports to the simulation which topics have subscribers.

    Args:
        calls: of the simulation.
        node: on the graph.
        builder: builds messages that take long, see `PublishedTopic`.
        report: receives a line if a message cannot be sent.
        watch: called once a second.
    """

    def __init__(
        self,
        calls: CallQueue,
        node: Node,
        builder: MessageBuilder | None,
        report: Callable[[str], None],
        watch: Callable[[], None],
    ) -> None:
        self._calls, self._node, self._builder, self._report, self._watch = calls, node, builder, report, watch
        self._outputs: tuple[PublishedTopic, ...] = ()
        self._ready: deque[PublishedTopic] = deque()
        self._wake, self._stopped = Event(), False
        self._thread = Thread(target=self._run, name="ros-output", daemon=True)
        self._thread.start()

    def add(self, bus: Bus, topic: Topic, writer: Writer, quality: Quality) -> None:
        """Publish a topic."""
        output = PublishedTopic(bus, topic, self._node, writer, quality, self._builder, self._notify)
        self._outputs = (*self._outputs, output)

    def close(self) -> None:
        """End the subscriptions and the thread."""
        for output in self._outputs:
            output.close()
        self._stopped = True
        self._wake.set()
        self._thread.join(1.0)

    def _notify(self, output: PublishedTopic) -> None:
        self._ready.append(output)
        self._wake.set()

    def _run(self) -> None:
        import time

        checked, watched = 0.0, time.monotonic()
        while not self._stopped:
            if time.monotonic() - checked >= MATCH_PERIOD:
                checked = time.monotonic()
                for output in self._outputs:
                    self._match(output)
            if checked - watched >= WATCH_PERIOD:
                watched = checked
                self._watch()
            self._wake.wait(MATCH_PERIOD)
            self._wake.clear()
            while self._ready and not self._stopped and time.monotonic() - checked < MATCH_PERIOD:
                output = self._ready.popleft()
                try:
                    output.send()
                except UsageError as error:
                    self._report(str(error))
                except Exception as error:  # of a middleware; the simulation continues
                    self._stopped = True
                    self._report(f"{self._node.option} stops publishing: {str(error).splitlines()[0]}")
            if self._ready:
                self._wake.set()

    def _match(self, output: PublishedTopic) -> None:
        matched = output.is_latched or output.writer.is_matched()
        if matched != output.was_matched and self._calls.add(output.open if matched else output.close):
            output.was_matched = matched
