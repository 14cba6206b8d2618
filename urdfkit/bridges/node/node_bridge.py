"""NodeBridge: the topics of a simulation on the graph of ROS, and the commands of its nodes in the simulation."""

import re
import time
from collections.abc import Callable, Mapping
from functools import partial
from queue import Queue
from types import MappingProxyType
from typing import Any

from urdfkit.bridges.actions import REJECTED, ActionServer, SentGoal, actions
from urdfkit.bridges.bridge import CallQueue, message_topics, publish_received
from urdfkit.bridges.message_builder import MessageBuilder
from urdfkit.bridges.node.node import ActionNode, Done, Node, Quality, TypedGraph, UnknownTypeError, publisher_quality
from urdfkit.bridges.node.published_topics import OutputThread
from urdfkit.bridges.service import Service, respond
from urdfkit.bus import Bus, Topic, absolute
from urdfkit.errors import UrdfkitError, UsageError
from urdfkit.messages.control import GOAL_ID

GLOBAL = ("/clock", "/tf", "/tf_static")
"""Topics without the namespace: nodes in a namespace use them under these names too."""
GOAL_DELAY = 0.02
"""Seconds until a goal or cancel request of actionlib is handed on.

The client of actionlib ignores an answer that arrives before its function `send_goal` has returned, and then waits for
ever; a refusal would be quicker than that.
"""
VALID_NAME = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")


def check_namespace(namespace: str) -> str:
    """Return a namespace with a leading slash, or nothing for the root.

    Raises:
        UsageError: it is no valid namespace in ROS.
    """
    name = absolute(namespace)
    if name == "/":
        return ""
    if not VALID_NAME.fullmatch(name):
        raise UsageError(f"--namespace is `{namespace}`; ROS permits letters, digits and underscores between slashes")
    return name


class NodeBridge:
    """Publishes the topics of a simulation on a graph, and subscribes to its topics for commands.

    Args:
        bus: of the simulation.
        calls: of the simulation.
        node: on the graph.
        services: that nodes can call, if the node can serve them.
        namespace: before the names of the topics, from `check_namespace`.
        builder: builds messages that take long; None to build them in the thread of the simulation.
        report: receives lines about topics and messages that cannot be used, each once.

    Attributes:
        served: number of the services that nodes can call.
        actions: names of the actions to which nodes can send goals, on the bus.
    """

    def __init__(
        self,
        bus: Bus,
        calls: CallQueue,
        node: Node,
        *,
        services: Mapping[str, Service] = MappingProxyType({}),
        namespace: str = "",
        builder: MessageBuilder | None = None,
        report: Callable[[str], None],
    ) -> None:
        self._bus, self._calls, self._node, self._namespace = bus, calls, node, namespace
        self._report_line = report
        self.actions: set[str] = set()
        self._tried: set[str] = set()
        self._replaced: set[str] = set()
        self._reported: set[str] = set()
        self._seen: set[str] = set()
        self._types: dict[str, str] = {}
        self._closed = False
        self._outputs = OutputThread(calls, node, builder, self._report, self._compare_types)
        self.served = sum(self._serve(service) for service in services.values())
        self.update()

    def update(self) -> None:
        """Follow topics that were advertised since the last call."""
        if len(self._bus.topics) == len(self._seen):
            return
        new = [topic for topic in self._bus.topics if topic.name not in self._seen]
        self._seen.update(topic.name for topic in new)
        missing: dict[str, list[str]] = {}
        self._serve_actions(missing)
        for topic in message_topics(self._bus):
            if topic not in new or topic.name in self._replaced:
                continue
            name = topic.name if topic.name in GLOBAL else self._namespace + topic.name
            if not VALID_NAME.fullmatch(name):
                self._report(f"`{name}` is not a valid topic name in {self._node.ros}; it is not bridged")
                continue
            try:
                self._follow(topic, name)
                self._types = {**self._types, name: topic.type}
            except UnknownTypeError as error:
                missing.setdefault(str(error), []).append(name)
        for reason, names in missing.items():
            self._report(f"{', '.join(names)}: not on {self._node.ros}; {reason}")

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

    def _serve(self, service: Service) -> bool:
        def call(request: Any, done: Done) -> None:
            if not self._calls.add(lambda: respond(service, request, done)):
                done(None, "too many calls wait for the simulation")

        try:
            self._node.serve(service, call)
        except UnknownTypeError:
            return False
        return True

    def _serve_actions(self, missing: dict[str, list[str]]) -> None:
        """Serve the ROS 2 actions, if the library has servers and their types; those of ROS 1 are topics."""
        if self._node.ros != "ROS 2":
            return
        for name, action in actions(self._bus).items():
            if name in self._tried:
                continue
            self._tried.add(name)
            try:
                if not isinstance(self._node, ActionNode):
                    raise UnknownTypeError(
                        f"{self._node.description} does not support actions: send goals over --rosbridge"
                    )
                self._node.serve_action(self._namespace + name, action, partial(self._begin, action))
            except UnknownTypeError as error:
                missing.setdefault(str(error), []).append(self._namespace + name)
            else:
                self.actions.add(name)
                self._replaced.update(action.topics)

    def _begin(
        self,
        action: ActionServer,
        message: Any,
        feedback: Callable[[Any], None],
        ended: Callable[[int, Any, str], None],
    ) -> Callable[[], None]:
        answers: Queue[SentGoal | None] = Queue()

        def send() -> None:
            try:
                answers.put(SentGoal(self._bus, action, message, feedback=feedback, ended=ended))
            except UrdfkitError as error:
                self._report(f"{action.name}: {error}")
                ended(REJECTED, None, str(error))
                answers.put(None)

        if not self._calls.add(send):
            ended(REJECTED, None, "too many calls wait for the simulation")
            return lambda: None
        goal = answers.get()

        def cancel() -> None:
            if goal is not None:
                self._calls.add(goal.cancel)

        return cancel

    def _receiver(self, topic: Topic) -> Callable[[bytes], None]:
        name, type, bus, node = topic.name, topic.type, self._bus, self._node
        delayed = node.ros == "ROS 1" and (type == GOAL_ID or type.endswith("ActionGoal"))

        def receive(data: bytes) -> None:
            if delayed:
                time.sleep(GOAL_DELAY)
            try:
                message = node.decode(data, type)
            except Exception as error:  # of a malformed message, by several classes
                self._report(f"`{name}`: dropped a message that is not a {type} ({error})")
                return
            self._calls.add(lambda: publish_received(bus, name, message, self._report), len(data))

        return receive

    def _compare_types(self) -> None:
        """Report topics that other nodes use with another type, in the thread of the outputs."""
        if isinstance(self._node, TypedGraph):
            used = self._node.types()
            for name, type in self._types.items():
                for other in sorted(used.get(name, {type}) - {type}):
                    self._report(f"`{name}` has type {type}, but a node uses {other}; they exchange no messages")

    def _report(self, line: str) -> None:
        if line not in self._reported:
            self._reported.add(line)
            self._report_line(line)
