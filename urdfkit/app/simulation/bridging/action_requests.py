"""Requests of the command ``action``: list the actions of a simulation or of another graph, send goals, follow them."""

from collections.abc import Callable
from typing import Any, Protocol

from urdfkit.app.simulation.features.feature import Done, Takes
from urdfkit.bridges.actions import EXECUTING, SentGoal, actions, find_action
from urdfkit.bridges.json_messages import json_values
from urdfkit.bus import Bus
from urdfkit.errors import UsageError
from urdfkit.view.protocol.page_requests import Request, Schema, text, tree, whole

KEPT = 100
"""Number of goals whose results are kept."""


class Sent(Protocol):
    """A goal that was sent."""

    def cancel(self) -> None:
        """Request that the goal is cancelled."""

    def close(self) -> None:
        """Forget the goal, which is still executed."""


class Actions(Protocol):
    """Action servers by name; each method raises `UrdfkitError`."""

    def types(self) -> dict[str, str]:
        """Return action → type."""

    def send(
        self, name: str, fields: Any, feedback: Callable[[Any], None], ended: Callable[[int, Any, str], None]
    ) -> Sent:
        """Send a goal, see `SentGoal`."""


class SimulationActions:
    """Actions of a simulation, used in its thread."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus

    def types(self) -> dict[str, str]:
        """Return action → type."""
        return {each.name: each.type for each in actions(self._bus).values()}

    def send(
        self, name: str, fields: Any, feedback: Callable[[Any], None], ended: Callable[[int, Any, str], None]
    ) -> SentGoal:
        """Send a goal, see `SentGoal`."""
        return SentGoal(self._bus, find_action(self._bus, name), fields, feedback=feedback, ended=ended)


class _Goal:
    """A goal of a client: its state, last feedback and result."""

    def __init__(self, source: Actions, name: str, fields: Any) -> None:
        self.feedback: Any = None
        self.state, self.result, self.reason = EXECUTING, None, ""
        self.sent = source.send(name, fields, self._follow, self._end)

    def _follow(self, message: Any) -> None:
        self.feedback = message

    def _end(self, state: int, result: Any, reason: str) -> None:
        self.state, self.result, self.reason = state, result, reason


def action_requests(source: Actions) -> Takes:
    """Return the requests, executed in the thread that `source` is used in.

    Args:
        source: the actions.
    """
    goals: dict[int, _Goal] = {}
    count = 0

    def send(request: Request) -> Done:
        nonlocal count
        count += 1
        goals[count] = _Goal(source, request.values["action"], request.values["goal"])
        if len(goals) > KEPT:
            goals.pop(min(goals)).sent.close()
        return {"goal": count}

    def found(request: Request) -> _Goal:
        if (number := request.values["goal"]) not in goals:
            raise UsageError(f"unknown goal {number}")
        return goals[number]

    def state(request: Request) -> Done:
        goal = found(request)
        feedback, goal.feedback = goal.feedback, None
        values = {"feedback": feedback, "result": goal.result}
        shown = {
            name: each if each is None or isinstance(each, dict) else json_values(each) for name, each in values.items()
        }
        return {"state": goal.state, "reason": goal.reason, **shown}

    def cancel(request: Request) -> Done:
        found(request).sent.cancel()
        return None

    def rows(_request: Request) -> Done:
        return {"actions": sorted(map(list, source.types().items()))}

    return {
        "actions": (Schema({}, changes=False), rows),
        "send_goal": (Schema({"action": text(), "goal": tree}), send),
        "goal_state": (Schema({"goal": whole()}, changes=False), state),
        "cancel_goal": (Schema({"goal": whole()}), cancel),
    }
