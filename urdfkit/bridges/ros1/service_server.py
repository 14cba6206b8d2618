"""ROS 1 services: one connection carries requests and responses in turns."""

import socket
from collections.abc import Callable
from queue import Queue
from typing import Any

from urdfkit.bridges.node.node import Done
from urdfkit.bridges.ros1.ros1_types import ANY, decode, encode, ros1_name, service_checksum
from urdfkit.bridges.ros1.tcpros import LENGTH, TcprosError, read_block, write_header
from urdfkit.bridges.service import Service


class ServiceServer:
    """Server of one service.

    Args:
        node: name of this node.
        service: the service.
        call: receives each request and what sends its response.
    """

    def __init__(self, node: str, service: Service, call: Callable[[Any, Done], None]) -> None:
        self.service = service
        self._node, self._call = node, call

    def connect(self, connection: socket.socket, header: dict[str, str]) -> None:
        """Answer the requests of a client until it disconnects.

        Raises:
            TcprosError: it expects another type, or has disconnected.
        """
        checksum = service_checksum(self.service.type)
        if header.get("md5sum") not in (ANY, checksum):
            raise TcprosError(f"{self.service.name} has type {ros1_name(self.service.type)} with checksum {checksum}")
        request, response = (ros1_name(each) for each in (self.service.request, self.service.response))
        fields = {"callerid": self._node, "type": ros1_name(self.service.type), "md5sum": checksum}
        write_header(connection, {**fields, "request_type": request, "response_type": response})
        if header.get("probe") == "1":
            return
        while True:
            content = self._answer(read_block(connection))
            connection.sendall(content)
            if header.get("persistent") != "1":
                return

    def _answer(self, data: bytes) -> bytes:
        answers: Queue[tuple[Any, str | None]] = Queue()
        try:
            request = decode(data, self.service.request)
        except Exception as error:  # of a malformed message, by several classes
            answers.put((None, f"the request is not a {self.service.request}: {error}"))
        else:
            self._call(request, lambda response, reason: answers.put((response, reason)))
        response, reason = answers.get()
        content = encode(response, self.service.response) if reason is None else str(reason).encode()
        return bytes((reason is None,)) + LENGTH.pack(len(content)) + content
