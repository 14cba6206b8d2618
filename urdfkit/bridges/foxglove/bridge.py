"""FoxgloveServer: server of the Foxglove protocol for one simulation."""

from collections.abc import Callable, Sequence
from pathlib import Path

from urdfkit.bridges.foxglove.assets import read_asset
from urdfkit.bridges.foxglove.channels import Channels
from urdfkit.bridges.foxglove.peer import FoxglovePeer
from urdfkit.bridges.graph import Graph
from urdfkit.bridges.websocket.address import Address
from urdfkit.bridges.websocket.send_queue import SendQueue
from urdfkit.bridges.websocket.server import WebSocketServer

SUBPROTOCOLS = ("foxglove.websocket.v1", "foxglove.sdk.v1")
ORIGINS = ("https://app.foxglove.dev",)
"""Pages of Foxglove, which connect to servers of this machine."""


class FoxgloveServer(WebSocketServer):
    """Serves a simulation to Foxglove until it is closed.

    Args:
        graph: the topics and services of the simulation.
        address: to listen on.
        find_package: returns the folder of a package, for the meshes of the robot.
        origins: origins of web pages that may connect, in addition to Foxglove's and pages of this machine.
        report: receives a line about each message that was dropped.

    Raises:
        UsageError: the port is in use or the address cannot be bound.
    """

    def __init__(
        self,
        graph: Graph,
        address: Address,
        find_package: Callable[[str], Path],
        *,
        origins: Sequence[str] = (),
        report: Callable[[str], None],
    ) -> None:
        self._channels = Channels(graph)
        self._connected: list[FoxglovePeer] = []
        self._topics = len(graph.bus.topics)

        def connect(queue: SendQueue) -> FoxglovePeer:
            self._channels.follow()
            peer = FoxglovePeer(
                graph, self._channels, queue, lambda uri: read_asset(uri, find_package), report, self._connected.remove
            )
            self._connected.append(peer)
            return peer

        super().__init__(graph, address, connect, subprotocols=SUBPROTOCOLS, origins=(*ORIGINS, *origins))

    def update(self) -> None:
        """Announce topics that were advertised since the last call."""
        if len(self.graph.bus.topics) != self._topics:
            self._topics = len(self.graph.bus.topics)
            self.graph.post(self._announce)

    def _announce(self) -> None:
        self._channels.follow()
        for peer in self._connected:
            peer.announce()
