"""Ros2Bridge: the topics of a simulation on the graph of ROS 2, and the commands of its nodes in the simulation."""

from __future__ import annotations

import re
from collections.abc import Callable

from urdfkit.bridges.bridge import CallQueue, message_topics, publish_received
from urdfkit.bridges.ros2.node import Node, Quality, UnknownTypeError, publisher_quality
from urdfkit.bridges.ros2.published_topics import OutputThread
from urdfkit.bus import Bus, Topic, absolute
from urdfkit.errors import UsageError
from urdfkit.messages import typestore

GLOBAL = ("/clock", "/tf", "/tf_static")
"""Topics without the namespace: nodes in a namespace use them under these names too."""
VALID_NAME = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")


def check_namespace(namespace: str) -> str:
    """Return a namespace with a leading slash, or nothing for the root.

    Raises:
        UsageError: it is no valid namespace in ROS 2.
    """
    name = absolute(namespace)
    if name == "/":
        return ""
    if not VALID_NAME.fullmatch(name):
        raise UsageError(f"--namespace is `{namespace}`; ROS 2 permits letters, digits and underscores between slashes")
    return name


class Ros2Bridge:
    """Publishes the topics of a simulation on ROS 2, and subscribes to its topics for commands.

    Args:
        bus: of the simulation.
        calls: of the simulation.
        node: on the graph.
        namespace: before the names of the topics, from `check_namespace`.
        report: receives lines about topics and messages that cannot be used, each once.
    """

    def __init__(
        self, bus: Bus, calls: CallQueue, node: Node, *, namespace: str = "", report: Callable[[str], None]
    ) -> None:
        self._bus, self._calls, self._node, self._namespace = bus, calls, node, namespace
        self._report_line = report
        self._reported: set[str] = set()
        self._seen: set[str] = set()
        self._closed = False
        self._outputs = OutputThread(calls, self._report)
        self.update()

    def update(self) -> None:
        """Follow topics that were advertised since the last call."""
        if len(self._bus.topics) == len(self._seen):
            return
        new = [topic for topic in self._bus.topics if topic.name not in self._seen]
        self._seen.update(topic.name for topic in new)
        missing: dict[str, list[str]] = {}
        for topic in message_topics(self._bus):
            if topic not in new:
                continue
            name = topic.name if topic.name in GLOBAL else self._namespace + topic.name
            if not VALID_NAME.fullmatch(name):
                self._report(f"`{name}` is no valid topic name in ROS 2; it is not bridged")
                continue
            try:
                self._follow(topic, name)
            except UnknownTypeError as error:
                missing.setdefault(str(error), []).append(name)
        for reason, names in missing.items():
            self._report(f"{', '.join(names)}: not on ROS 2; {reason}")

    def close(self) -> None:
        """Leave the graph."""
        if not self._closed:
            self._closed = True
            self._outputs.close()
            self._node.close()

    def _follow(self, topic: Topic, name: str) -> None:
        if topic.is_input:
            self._node.subscribe(name, topic.type, Quality(reliable=False), self._receiver(topic))
        else:
            quality = publisher_quality(name)
            self._outputs.add(self._bus, topic, self._node.writer(name, topic.type, quality), quality)

    def _receiver(self, topic: Topic) -> Callable[[bytes], None]:
        name, type, bus = topic.name, topic.type, self._bus

        def receive(data: bytes) -> None:
            try:
                message = typestore().deserialize_cdr(data, type)
            except Exception as error:  # of a malformed message, by several classes
                self._report(f"`{name}`: a message that is no {type} was dropped ({error})")
                return
            self._calls.add(lambda: publish_received(bus, name, message, self._report))

        return receive

    def _report(self, line: str) -> None:
        if line not in self._reported:
            self._reported.add(line)
            self._report_line(line)
