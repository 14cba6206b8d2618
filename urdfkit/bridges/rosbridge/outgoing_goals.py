"""Actions of a server of rosbridge, and goals that this client sends to them.

https://github.com/RobotWebTools/rosbridge_suite/blob/ros2/ROSBRIDGE_PROTOCOL.md#35-actions
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any
from uuid import uuid4

from urdfkit.bridges.actions import ABORTED, NAMES, REJECTED
from urdfkit.bridges.rosbridge.rosbridge_node import RosbridgeNode
from urdfkit.bus import absolute, similar_topic
from urdfkit.errors import UsageError


class ServerActions:
    """The actions of a server.

    Args:
        node: connection with the server.
        post: runs a function in the thread that uses the actions.
    """

    def __init__(self, node: RosbridgeNode, post: Callable[[Callable[[], None]], object]) -> None:
        self._node, self._post = node, post
        self._goals: dict[str, RosbridgeGoal] = {}
        node.operations["action_feedback"] = lambda message: post(lambda: self._take_feedback(message))
        node.operations["action_result"] = lambda message: post(lambda: self._take_result(message))
        node.gone = lambda: post(self._end)

    def types(self) -> dict[str, str]:
        """Return action → type, by services of rosapi."""
        names = self._node.call("/rosapi/action_servers", "", {})["action_servers"]
        return {name: self._node.call("/rosapi/action_type", "", {"action": name})["type"] for name in sorted(names)}

    def send(
        self, name: str, fields: Any, feedback: Callable[[Any], None], ended: Callable[[int, Any, str], None]
    ) -> RosbridgeGoal:
        """Send a goal.

        Args:
            name: of the action.
            fields: of the goal.
            feedback: receives the fields of each feedback.
            ended: receives the state, the fields of the result or None, and the reason for the state, once.

        Raises:
            UrdfkitError: the action is unknown, or the server does not respond.
        """
        full, types = absolute(name), self.types()
        if full not in types:
            raise UsageError(f"unknown action `{full}`{similar_topic(full, list(types))}")
        id = uuid4().hex
        self._goals[id] = goal = RosbridgeGoal(self._node, full, id, feedback, ended)
        goal.request("send_action_goal", action_type=types[full], args=fields or {}, feedback=True)
        return goal

    def _take_feedback(self, message: dict[str, Any]) -> None:
        if (goal := self._goals.get(message.get("id", ""))) is not None:
            goal.feedback(message.get("values"))

    def _take_result(self, message: dict[str, Any]) -> None:
        if (goal := self._goals.pop(message.get("id", ""), None)) is not None:
            state, values = message.get("status"), message.get("values")
            reason, result = (values, None) if isinstance(values, str) else ("", values)
            goal.ended(state if state in NAMES else REJECTED, result, reason)

    def _end(self) -> None:
        while self._goals:
            self._goals.popitem()[1].ended(ABORTED, None, "the server has disconnected")


class RosbridgeGoal:
    """A goal that was sent to an action of a server."""

    def __init__(
        self,
        node: RosbridgeNode,
        action: str,
        id: str,
        feedback: Callable[[Any], None],
        ended: Callable[[int, Any, str], None],
    ) -> None:
        self._node, self._action, self._id = node, action, id
        self.feedback, self.ended = feedback, ended

    def request(self, op: str, **fields: Any) -> None:
        """Send an operation about this goal."""
        self._node.send(json.dumps({"op": op, "id": self._id, "action": self._action, **fields}))

    def cancel(self) -> None:
        """Request that the goal is cancelled; its end is reported as that of other goals."""
        self.request("cancel_action_goal")

    def close(self) -> None:
        """Forget the goal, which is still executed."""
        self.feedback, self.ended = (lambda values: None), (lambda state, result, reason: None)
