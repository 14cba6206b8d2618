"""Topics of a live graph on a bus: a topic is received while the bus has a subscriber to it."""

import itertools
import time
from collections.abc import Callable, Collection
from threading import Event, Thread
from typing import Any

from urdfkit.bridges.bridge import CallQueue
from urdfkit.bridges.node.node import End, Node, UnknownTypeError, Writer, publisher_quality, subscription_quality
from urdfkit.bus import Bus, Topic, similar_topic
from urdfkit.errors import ResourceError, UsageError
from urdfkit.messages import from_fields

SEARCH = 0.5
"""Seconds between two searches for new topics."""
FIRST_SEARCHES = 50
"""Searches that follow each other ten times faster, while the graph is discovered."""


class LiveTopics:
    """The topics of a graph.

    Args:
        node: on the graph.
        bus: publishes the messages that are received.
        report: receives lines about topics that cannot be received, each once.
        clock: wall clock [s].

    Attributes:
        node: on the graph.
        calls: received messages, until `update` publishes them.
        searched: set after the first search.
    """

    def __init__(self, node: Node, bus: Bus, report: Callable[[str], None], clock: Callable[[], float]) -> None:
        self.calls = CallQueue()
        self.node, self._bus, self._report, self._clock = node, bus, report, clock
        self._found: dict[str, str] = {}
        self.searched, self._closed = Event(), Event()
        self._ends: dict[str, End] = {}
        self._writers: dict[str, Writer] = {}
        self._reported: set[str] = set()
        self._thread = Thread(target=self._search, name="topics", daemon=True)
        self._thread.start()

    def update(self, shown: Collection[str] = ()) -> None:
        """Follow new topics, receive those with subscribers, and publish the messages that have arrived.

        Args:
            shown: further topics to receive.
        """
        found, self._found = self._found, {}
        for name, type in found.items():
            try:
                self._bus.advertise(name, type)
            except UsageError as error:
                self._note(str(error))
        for topic in self._bus.topics:
            wanted = bool(topic.subscribers) or topic.name in shown
            if wanted and topic.name not in self._ends:
                self._ends[topic.name] = self._follow(topic)
            elif not wanted and topic.name in self._ends:
                self._ends.pop(topic.name)()
        self.calls.take()

    def publish(self, topic: str, type: str, message: Any, *, wait: float = 0.0) -> None:
        """Publish a message on the graph.

        Args:
            topic: its name.
            type: of the message.
            message: the message.
            wait: longest time to wait for a subscriber of a new publisher [s].

        Raises:
            UrdfkitError: the library lacks the type, or the master is gone.
        """
        if topic not in self._writers:
            writer = self._writers[topic] = self.node.writer(topic, type, publisher_quality(topic))
            end = self._clock() + wait
            while self._clock() < end and not writer.is_matched():
                time.sleep(0.05)  # with rosbridge, each test is a request
            if wait and not writer.is_matched():
                self._note(f"urdfkit: {topic} has no subscribers{self._nearest(topic, type)}")
        self._writers[topic].publish(self.node.encode(message, type))

    def call(self, service: str, type: str, take: Callable[[Any], None]) -> None:
        """Call a service without values in a thread; `update` gives its response, unless the call fails, to `take`."""

        def work() -> None:
            try:
                response = from_fields(f"{type}_Response", self.node.call(service, type, {}))
            except Exception:  # of a missing server, by several classes
                return
            self.calls.add(lambda: take(response))

        Thread(target=work, name=service, daemon=True).start()

    def close(self) -> None:
        """End all subscriptions and leave the graph."""
        self._closed.set()
        self._thread.join(1.0)
        for end in self._ends.values():
            end()
        self._ends.clear()
        self.node.close()

    def _search(self) -> None:
        """Find topics, in a thread of its own: a slow graph must not stop the page."""
        for count in itertools.count():
            try:
                self._found = self.node.topics()
            except Exception as error:  # of a graph, by several classes
                if not self._closed.is_set():
                    self._note(str(error))
            self.searched.set()
            if self._closed.wait(SEARCH / 10 if count < FIRST_SEARCHES else SEARCH):
                return

    def _follow(self, topic: Topic) -> End:
        try:
            return self.node.subscribe(topic.name, topic.type, subscription_quality(topic.name), self._receiver(topic))
        except (UnknownTypeError, ResourceError) as error:
            self._note(f"{topic.name}: {error}")
            return lambda: None

    def _receiver(self, topic: Topic) -> Callable[[bytes], None]:
        """Return a function that publishes a message; it is decoded only for subscribers."""

        def decode(data: bytes) -> Any:
            try:
                return self.node.decode(data, topic.type)
            except Exception as error:  # of a malformed message, by several classes
                self._note(f"{topic.name}: dropped a message that is not a {topic.type} ({error})")
                return None

        def publish(data: bytes) -> None:
            if not topic.subscribers:
                topic.offer(lambda: decode(data))
            elif (message := decode(data)) is not None:
                topic.publish(message)

        def receive(data: bytes) -> None:
            self.calls.add(lambda: publish(data))

        return receive

    def _nearest(self, topic: str, type: str) -> str:
        """Return a suggestion of topics of a type."""
        same = sorted(name for name, other in self.node.topics().items() if other == type and name != topic)
        return similar_topic(topic, same) or (f"; topics of this type: {', '.join(same)}" if same else "")

    def _note(self, line: str) -> None:
        if line not in self._reported:
            self._reported.add(line)
            self._report(line)
