"""XML-RPC of ROS 1: calls to the master and to other nodes, and the server of this node.

https://wiki.ros.org/ROS/Master_API, https://wiki.ros.org/ROS/Slave_API
"""

import http.client
from socketserver import ThreadingMixIn
from typing import Any
from xmlrpc.client import Fault, ServerProxy, Transport
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

from urdfkit.bridges.ros1.tcpros import TIMEOUT

MAX_REQUEST = 1024 * 1024
"""Bytes of the longest request that is accepted."""


class _TimedTransport(Transport):
    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = TIMEOUT
        return connection


def call(uri: str, function: str, *arguments: Any) -> Any:
    """Call a function of the master or of a node; return the value of its answer.

    Raises:
        OSError: nothing answers within `TIMEOUT`.
        xmlrpc.client.Error: the answer reports a failure, or is malformed.
    """
    with ServerProxy(uri, transport=_TimedTransport()) as proxy:
        answer: Any = getattr(proxy, function)(*arguments)
    if not isinstance(answer, list) or len(answer) != 3 or answer[0] != 1:
        raise Fault(0, str(answer[1] if isinstance(answer, list) and len(answer) > 1 else answer))
    return answer[2]


class _Handler(SimpleXMLRPCRequestHandler):
    rpc_paths = ("/", "/RPC2")
    timeout = TIMEOUT

    def do_POST(self) -> None:  # noqa: N802
        """Reject requests of web pages and requests that are too long."""
        length = self.headers.get("Content-Length", "")
        if "Origin" in self.headers or not length.isdecimal() or int(length) > MAX_REQUEST:
            self.send_error(403)
        else:
            super().do_POST()


class NodeServer(ThreadingMixIn, SimpleXMLRPCServer):
    """Server of the functions that the master and other nodes call.

    Args:
        host: address to listen on.
    """

    daemon_threads = True
    block_on_close = False

    def __init__(self, host: str) -> None:
        super().__init__((host, 0), requestHandler=_Handler, logRequests=False)
