"""Actions of a live graph for the command ``action``: of actionlib on ROS 1, of rclpy, and of a server of rosbridge."""

import time
from collections.abc import Callable
from typing import Any

from urdfkit.app.replay.live_topics import LiveTopics
from urdfkit.app.simulation.bridging.action_requests import Actions, SimulationActions
from urdfkit.bridges.actions import SentGoal, find_action
from urdfkit.bridges.node.node import UnknownTypeError
from urdfkit.bridges.ros2.rclpy_node import RclpyNode
from urdfkit.bus import Bus, Subscription
from urdfkit.errors import ResourceError

CONNECTED = 5.0
"""Longest time until an action server is connected [s]; it publishes its status five times a second."""


def live_actions(topics: LiveTopics, bus: Bus) -> Actions:
    """Return the actions of a graph, for the thread that updates the topics."""
    if topics.node.ros == "rosbridge":
        from urdfkit.bridges.rosbridge.outgoing_goals import ServerActions
        from urdfkit.bridges.rosbridge.rosbridge_node import RosbridgeNode

        assert isinstance(topics.node, RosbridgeNode)
        return ServerActions(topics.node, topics.calls.add)
    if isinstance(topics.node, RclpyNode):
        from urdfkit.bridges.ros2.rclpy_action_client import RclpyActions

        return RclpyActions(topics.node, topics.calls.add)
    return ActionlibActions(topics, bus)


class ActionlibActions:
    """ROS 1 action servers: topics of actionlib.

    Args:
        topics: of the graph.
        bus: with the topics.
    """

    def __init__(self, topics: LiveTopics, bus: Bus) -> None:
        self._topics, self._bus = topics, bus

    def types(self) -> dict[str, str]:
        """Return action → type.

        Raises:
            UnknownTypeError: the graph is that of ROS 2.
        """
        if self._topics.node.ros != "ROS 1":
            raise UnknownTypeError(
                "Cyclone DDS does not support actions: source a ROS 2 workspace with rclpy, or use --live rosbridge://HOST:PORT"
            )
        return SimulationActions(self._bus).types()

    def send(
        self, name: str, fields: Any, feedback: Callable[[Any], None], ended: Callable[[int, Any, str], None]
    ) -> SentGoal:
        """Send a goal when its server is connected, see `SentGoal`.

        Raises:
            UrdfkitError: the action is unknown, or its server does not respond.
        """
        self.types()
        action = find_action(self._bus, name)
        status = self._bus.subscribe(f"{action.name}/status", "actionlib_msgs/msg/GoalStatusArray", lambda _: None)
        try:
            before, end = self._count(action.name), time.monotonic() + CONNECTED
            while self._count(action.name) == before:
                if time.monotonic() > end:
                    raise ResourceError(f"the server of {action.name} does not publish its status")
                self._topics.update()
                time.sleep(0.01)
            graph: Any = _GraphBus(self._topics, self._bus)
            return SentGoal(graph, action, fields, feedback=feedback, ended=ended, is_live=True)
        finally:
            status.close()

    def _count(self, action: str) -> int:
        return next(topic.count for topic in self._bus.topics if topic.name == f"{action}/status")


class _GraphBus:
    """A bus whose messages are received from and published on a graph."""

    def __init__(self, topics: LiveTopics, bus: Bus) -> None:
        self._topics, self._bus = topics, bus

    def subscribe(self, name: str, type: str, callback: Callable[[Any], None]) -> Subscription:
        """Receive the messages of a topic."""
        return self._bus.subscribe(name, type, callback)

    def publish(self, name: str, type: str, message: Any) -> None:
        """Publish a message, when the subscriptions are connected."""
        self._topics.update()
        self._topics.publish(name, type, message, wait=CONNECTED)
