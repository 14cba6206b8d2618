"""Action: a goal that a controller pursues, on the topics that actionlib makes of an action.

Source: actionlib (ROS 1): ``goal`` and ``cancel`` are listened to, ``feedback``, ``result`` and ``status`` published.
In ROS 2 the same exchange goes by services that only a connection to ROS has; the topics here are the same for both.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from urdfkit.control_messages import GOAL_ID, GOAL_STATUSES
from urdfkit.messages import from_fields, header, message_type, stamp
from urdfkit.sim.controllers.law import Report

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.sim.controllers.law import Law
    from urdfkit.sim.state import State

ACTIVE, PREEMPTED, SUCCEEDED, ABORTED, REJECTED = 1, 2, 3, 4, 5
"""States of a goal (actionlib_msgs/GoalStatus)."""

STATUS_RATE = 5.0
"""How often the states are published [Hz] (actionlib's ``status_frequency``)."""


@dataclass
class Goal:
    """A goal that was sent.

    Attributes:
        id: as the sender named it, or as we did.
        state: `ACTIVE`, …
        text: why.
    """

    id: Any
    state: int = ACTIVE
    text: str = ""


class RefusalError(Exception):
    """A goal cannot be pursued.

    Args:
        text: why.
        result: fields of the result.
    """

    def __init__(self, text: str, **result: Any) -> None:
        super().__init__(text)
        self.result = result


class Action:
    """One goal at a time; a new one takes the place of the one before.

    Args:
        law: the controller.
        name: of the action, below the controller's.
        kind: the type of its messages without ``ActionGoal``, such as ``control_msgs/msg/GripperCommand``.
        pursue: is given each goal; raises `RefusalError` for one that cannot be pursued.
        stop: is called when the goal is cancelled.
        feedback: returns what builds the fields of the feedback.
        rate: of the feedback [Hz].
        clock: returns the time [s].

    Attributes:
        goal: the one that is pursued.
    """

    def __init__(
        self,
        law: Law,
        name: str,
        kind: str,
        *,
        pursue: Callable[[Any], None],
        stop: Callable[[], None],
        feedback: Callable[[State], Callable[[], dict[str, Any]]],
        rate: float,
        clock: Callable[[], float],
    ) -> None:
        self._clock = clock
        self._law, self._kind = law, kind
        self._pursue, self._stop, self._feedback = pursue, stop, feedback
        self.goal: Goal | None = None
        self._last: Goal | None = None
        self._count = 0
        bus, base = law.hardware.setup.bus, law.topic(name)
        law.listen(f"{base}/goal", f"{kind}ActionGoal", self._take)
        law.listen(f"{base}/cancel", GOAL_ID, self._cancel)
        self._results = bus.advertise(f"{base}/result", f"{kind}ActionResult")
        self._states = bus.advertise(f"{base}/status", GOAL_STATUSES)
        feedbacks = bus.advertise(f"{base}/feedback", f"{kind}ActionFeedback")
        dt = law.hardware.setup.dt
        law.publications.append(Report(feedbacks, rate, dt, lambda: law.running and self.goal is not None, self._tell))
        law.report(self._states, STATUS_RATE, self._list)

    def end(self, state: int, text: str = "", **result: Any) -> None:
        """Tell that the goal was reached or will not be; does nothing without one."""
        if self.goal is not None:
            goal, self.goal = self.goal, None
            self._close(goal, state, text, result)

    def give_up(self, text: str) -> None:
        """Tell that something else has taken the goal's place."""
        self.end(PREEMPTED, text)

    def _take(self, message: Any) -> None:
        self._count += 1
        name = message.goal_id.id or f"{self._law.name}-{self._count}"
        sent = message.goal_id.stamp
        goal = Goal(message_type(GOAL_ID)(sent if sent.sec or sent.nanosec else stamp(self._clock()), name))
        try:
            self._pursue(message.goal)
        except RefusalError as refusal:
            self._law.note(f"refused a goal: {refusal}")
            self._close(goal, REJECTED, str(refusal), refusal.result, last=self.goal is None)
            return
        self.give_up("another goal has taken its place")
        self.goal = self._last = goal
        self._states.publish(self._status(self._clock(), goal))

    def _cancel(self, message: Any) -> None:
        goal = self.goal
        # Without a name all goals are meant, or those sent up to a time (actionlib, action_server_base.h).
        until = message.stamp.sec + 1e-9 * message.stamp.nanosec
        if goal is None:
            return
        sent = goal.id.stamp.sec + 1e-9 * goal.id.stamp.nanosec
        if message.id == goal.id.id or (not message.id and not until) or (until and sent <= until):
            self._stop()
            self.give_up("cancelled")

    def _close(self, goal: Goal, state: int, text: str, result: dict[str, Any], *, last: bool = True) -> None:
        goal.state, goal.text = state, text
        if last:
            self._last = goal
        message = from_fields(f"{self._kind}ActionResult", {"result": result})
        message.header, message.status = header(self._clock(), ""), self._about(goal)
        self._results.publish(message)
        self._states.publish(self._status(self._clock(), goal))

    def _about(self, goal: Goal) -> Any:
        return message_type("actionlib_msgs/msg/GoalStatus")(goal.id, goal.state, goal.text)

    def _status(self, t: float, goal: Goal | None) -> Any:
        return message_type(GOAL_STATUSES)(header(t, ""), [] if goal is None else [self._about(goal)])

    def _list(self, state: State) -> Callable[[], Any]:
        message = self._status(state.t, self._last)
        return lambda: message

    def _tell(self, state: State) -> Callable[[], Any]:
        t, fields = state.t, self._feedback(state)
        about = None if self.goal is None else self._about(self.goal)

        def build() -> Any:
            message = from_fields(f"{self._kind}ActionFeedback", None)
            message.header, message.status = header(t, ""), about
            for name, value in fields().items():
                setattr(message.feedback, name, value)
            return message

        return build
