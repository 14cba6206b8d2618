"""Graph: topics and services of a simulation, for peers that a server serves in a thread of its own."""

from collections import deque
from collections.abc import Callable, Mapping
from threading import Lock
from typing import Any

from urdfkit.bridges.bridge import CAPACITY, MOST_BYTES, CallQueue, is_latched, message_topics, publish_received
from urdfkit.bridges.message_builder import MessageBuilder
from urdfkit.bridges.published_message import PublishedMessage
from urdfkit.bridges.service import Service, respond
from urdfkit.bus import Build, Bus, Subscription, absolute, similar_topic
from urdfkit.errors import UsageError
from urdfkit.messages import full_type_name

Receive = Callable[[PublishedMessage], None]
Post = Callable[[Callable[[], None]], None]


class Graph:
    """Topics and services of a simulation.

    One thread changes the simulation: what peers publish and call waits until the thread of the simulation runs
    the queue. Messages for peers wait until the thread of the server takes them.

    Args:
        bus: of the simulation.
        calls: queue of the calls for the thread of the simulation.
        clock: returns the simulated time [s].
        services: services that peers can call.
        parameters: parameter → value, for protocols that read parameters.
        builder: builds messages that take long; None to build them in the thread of the simulation.

    Attributes:
        post: runs a function in the thread of the server; the server replaces it.
    """

    def __init__(
        self,
        bus: Bus,
        calls: CallQueue,
        clock: Callable[[], float],
        services: Mapping[str, Service],
        parameters: Mapping[str, Any] | None = None,
        builder: MessageBuilder | None = None,
    ) -> None:
        self.bus, self.calls, self.clock, self.services = bus, calls, clock, services
        self.parameters, self.builder = dict(parameters or {}), builder
        self.post: Post = lambda call: call()
        self._samples: deque[tuple[tuple[Receive, ...], PublishedMessage]] = deque()
        self._bytes, self._posted, self._lock = 0, False, Lock()
        self._feeds: dict[str, _Feed] = {}

    def close(self) -> None:
        """End all subscriptions."""
        for feed in self._feeds.values():
            feed.close()
        self._feeds.clear()

    # In the thread of the server

    @property
    def topics(self) -> dict[str, str]:
        """Topic → type, without requests of services."""
        return {topic.name: topic.type for topic in message_topics(self.bus)}

    def type_of(self, topic: str, requested: str | None = None) -> str:
        """Return the type of a topic.

        Args:
            topic: absolute name.
            requested: type that a peer names; a topic that does not exist yet gets it.

        Raises:
            UsageError: the topic has another type, or is unknown and none was requested.
        """
        full = None if not requested else full_type_name(requested)
        actual = next((each.type for each in self.bus.topics if each.name == topic), None)
        if actual is None:
            if full is None:
                raise UsageError(f"no topic `{topic}`{similar_topic(topic, list(self.topics))}")
            return full
        if full is not None and full != actual:
            raise UsageError(f"topic `{topic}` has type {actual}, not {full}")
        return actual

    def subscribe(
        self, topic: str, type: str, receive: Receive, prepare: Callable[[PublishedMessage], object] | None = None
    ) -> Callable[[], None]:
        """Call `receive` with every message of a topic, in the thread of the server; return what ends it.

        Args:
            topic: name of the topic.
            type: of its messages.
            receive: receives each message.
            prepare: encodes messages that take long to build, in the thread of the builder.
        """
        name = absolute(topic)
        feed = self._feeds.get(name)
        if feed is None:
            feed = self._feeds[name] = _Feed(self, name, type)
            self.call(feed.open)
        feed.receivers = (*feed.receivers, receive)
        if prepare is not None:
            feed.prepare[receive] = prepare
        if is_latched(name):
            self.call(lambda: feed.latest(receive))

        def end() -> None:
            feed.receivers = tuple(each for each in feed.receivers if each is not receive)
            feed.prepare.pop(receive, None)
            if not feed.receivers and self._feeds.get(name) is feed:
                del self._feeds[name]
                self.call(feed.close)

        return end

    def call(self, function: Callable[[], None], size: int = 0) -> None:
        """Run a function in the thread of the simulation, before its next step; `size` is that of its message [bytes].

        Raises:
            UsageError: too many calls wait.
        """
        if not self.calls.add(function, size):
            raise UsageError(
                f"{CAPACITY} calls or {MOST_BYTES >> 20} MB of messages are queued for the simulation; "
                "this message is dropped"
            )

    def publish(self, topic: str, message: Any, size: int, failed: Callable[[str], None]) -> None:
        """Publish a message of a number of bytes; `failed` receives the reason if a subscriber cannot use it."""

        def publish() -> None:
            publish_received(self.bus, topic, message, lambda reason: self.post(lambda: failed(reason)))

        self.call(publish, size)

    def request(self, service: Service, message: Any, size: int, done: Callable[[Any, str | None], None]) -> None:
        """Call a service with a message of a number of bytes.

        `done` receives its response, or None and the reason, in the thread of the server.
        """

        def answer(found: Any, reason: str | None) -> None:
            self.post(lambda: done(found, reason))

        self.call(lambda: respond(service, message, answer), size)

    def deliver(self, receivers: tuple[Receive, ...], sample: PublishedMessage) -> None:
        """Hand a message to peers, in the thread of the server; called by the thread of the simulation."""
        with self._lock:
            self._samples.append((receivers, sample))
            self._bytes += sample.size
            while self._bytes > MOST_BYTES and len(self._samples) > 1:
                self._bytes -= self._samples.popleft()[1].size
            idle, self._posted = not self._posted, True
        if idle:
            self.post(self._drain)

    def _drain(self) -> None:
        with self._lock:
            samples, self._samples = self._samples, deque()
            self._bytes, self._posted = 0, False
        for receivers, sample in samples:
            for receive in receivers:
                receive(sample)


class _Feed:
    """The subscription of all peers to one topic."""

    def __init__(self, graph: Graph, topic: str, type: str) -> None:
        self._graph, self._topic, self._type = graph, topic, type
        self._subscription: Subscription | None = None
        self.receivers: tuple[Receive, ...] = ()
        self.prepare: dict[Receive, Callable[[PublishedMessage], object]] = {}

    def open(self) -> None:
        """Subscribe; the type was checked before, and another program may have created the topic since."""
        try:
            defer = None if self._graph.builder is None else self._build
            self._subscription = self._graph.bus.subscribe(self._topic, self._type, self._receive, defer=defer)
        except UsageError:
            self._subscription = None

    def close(self) -> None:
        """End the subscription."""
        if self._subscription is not None:
            self._subscription.close()

    def latest(self, receive: Receive) -> None:
        """Hand the last message to one receiver."""
        for topic in self._graph.bus.topics:
            if topic.name == self._topic and topic.count and (message := topic.latest) is not None:
                self._graph.deliver((receive,), self._sample(message))

    def _receive(self, message: Any) -> None:
        self._graph.deliver(self.receivers, self._sample(message))

    def _build(self, build: Build) -> None:
        t = self._graph.clock()

        def receive(message: Any) -> None:
            sample = PublishedMessage(self._topic, self._type, message, t)
            for prepare in tuple(self.prepare.values()):
                prepare(sample)
            self._graph.deliver(self.receivers, sample)

        assert self._graph.builder is not None
        self._graph.builder.add(self._topic, build, receive)

    def _sample(self, message: Any) -> PublishedMessage:
        return PublishedMessage(self._topic, self._type, message, self._graph.clock())
