"""Goals that a client of rosbridge sends to the actions of a simulation.

https://github.com/RobotWebTools/rosbridge_suite/blob/ros2/ROSBRIDGE_PROTOCOL.md#35-actions
"""

import json
from collections.abc import Callable
from typing import Any

from urdfkit.bridges.actions import REJECTED, SentGoal, find_action
from urdfkit.bridges.graph import Graph
from urdfkit.bridges.json_messages import to_json
from urdfkit.errors import UrdfkitError, UsageError


class ClientGoals:
    """The goals of one client; used in the thread of the server.

    Args:
        graph: the topics of the simulation.
        reply: sends a frame to the client.
    """

    def __init__(self, graph: Graph, reply: Callable[[str], None]) -> None:
        self._graph, self._reply = graph, reply
        self._goals: dict[str, SentGoal] = {}  # changed in the thread of the simulation

    def send(self, message: dict[str, Any]) -> None:
        """Send a goal; its feedback and its result are sent to the client."""
        name, number, wants_feedback = message.get("action"), str(message.get("id")), bool(message.get("feedback"))
        if not isinstance(name, str):
            raise UsageError("`send_action_goal` needs `action`, a string")

        def reply(op: str, values: str, **more: Any) -> None:
            head = json.dumps({"op": op, "id": message.get("id"), "action": name, **more})
            self._graph.post(lambda: self._reply(f'{head[:-1]}, "values": {values}}}'))

        def feedback(content: Any) -> None:
            if wants_feedback:
                reply("action_feedback", to_json(content))

        def ended(state: int, result: Any, reason: str) -> None:
            self._goals.pop(number, None)
            values = json.dumps(reason) if result is None else to_json(result)
            reply("action_result", values, status=state, result=state != REJECTED)

        def begin() -> None:
            try:
                goal = SentGoal(
                    self._graph.bus,
                    find_action(self._graph.bus, name),
                    message.get("args") or None,
                    feedback=feedback,
                    ended=ended,
                )
            except UrdfkitError as error:
                ended(REJECTED, None, str(error))
            else:
                if goal.is_open:
                    self._goals[number] = goal

        self._graph.call(begin)

    def cancel(self, message: dict[str, Any]) -> None:
        """Cancel a goal."""
        number = str(message.get("id"))

        def cancel() -> None:
            if number in self._goals:
                self._goals[number].cancel()

        self._graph.call(cancel)

    def close(self) -> None:
        """Forget the goals, which are still executed."""

        def close() -> None:
            while self._goals:
                self._goals.popitem()[1].close()

        self._graph.call(close)
