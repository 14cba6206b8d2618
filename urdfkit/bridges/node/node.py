"""Node: interface of a ROS 1 or ROS 2 node to bridges and commands."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from urdfkit.bridges.actions import ActionServer
from urdfkit.bridges.bridge import is_latched
from urdfkit.bridges.service import Service
from urdfkit.errors import MissingDependencyError

DEPTH = 10
"""Messages that a publisher keeps for a slow subscriber, as ROS's own default."""
RESPONSE = 10.0
"""Seconds to wait for the response of a service."""
CLOCK = "/clock"
MAPS = ("map", "costmap")
"""Last parts of the names of topics that map_server and Nav2 publish with transient local durability."""

End = Callable[[], None]
"""Ends a subscription."""
Done = Callable[[Any, "str | None"], None]
"""Receives the response of a service, or None and the reason."""
Begin = Callable[[Any, Callable[[Any], None], Callable[[int, Any, str], None]], Callable[[], None]]
"""Sends a goal to the simulation, waits until it is accepted or has ended, and returns what cancels it.

Its arguments are the message of the goal, and what receives the feedback and the end, see `SentGoal`.
"""


class UnknownTypeError(MissingDependencyError):
    """The type of a message is not installed."""


@dataclass(frozen=True)
class Quality:
    """Quality of service of a publisher or subscription; the history keeps the last messages.

    Publishers are reliable, as those of ros_gz_bridge and gazebo_ros are: they serve reliable and best-effort
    subscribers. Subscriptions are best effort, and so accept both kinds of publishers.

    Attributes:
        reliable: lost messages are sent again.
        latched: durability is transient local, so that a late subscriber receives the last message.
        depth: messages that are kept.
    """

    reliable: bool = True
    latched: bool = False
    depth: int = DEPTH


def publisher_quality(topic: str) -> Quality:
    """Return the quality of the publisher of a topic; ``/clock`` is best effort, as rclcpp's ClockQoS."""
    if is_latched(topic):
        return Quality(latched=True, depth=1)
    return Quality(reliable=False, depth=1) if topic == CLOCK else Quality()


def subscription_quality(topic: str) -> Quality:
    """Return the quality of a subscription that accepts publishers of every kind."""
    latched = is_latched(topic) or topic.rpartition("/")[2] in MAPS
    return Quality(latched=True, depth=100) if latched else Quality(reliable=False)


class Writer(Protocol):
    """Publisher of one topic."""

    def publish(self, data: bytes) -> None:
        """Publish an encoded message; does not wait for a subscriber."""

    def is_matched(self) -> bool:
        """Return whether there is a subscriber."""


class Node(Protocol):
    """A node on the graph, used by any thread.

    Attributes:
        description: the library, for the user.
        ros: ``ROS 1`` or ``ROS 2``.
        option: the option that opened it, such as ``--ros2``.
    """

    description: str
    ros: str
    option: str

    def writer(self, topic: str, type: str, quality: Quality) -> Writer:
        """Create a publisher.

        Raises:
            UnknownTypeError: the library lacks the type.
        """

    def subscribe(self, topic: str, type: str, quality: Quality, receive: Callable[[bytes], None]) -> End:
        """Call `receive`, in a thread of the library, with each encoded message; return what ends it.

        Raises:
            UnknownTypeError: the library lacks the type.
        """

    def encode(self, message: Any, type: str) -> bytes:
        """Return a message as the graph transmits it."""

    def decode(self, data: bytes, type: str) -> Any:
        """Return a transmitted message; raises errors of several classes if it is malformed."""

    def topics(self) -> dict[str, str]:
        """Return topic → type of the graph."""

    def serve(self, service: Service, call: Callable[[Any, Done], None]) -> None:
        """Serve a service; `call` receives each request and what sends its response.

        Raises:
            UnknownTypeError: the library lacks the type, or services.
        """

    def services(self) -> list[str]:
        """Return the names of the services of the graph.

        Raises:
            UrdfkitError: the library has no services, or the graph does not respond.
        """

    def service_type(self, service: str) -> str:
        """Return the type of a service of the graph; an empty string if it is unknown.

        Raises:
            UrdfkitError: the service does not respond.
        """

    def call(self, service: str, type: str, fields: Any) -> Any:
        """Call a service of the graph, and return the fields of its response as JSON values.

        Raises:
            UrdfkitError: the service fails or does not respond, or its type is unknown or has no such fields.
        """

    def close(self) -> None:
        """Leave the graph."""


@runtime_checkable
class TypedGraph(Protocol):
    """A node of a graph on which a topic can have several types, whose publishers and subscribers ignore each other."""

    def types(self) -> dict[str, set[str]]:
        """Return topic → types of its publishers and subscribers."""


@runtime_checkable
class ActionNode(Protocol):
    """A node that serves actions by the library's own servers instead of their topics."""

    def serve_action(self, name: str, action: ActionServer, begin: Begin) -> None:
        """Serve an action of a simulation.

        Args:
            name: on the graph.
            action: of the simulation.
            begin: sends a goal to the simulation; called in a thread of the library.

        Raises:
            UnknownTypeError: the library lacks the type.
        """
