"""Node: interface of a node of ROS 2 to a bridge, which exchanges messages in CDR."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from urdfkit.bridges.bridge import is_latched
from urdfkit.errors import MissingDependencyError

DEPTH = 10
"""Messages that a publisher keeps for a slow subscriber, as ROS's own default."""
CLOCK = "/clock"


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


class Writer(Protocol):
    """Publisher of one topic."""

    def publish(self, data: bytes) -> None:
        """Publish a message in CDR, with its header of four bytes; does not wait for a subscriber."""

    def is_matched(self) -> bool:
        """Return whether there is a subscriber."""


class Node(Protocol):
    """A node of ROS 2, used by any thread.

    Attributes:
        description: the library, for the user.
    """

    description: str

    def writer(self, topic: str, type: str, quality: Quality) -> Writer:
        """Create a publisher.

        Raises:
            UnknownTypeError: the library lacks the type.
        """

    def subscribe(self, topic: str, type: str, quality: Quality, receive: Callable[[bytes], None]) -> None:
        """Call `receive`, in a thread of the library, with each message in CDR.

        Raises:
            UnknownTypeError: the library lacks the type.
        """

    def close(self) -> None:
        """Leave the graph."""
