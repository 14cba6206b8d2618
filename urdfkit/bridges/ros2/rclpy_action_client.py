"""Actions of the graph of ROS 2, and goals that are sent to them by rclpy."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from urdfkit.bridges.actions import ABORTED, REJECTED, ActionServer
from urdfkit.bridges.json_messages import from_json
from urdfkit.bridges.node.node import UnknownTypeError
from urdfkit.bridges.ros2.rclpy_messages import rclpy_message, rclpy_type
from urdfkit.bridges.ros2.rclpy_node import DISCOVERY, RclpyNode
from urdfkit.bus import absolute, similar_topic
from urdfkit.errors import ResourceError, UsageError
from urdfkit.messages import typestore
from urdfkit.messages.conversion import converted

CHECKED = 1.0
"""Seconds between two checks whether the server of a goal is still on the graph."""
UNANSWERED = 30
"""Checks after which a goal ends that its server has neither accepted nor rejected: the request can get lost."""


class RclpyActions:
    """The actions of a graph.

    Args:
        node: on the graph.
        post: runs a function in the thread that uses the actions.
    """

    def __init__(self, node: RclpyNode, post: Callable[[Callable[[], None]], object]) -> None:
        self._node, self._post = node, post
        self._clients: dict[str, Any] = {}

    def types(self) -> dict[str, str]:
        """Return action → type, of the servers and clients that are discovered."""
        return self._node.actions()

    def send(
        self, name: str, fields: Any, feedback: Callable[[Any], None], ended: Callable[[int, Any, str], None]
    ) -> RclpyGoal:
        """Send a goal, see `SentGoal`, when its server is discovered.

        Raises:
            UrdfkitError: the action is unknown, or has no server; its type is not installed, or unknown to urdfkit.
        """
        full, end = absolute(name), time.monotonic() + DISCOVERY
        while full not in (types := self.types()):
            if time.monotonic() > end:
                raise UsageError(f"unknown action `{full}`{similar_topic(full, list(types))}")
            time.sleep(0.05)
        action = ActionServer(full, types[full], is_rcl=True)
        if (kind := rclpy_type(action.type)) is None:
            raise UnknownTypeError(f"rclpy lacks {action.type}: install its ROS package")
        message = rclpy_message(kind.Goal, from_json(action.goal, fields))
        if full not in self._clients:
            self._clients[full] = self._node.action_client(kind, full)
        client = self._clients[full]
        if not client.wait_for_server(timeout_sec=DISCOVERY):
            raise ResourceError(f"{full} has no server")
        goal = RclpyGoal(action, self._post, feedback, ended, client.server_is_ready)
        goal.unwatch = self._node.repeat(CHECKED, goal.check_server)
        sending = client.send_goal_async(message, feedback_callback=goal.take_feedback)
        sending.add_done_callback(goal.take_response)
        return goal


class RclpyGoal:
    """A goal that was sent to an action; its callbacks run in the thread of the executor.

    Attributes:
        unwatch: ends the calls of `check_server`.
    """

    def __init__(
        self,
        action: ActionServer,
        post: Callable[[Callable[[], None]], object],
        feedback: Callable[[Any], None],
        ended: Callable[[int, Any, str], None],
        is_served: Callable[[], bool],
    ) -> None:
        self.unwatch: Callable[[], object] = lambda: None
        self._name, self._is_served, self._is_open = action.name, is_served, True
        self._post, self._feedback, self._ended = post, feedback, ended
        self._part = action.goal.removesuffix("Goal")
        self._handle: Any = None
        self._cancelled, self._checks = False, 0

    def cancel(self) -> None:
        """Request that the goal is cancelled; its end is reported as that of other goals."""
        self._cancelled = True
        if self._handle is not None:
            self._handle.cancel_goal_async()

    def close(self) -> None:
        """Forget the goal, which is still executed."""
        self.unwatch()
        self._feedback, self._ended = (lambda message: None), (lambda state, result, reason: None)

    def take_feedback(self, message: Any) -> None:
        """Hand feedback over."""
        found = converted(message.feedback, f"{self._part}Feedback", typestore())
        self._post(lambda: self._feedback(found))

    def take_response(self, future: Any) -> None:
        """Wait for the result of an accepted goal."""
        handle = future.result()
        if not handle.accepted:
            self._end(REJECTED, None)
            return
        self._handle = handle
        handle.get_result_async().add_done_callback(self._take_result)
        if self._cancelled:
            handle.cancel_goal_async()

    def _take_result(self, future: Any) -> None:
        response = future.result()
        result = converted(response.result, f"{self._part}Result", typestore())
        self._end(response.status, result)

    def check_server(self) -> None:
        """End the goal if its server has left the graph, or has not responded.

        A server leaves by itself, or as DDS notices some seconds after it died.
        """
        self._checks += 1
        if not self._is_served():
            self._end(ABORTED, None, f"the server of {self._name} has left the graph")
        elif self._handle is None and self._checks >= UNANSWERED:
            self._cancelled = True  # if it is accepted later
            self._end(ABORTED, None, f"{self._name} has not responded within {UNANSWERED * CHECKED:g} s")

    def _end(self, state: int, result: Any, reason: str = "") -> None:
        if self._is_open:
            self._is_open = False
            self.unwatch()
            self._post(lambda: self._ended(state, result, reason))
