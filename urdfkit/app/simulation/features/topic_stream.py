"""Listening: every message of a topic, for programs; when it came, how long it is, or what it says."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from urdfkit.app.simulation.features.feature import Part
from urdfkit.app.simulation.features.message_values import as_json

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.bus import Subscription, Topic
    from urdfkit.sim.simulator import Simulator
    from urdfkit.view.server.server import Server

TIMES, SIZES, EVERY, WHOLE = "times:", "sizes:", "every:", "whole:"
"""Begin the key of a topic's messages: when each came; and how many bytes it has; what it says, cut; in full."""
KEYS = (TIMES, SIZES, EVERY, WHOLE)
SOME = 128
"""Entries of an array in a message that is cut; the default of ros2 topic echo."""
ALL = 4_000_000
"""Entries of an array in a message in full."""
LATCHED = "tf_static"
"""Last part of the names of topics whose last message comes to who begins to listen, as ROS latches it."""
PERIOD = 0.05
"""Seconds between two parts of a stream."""
SHARE = 0.25
"""Part of the time that putting messages into words may take. What there is no time for is counted as missed."""
ADVANCE = 0.02
"""Seconds of such work that may be done at once, where none was for a while."""
MOST = 2000
"""Messages that are kept until the next part; those of more are counted as missed."""


class Listening(Part):
    """Listens to the topics that somebody wants every message of, and to no others."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._ears: dict[str, _Ear] = {}

    def tick(self) -> None:
        """Listen to what is wanted, and send what has come."""
        wanted = {key for key in self.server.hub.wanted if key.startswith(KEYS)}
        for key in [key for key in self._ears if key not in wanted]:
            self._ears.pop(key).close()
        topics = {topic.name: topic for topic in self.simulator.bus.topics} if wanted - self._ears.keys() else {}
        for key in wanted - self._ears.keys():
            # A topic that is not there yet may come.
            if (topic := topics.get(key.partition(":")[2])) is not None:
                self._ears[key] = _Ear(self, key, topic)
        if self.is_due(PERIOD):
            for ear in self._ears.values():
                ear.send()


class _Ear:
    """One topic, as one key wants it."""

    def __init__(self, part: Listening, key: str, topic: Topic) -> None:
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
            row.append(as_json(message, SOME if self._kind == EVERY else ALL))
        self._rows.append(row)
        self._owed += self._part.clock() - begin

    def send(self) -> None:
        """Send what has come since the last time; nothing where there is none."""
        if not self._rows and not self._missed:
            return
        rows, missed = self._rows, self._missed
        self._rows, self._missed = [], 0
        begin = self._part.clock()
        self._part.server.stream(self._key, "heard", source=self._key, rows=rows, missed=missed)
        self._owed += self._part.clock() - begin

    def close(self) -> None:
        """Listen no more."""
        self._subscription.close()
