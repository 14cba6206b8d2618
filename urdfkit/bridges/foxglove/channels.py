"""Numbers of topics and services, the same for all clients of a server."""

import secrets

from urdfkit.bridges.graph import Graph
from urdfkit.errors import UsageError


class Channels:
    """Channels of the topics, in the order of their first mention; used in the thread of the server.

    Args:
        graph: the topics and services of the simulation.

    Attributes:
        rows: id, topic and type of each channel.
        services: id → service.
        session: name of this run of the server, which changes when it restarts.
    """

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self.rows: list[tuple[int, str, str]] = []
        self.services = dict(enumerate(graph.services.values(), 1))
        self.session = secrets.token_hex(8)
        self.follow()

    def follow(self) -> None:
        """Add channels for new topics."""
        for topic, type in list(self._graph.topics.items())[len(self.rows) :]:
            self.rows.append((len(self.rows) + 1, topic, type))

    def topic(self, number: object) -> tuple[str, str]:
        """Return topic and type of a channel.

        Raises:
            UsageError: unknown channel.
        """
        if not isinstance(number, int) or not 1 <= number <= len(self.rows):
            raise UsageError(f"no channel {number}")
        return self.rows[number - 1][1:]
