"""TopicPublisher: one topic that this node publishes, with a queue and a thread for each subscriber."""

import socket
from collections import deque
from contextlib import suppress
from threading import Condition, Thread

from urdfkit.bridges.node.node import Quality
from urdfkit.bridges.ros1.ros1_types import ANY, Definition
from urdfkit.bridges.ros1.tcpros import LENGTH, TcprosError, write_header


class TopicPublisher:
    """Publisher of one topic.

    Args:
        node: name of this node.
        topic: absolute name.
        definition: of the type.
        quality: its depth bounds the queue of each subscriber; latched topics send their last message to new ones.
    """

    def __init__(self, node: str, topic: str, definition: Definition, quality: Quality) -> None:
        self.topic, self.definition = topic, definition
        self._node, self._quality = node, quality
        self._links: tuple[_Link, ...] = ()
        self._latest: bytes | None = None

    def publish(self, data: bytes) -> None:
        """Queue a message for every subscriber; a slow one loses its oldest messages."""
        message = LENGTH.pack(len(data)) + data
        if self._quality.latched:
            self._latest = message
        for link in self._links:
            link.put(message)

    def is_matched(self) -> bool:
        """Return whether there is a subscriber."""
        self._links = tuple(link for link in self._links if not link.closed)
        return bool(self._links)

    def connect(self, connection: socket.socket, header: dict[str, str]) -> None:
        """Accept a subscriber with its connection header.

        Raises:
            TcprosError: it expects another type.
        """
        name, text, checksum = self.definition
        if header.get("md5sum") not in (ANY, checksum) or header.get("type") not in (ANY, name, None):
            raise TcprosError(
                f"{self.topic} has type {name} with checksum {checksum}, not {header.get('type')} with "
                f"{header.get('md5sum')}"
            )
        fields = {"callerid": self._node, "topic": self.topic, "type": name, "md5sum": checksum}
        fields |= {"message_definition": text, "latching": str(int(self._quality.latched))}
        write_header(connection, fields)
        link = _Link(connection, self._quality.depth)
        if self._latest is not None:
            link.put(self._latest)
        self._links = (*self._links, link)

    def close(self) -> None:
        """Disconnect all subscribers."""
        for link in self._links:
            link.close()


class _Link:
    """Connection to one subscriber."""

    def __init__(self, connection: socket.socket, depth: int) -> None:
        self.closed = False
        self._connection = connection
        self._queue: deque[bytes] = deque(maxlen=depth)
        self._changed = Condition()
        Thread(target=self._send, name="ros1-subscriber", daemon=True).start()

    def put(self, message: bytes) -> None:
        with self._changed:
            self._queue.append(message)
            self._changed.notify()

    def close(self) -> None:
        with suppress(OSError):
            self._connection.shutdown(socket.SHUT_RDWR)
        with self._changed:
            self.closed = True
            self._changed.notify()

    def _send(self) -> None:
        with suppress(OSError), self._connection:
            while True:
                with self._changed:
                    while not self._queue and not self.closed:
                        self._changed.wait()
                    if self.closed:
                        break
                    message = self._queue.popleft()
                self._connection.sendall(message)
        self.closed = True
