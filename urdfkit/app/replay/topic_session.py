"""Topics, services and actions of a live graph for commands, as if they were those of a simulation."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Event, Thread
from typing import Any

from urdfkit.app.replay.discovery import Search, Types, wait_for_discovery
from urdfkit.app.replay.live_actions import live_actions
from urdfkit.app.replay.live_topics import LiveTopics
from urdfkit.app.replay.live_view import open_source
from urdfkit.app.simulation.bridging.action_requests import action_requests
from urdfkit.app.simulation.bridging.service_requests import service_requests
from urdfkit.app.simulation.features.feature import Done
from urdfkit.app.simulation.features.topic_panel import ECHO, TopicPanel
from urdfkit.app.simulation.features.topic_stream import KEYS, TopicStreams
from urdfkit.bridges.ros2.rclpy_node import DISCOVERY, RclpyNode
from urdfkit.bus import Bus, absolute
from urdfkit.errors import UrdfkitError
from urdfkit.messages import from_fields, full_type_name
from urdfkit.view.protocol.page_requests import Request
from urdfkit.view.server.server import Server

PERIOD = 0.02


class TopicSession:
    """A server without a page, whose topics are those of a graph.

    Args:
        topics: of the graph.
        bus: on which they are published.
        server: for the commands.
        clock: wall clock [s].

    Attributes:
        bus: the topics.
        t: time since the start [s].
    """

    def __init__(self, topics: LiveTopics, bus: Bus, server: Server, clock: Callable[[], float]) -> None:
        self.bus, self.t = bus, 0.0
        self._topics, self._server, self._clock, self._begun = topics, server, clock, clock()
        simulation: Any = self  # these features use its bus and its time only
        panel = TopicPanel(simulation, server, clock)
        self._features = panel, TopicStreams(simulation, server, clock)
        schema, _ = panel.takes["publish"]
        self._takes = {
            "publish": (schema, self._publish),
            **service_requests(topics.node),
            **action_requests(live_actions(topics, bus)),
        }
        server.requests.update({name: schema for name, (schema, _) in self._takes.items()})

    def tick(self) -> None:
        """Run one iteration: requests, messages."""
        self.t = self._clock() - self._begun
        for request in self._server.inbox.take().requests:
            try:
                values = self._takes[request.name][1](request)
            except UrdfkitError as error:
                self._server.answer(request, str(error))
            else:
                self._server.answer(request, **(values or {}))
        keys = self._server.hub.subscribed_keys
        self._topics.update({key.partition(":")[2] for key in keys if key.startswith((ECHO, *KEYS))})
        for feature in self._features:
            feature.tick()

    def _publish(self, request: Request) -> Done:
        name, type = absolute(request.values["topic"]), full_type_name(request.values["type"])
        message = from_fields(type, request.values["message"])
        self.bus.advertise(name, type)
        self._topics.publish(name, type, message, wait=DISCOVERY)
        return None


@contextmanager
def served_topics(source: str, report: Callable[[str], None], search: Search | None = None) -> Iterator[str]:
    """Serve the topics of a graph inside the context, on this machine; yield the address of the server.

    Args:
        source: of the topics.
        report: receives lines about topics that cannot be received.
        search: what must be discovered before the server is used.

    Raises:
        UrdfkitError: the source is unknown or cannot be reached.
    """
    bus, stop = Bus(), Event()
    node = open_source(source, report)
    topics = LiveTopics(node, bus, report, time.monotonic)
    server = Server("sim", port=0)
    session = TopicSession(topics, bus, server, time.monotonic)

    def run() -> None:
        while not stop.wait(PERIOD):
            session.tick()

    thread = Thread(target=run, name="topics")
    try:
        server.start()
        thread.start()
        if search is not None:
            _wait(topics, bus, search)
        yield server.url
    finally:
        stop.set()
        if thread.is_alive():
            thread.join()
        topics.close()
        server.stop()


def _wait(topics: LiveTopics, bus: Bus, search: Search) -> None:
    """Wait until a graph is discovered; a master and a server of rosbridge answer the first search with all of it."""
    node = topics.node
    if node.ros != "ROS 2":
        topics.searched.wait(DISCOVERY)
        return

    def find() -> Types:
        found: Types = {"topics": {topic.name: topic.type for topic in bus.topics}}
        if not isinstance(node, RclpyNode):
            return found
        return {**found, "services": dict.fromkeys(node.services(), ""), "actions": node.actions()}

    wait_for_discovery(find, search)
