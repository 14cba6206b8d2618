"""Topic streams: every message of a topic for programs, as its time, its size, or its content."""

from collections.abc import Callable
from typing import Any

from urdfkit.app.simulation.features.feature import Feature
from urdfkit.app.simulation.features.message_values import as_json
from urdfkit.bus import Subscription, Topic
from urdfkit.sim.simulator import Simulator
from urdfkit.view.server.server import Server

TIMES, SIZES, MESSAGES, FULL_MESSAGES = "times:", "sizes:", "messages:", "full_messages:"
"""Prefixes of the keys: times of messages; times and sizes; content with long arrays cut; full content."""
KEYS = (TIMES, SIZES, MESSAGES, FULL_MESSAGES)
SOME = 128
"""Maximum entries of an array in a cut message; the default of ros2 topic echo."""
ALL = 4_000_000
"""Maximum entries of an array in a full message."""
LATCHED = "tf_static"
"""Last part of the names of topics whose last message is sent to new subscribers, as ROS latches it."""
PERIOD = 0.05
"""Seconds between two messages of a stream."""
SHARE = 0.25
"""Maximum share of the time for converting messages. Messages beyond it are dropped and counted."""
ADVANCE = 0.02
"""Seconds of conversion that may be used at once after a pause."""
MOST = 2000
"""Maximum number of messages in one part of a stream; others are dropped and counted."""


class TopicStreams(Feature):
    """Subscribes to the topics that programs request, and to no others."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._streams: dict[str, _Stream] = {}

    def tick(self) -> None:
        """Subscribe to the requested topics, and send their messages."""
        wanted = {key for key in self.server.hub.subscribed_keys if key.startswith(KEYS)}
        for key in [key for key in self._streams if key not in wanted]:
            self._streams.pop(key).close()
        topics = {topic.name: topic for topic in self.simulator.bus.topics} if wanted - self._streams.keys() else {}
        for key in wanted - self._streams.keys():
            # An unknown topic may be advertised later.
            if (topic := topics.get(key.partition(":")[2])) is not None:
                self._streams[key] = _Stream(self, key, topic)
        if self.is_due(PERIOD):
            for stream in self._streams.values():
                stream.send()


class _Stream:
    """The stream of one topic for one key."""

    def __init__(self, part: TopicStreams, key: str, topic: Topic) -> None:
        self._part, self._key, self._type = part, key, topic.type
        self._kind = f"{key.partition(':')[0]}:"
        self._rows: list[list[Any]] = []
        self._missed = 0
        self._owed, self._then = 0.0, part.clock()
        self._subscription: Subscription = part.simulator.bus.subscribe(topic.name, topic.type, self._take)
        if topic.name.endswith(f"/{LATCHED}") and topic.count:
            self._take(topic.latest)

    def _take(self, message: Any) -> None:
        begin = self._part.clock()
        self._owed = max(0.0, self._owed - SHARE * (begin - self._then))
        self._then = begin
        if (self._owed >= ADVANCE and self._kind != TIMES) or len(self._rows) >= MOST:
            self._missed += 1
            return
        row = [self._part.simulator.t, begin]
        if self._kind == SIZES:
            from urdfkit.messages import typestore

            row.append(len(typestore().serialize_cdr(message, self._type)))
        elif self._kind != TIMES:
            row.append(as_json(message, SOME if self._kind == MESSAGES else ALL))
        self._rows.append(row)
        self._owed += self._part.clock() - begin

    def send(self) -> None:
        """Send the messages since the last call, if any."""
        if not self._rows and not self._missed:
            return
        rows, missed = self._rows, self._missed
        self._rows, self._missed = [], 0
        begin = self._part.clock()
        self._part.server.send_chunk(self._key, "messages", source=self._key, rows=rows, missed=missed)
        self._owed += self._part.clock() - begin

    def close(self) -> None:
        """Unsubscribe."""
        self._subscription.close()
