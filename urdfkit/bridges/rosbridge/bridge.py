"""Rosbridge: server of the rosbridge protocol for one simulation."""

from collections.abc import Callable, Sequence

from urdfkit.bridges.graph import Graph
from urdfkit.bridges.rosbridge.peer import RosbridgePeer
from urdfkit.bridges.websocket.address import Address
from urdfkit.bridges.websocket.server import WebSocketServer

DEFAULT_PORT = 9090


def serve_rosbridge(
    graph: Graph, address: Address, *, origins: Sequence[str] = (), report: Callable[[str], None]
) -> WebSocketServer:
    """Serve a simulation to the clients of rosbridge until the server is closed.

    Args:
        graph: the topics and services of the simulation.
        address: to listen on.
        origins: origins of web pages that may connect, in addition to pages of this machine.
        report: receives a line about each kind of message that was dropped.

    Raises:
        UsageError: the port is in use or the address cannot be bound.
    """
    return WebSocketServer(graph, address, lambda queue: RosbridgePeer(graph, queue, report), origins=origins)
