"""Requests of the command ``action``: list the actions of a simulation, send goals, follow and cancel them."""

from __future__ import annotations

from typing import Any

from urdfkit.app.simulation.features.feature import Done, Takes
from urdfkit.bridges.actions import EXECUTING, SentGoal, actions, find_action
from urdfkit.bridges.json_messages import json_values
from urdfkit.bus import Bus
from urdfkit.errors import UsageError
from urdfkit.view.protocol.page_requests import Request, Schema, text, tree, whole

KEPT = 100
"""Number of goals whose results are kept."""


class _Goal:
    """A goal of a client: its state, last feedback and result."""

    def __init__(self, bus: Bus, name: str, fields: Any) -> None:
        self.feedback: Any = None
        self.state, self.result, self.reason = EXECUTING, None, ""
        self.sent = SentGoal(bus, find_action(bus, name), fields, feedback=self._follow, ended=self._end)

    def _follow(self, message: Any) -> None:
        self.feedback = message

    def _end(self, state: int, result: Any, reason: str) -> None:
        self.state, self.result, self.reason = state, result, reason


def action_requests(bus: Bus) -> Takes:
    """Return the requests, executed in the thread of the simulation.

    Args:
        bus: of the simulation.
    """
    goals: dict[int, _Goal] = {}
    count = 0

    def send(request: Request) -> Done:
        nonlocal count
        count += 1
        goals[count] = _Goal(bus, request.values["action"], request.values["goal"])
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
        shown = {name: None if each is None else json_values(each) for name, each in values.items()}
        return {"state": goal.state, "reason": goal.reason, **shown}

    def cancel(request: Request) -> Done:
        found(request).sent.cancel()
        return None

    def rows(_request: Request) -> Done:
        return {"actions": sorted([each.name, each.type] for each in actions(bus).values())}

    return {
        "actions": (Schema({}, changes=False), rows),
        "send_goal": (Schema({"action": text(), "goal": tree}), send),
        "goal_state": (Schema({"goal": whole()}, changes=False), state),
        "cancel_goal": (Schema({"goal": whole()}), cancel),
    }
