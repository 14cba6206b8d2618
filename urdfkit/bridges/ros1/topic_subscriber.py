"""TopicSubscriber: one topic that this node receives, with a thread for each publisher."""

import socket
from collections.abc import Callable, Sequence
from contextlib import suppress
from threading import Lock, Thread
from xmlrpc.client import Error

from urdfkit.bridges.ros1.tcpros import TIMEOUT, TcprosError, read_block, read_header, write_header
from urdfkit.bridges.ros1.xml_rpc import call

Receive = Callable[[bytes], None]


class TopicSubscriber:
    """Subscriber to one topic.

    Args:
        node: name of this node.
        topic: absolute name.
        type: name of the type in ROS 1, and its checksum; `ANY` accepts every type.
        receive: called with the bytes of each message.
        connected: called with the header of each publisher, before its messages.
        report: receives a line about a publisher that cannot be used.
    """

    def __init__(
        self,
        node: str,
        topic: str,
        type: tuple[str, str],
        receive: Receive,
        connected: Callable[[dict[str, str]], None],
        report: Callable[[str], None],
    ) -> None:
        self.topic, self.type = topic, type
        self._node, self._receive, self._connected, self._report = node, receive, connected, report
        self._sockets: dict[str, socket.socket | None] = {}
        self._lock = Lock()

    def follow(self, publishers: Sequence[str]) -> None:
        """Connect to new publishers, and disconnect from publishers outside the list.

        Args:
            publishers: addresses of nodes.
        """
        with self._lock:
            for uri in [uri for uri in self._sockets if uri not in publishers]:
                _shut(self._sockets.pop(uri))
            for uri in publishers:
                if uri not in self._sockets:
                    self._sockets[uri] = None
                    Thread(target=self._run, args=(uri,), name=f"ros1-{self.topic}", daemon=True).start()

    def close(self) -> None:
        """Disconnect from all publishers."""
        self.follow(())

    def _run(self, uri: str) -> None:
        try:
            host, port = self._request(uri)
            with socket.create_connection((host, port), timeout=TIMEOUT) as connection:
                connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                name, checksum = self.type
                fields = {"callerid": self._node, "topic": self.topic, "type": name, "md5sum": checksum}
                write_header(connection, {**fields, "tcp_nodelay": "1"})
                self._connected(read_header(connection))
                connection.settimeout(None)
                with self._lock:
                    if uri not in self._sockets:
                        return
                    self._sockets[uri] = connection
                while True:
                    self._receive(read_block(connection))
        except (TcprosError, OSError, Error) as error:
            with self._lock:
                lost = self._sockets.get(uri) is None and uri in self._sockets
                self._sockets.pop(uri, None)  # the master names it again when it is back
            if lost:
                self._report(f"`{self.topic}`: no connection to its publisher {uri}: {error}")

    def _request(self, uri: str) -> tuple[str, int]:
        protocol = call(uri, "requestTopic", self._node, self.topic, [["TCPROS"]])
        if not isinstance(protocol, list) or len(protocol) != 3 or protocol[0] != "TCPROS":
            raise TcprosError("it does not offer TCPROS")
        return str(protocol[1]), int(protocol[2])


def _shut(connection: socket.socket | None) -> None:
    if connection is not None:
        with suppress(OSError):
            connection.shutdown(socket.SHUT_RDWR)
