"""PublishedMessage: one published message, encoded once for all peers that subscribe to its topic."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from urdfkit.messages.conversion import cdr_parts


def approximate_size(message: Any) -> int:
    """Return the approximate number of bytes of a message, the length of its long arrays."""
    return 200 + sum(getattr(getattr(message, name), "nbytes", 0) for name in message.__dataclass_fields__)


class PublishedMessage:
    """One message of a topic.

    Attributes:
        topic: name of the topic.
        type: type of the message.
        message: the message.
        t: simulated time of its publication [s].
        size: approximate number of bytes, the length of its long arrays.
    """

    __slots__ = ("_encoded", "message", "size", "t", "topic", "type")

    def __init__(self, topic: str, type: str, message: Any, t: float) -> None:
        self.topic, self.type, self.message, self.t = topic, type, message, t
        self.size = approximate_size(message)
        self._encoded: dict[str, Any] = {}

    def encoded(self, encoding: str, encode: Callable[[PublishedMessage], Any]) -> Any:
        """Return the message in an encoding; `encode` is called once for all peers."""
        if encoding not in self._encoded:
            self._encoded[encoding] = encode(self)
        return self._encoded[encoding]

    def cdr(self) -> list[bytes | memoryview]:
        """Return the parts of the message in CDR, the encoding of ROS 2."""
        return self.encoded("cdr", lambda it: cdr_parts(it.message, it.type))  # type: ignore[no-any-return]
