"""Bridge: what every connection of a running simulation with other programs has in common.

A bridge uses the network in a thread of its own. Only the thread of the simulation changes the simulation: other
threads add calls to the queue, and that thread takes them before its next steps.
"""

from collections import deque
from collections.abc import Callable, Iterator
from threading import Event, Lock
from typing import Any, Protocol

from urdfkit.bridges.message_builder import MessageBuilder
from urdfkit.bus import Bus, Topic
from urdfkit.errors import UrdfkitError

LATCHED = ("tf_static", "robot_description")
"""Last parts of the names of topics whose last message a new subscriber receives."""
CAPACITY = 10_000
"""Calls that may wait for the simulation; further ones are dropped."""
MOST_BYTES = 64 * 1024 * 1024
"""Bytes of messages that may wait in calls; a call that exceeds them is dropped unless it is the only one."""


class Bridge(Protocol):
    """Connection of a simulation with other programs; made with the bus and the queue of the simulation.

    It subscribes to a topic of the bus only while a peer is matched with it, so that no message is built or encoded
    without need. Both methods are called by the thread of the simulation.
    """

    def update(self) -> None:
        """Follow topics that were advertised since the last call; called before the calls of the queue."""

    def close(self) -> None:
        """Disconnect, end the subscriptions and the thread; closing twice is harmless."""


class CallQueue:
    """Calls of other threads that wait for the thread of the simulation.

    Attributes:
        dropped: calls that were dropped because too many waited.
    """

    def __init__(self) -> None:
        self._calls: deque[tuple[Callable[[], None], int]] = deque()
        self._arrived, self._lock = Event(), Lock()
        self._bytes = self.dropped = 0

    def add(self, call: Callable[[], None], size: int = 0) -> bool:
        """Add a call, from any thread; return whether the queue had space for it and for the bytes of its message."""
        with self._lock:
            if len(self._calls) >= CAPACITY or (self._calls and self._bytes + size > MOST_BYTES):
                self.dropped += 1
                return False
            self._bytes += size
            self._calls.append((call, size))
        self._arrived.set()
        return True

    def wait(self, seconds: float) -> bool:
        """Wait until a call arrives, at most for a time [s]; return whether one arrived."""
        return self._arrived.wait(max(0.0, seconds))

    def take(self) -> None:
        """Run the calls that have arrived, in the thread of the simulation."""
        self._arrived.clear()
        for _ in range(len(self._calls)):
            with self._lock:
                call, size = self._calls.popleft()
                self._bytes -= size
            call()


class Bridges:
    """The open bridges of one simulation, and the queue and the builder of messages that they share."""

    def __init__(self, report: Callable[[str], None] = lambda line: None) -> None:
        self.calls = CallQueue()
        self.builder = MessageBuilder(report)
        self._open: list[Bridge] = []

    def __bool__(self) -> bool:
        """Whether a bridge is open."""
        return bool(self._open)

    def add(self, bridge: Bridge) -> None:
        """Add an open bridge."""
        self._open.append(bridge)

    def take(self) -> None:
        """Follow new topics and run what peers requested; called before the next steps of the simulation."""
        for bridge in self._open:
            bridge.update()
        self.calls.take()

    def close(self) -> None:
        """Close all bridges, the last one first."""
        self.builder.close()
        while self._open:
            self._open.pop().close()


def message_topics(bus: Bus) -> Iterator[Topic]:
    """Iterate over the topics with messages; requests of services are topics of the bus too."""
    return (topic for topic in bus.topics if "/msg/" in topic.type)


def is_latched(topic: str) -> bool:
    """Whether a new subscriber of a topic receives its last message."""
    return topic.rpartition("/")[2] in LATCHED


def publish_received(bus: Bus, topic: str, message: Any, failed: Callable[[str], None]) -> None:
    """Publish a message of a peer; `failed` receives the reason if a subscriber does not accept it."""
    try:
        bus.publish(topic, message.__msgtype__, message)
    except (UrdfkitError, ArithmeticError, LookupError, TypeError, ValueError) as error:
        failed(f"`{topic}` does not accept this message: {error}")
