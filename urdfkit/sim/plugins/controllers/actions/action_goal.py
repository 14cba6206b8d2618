"""Action: action server of a controller, which executes one goal at a time; see `action_topics` for the topics."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from urdfkit.sim.plugins.controllers.actions.action_topics import (
    ABORTED,
    PREEMPTED,
    REJECTED,
    SUCCEEDED,
    Actionlib,
    Goal,
    RclAction,
)
from urdfkit.sim.plugins.controllers.controller import Report, RosController
from urdfkit.sim.state.robot_state import State

__all__ = ["ABORTED", "SUCCEEDED", "Action", "RefusalError"]

STATUS_RATE = 5.0
"""Rate of actionlib's status topic [Hz] (``status_frequency``)."""


class RefusalError(Exception):
    """A goal is rejected.

    Args:
        text: reason.
        result: fields of the result.
    """

    def __init__(self, text: str, **result: Any) -> None:
        super().__init__(text)
        self.result = result


class Action:
    """Action server of a controller; a new goal preempts the active one.

    Args:
        controller: the controller.
        name: name of the action, relative to the controller's.
        kind: type of its messages without ``ActionGoal``, such as ``control_msgs/msg/GripperCommand``.
        pursue: called with each goal; raises `RefusalError` to reject it.
        stop: called when the goal is cancelled.
        feedback: returns a function that builds the fields of the feedback for a state.
        rate: rate of the feedback [Hz].
        clock: returns the simulated time [s].

    Attributes:
        goal: active goal; None without one.
    """

    def __init__(
        self,
        controller: RosController,
        name: str,
        kind: str,
        *,
        pursue: Callable[[Any], None],
        stop: Callable[[], None],
        feedback: Callable[[State], Callable[[], dict[str, Any]]],
        rate: float,
        clock: Callable[[], float],
    ) -> None:
        self._clock, self._controller = clock, controller
        self._pursue, self._stop, self._feedback = pursue, stop, feedback
        self.goal: Goal | None = None
        self._last: Goal | None = None
        topics = Actionlib if controller.hardware.ros == 1 else RclAction
        self._topics = topics(controller, name, kind, take=self._take, cancel=self._cancel, clock=clock)
        feedback_topic, dt = self._topics.feedback, controller.hardware.setup.dt
        controller.publications.append(
            Report(
                feedback_topic, rate, dt, lambda: controller.running and self.goal is not None, self._feedback_message
            )
        )
        if self._topics.repeats:
            controller.report(self._topics.states, STATUS_RATE, self._list)

    def end(self, state: int, text: str = "", /, **result: Any) -> None:
        """End the active goal with a state and publish its result; without an active goal, do nothing."""
        if self.goal is not None:
            goal, self.goal = self.goal, None
            self._close(goal, state, text, result)

    def give_up(self, text: str) -> None:
        """Preempt the active goal."""
        self.end(PREEMPTED, text)

    def _take(self, goal: Goal, wanted: Any) -> None:
        try:
            self._pursue(wanted)
        except RefusalError as refusal:
            self._controller.note(f"rejected a goal: {refusal}")
            self._close(goal, REJECTED, str(refusal), refusal.result, last=self.goal is None)
            return
        self.give_up("another goal has replaced it")
        self.goal = self._last = goal
        self._topics.states.publish(self._topics.status(self._clock(), goal))

    def _cancel(self, name: str, until: float) -> None:
        # A request without an id cancels all goals, or those sent up to a time (action_server_base.h, CancelGoal.srv).
        goal = self.goal
        if goal is not None and (name == goal.name or (not name and not until) or (until and goal.sent <= until)):
            self._stop()
            self.give_up("cancelled")

    def _close(self, goal: Goal, state: int, text: str, result: dict[str, Any], *, last: bool = True) -> None:
        goal.state, goal.text = state, text
        if last:
            self._last = goal
        topics = self._topics
        if (message := topics.result(goal, result)) is not None:
            topics.results.publish(message)
            topics.states.publish(topics.status(self._clock(), goal))

    def _list(self, state: State) -> Callable[[], Any]:
        message = self._topics.status(state.t, self._last)
        return lambda: message

    def _feedback_message(self, state: State) -> Callable[[], Any]:
        assert self.goal is not None  # feedback is published only while a goal is active
        t, fields, goal = state.t, self._feedback(state), replace(self.goal)
        return lambda: self._topics.progress(t, goal, fields())
