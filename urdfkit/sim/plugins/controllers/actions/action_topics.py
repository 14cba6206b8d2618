"""Topics of an action for its goals, status, feedback and results: of actionlib (ROS 1) and rcl_action (ROS 2).

Sources: actionlib; the design of ROS 2 actions (design.ros2.org/articles/actions.html) and action_msgs. The services of
ROS 2 are emulated by topics with the names of the services: the requests are subscribed to, and the response is
published on ``get_result`` when a goal has ended.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from urdfkit.bus import Topic
from urdfkit.messages import from_fields, header, message_type, stamp
from urdfkit.messages.control import GOAL_ID, GOAL_STATUSES
from urdfkit.sim.plugins.controllers.controller import RosController

ACTIVE, PREEMPTED, SUCCEEDED, ABORTED, REJECTED = 1, 2, 3, 4, 5
"""States of a goal (actionlib_msgs/GoalStatus)."""

ROS_2 = {ACTIVE: 2, PREEMPTED: 5, SUCCEEDED: 4, ABORTED: 6}
"""State → state of action_msgs/GoalStatus (executing, canceled, succeeded, aborted), which has none for rejected."""

STATES_2 = "action_msgs/msg/GoalStatusArray"
CANCEL_2 = "action_msgs/srv/CancelGoal_Request"


@dataclass
class Goal:
    """A goal and its state.

    Attributes:
        id: message with the identifier, chosen by the sender or generated.
        name: identifier as text.
        stamp: time at which the goal was sent (ROS 1) or received (ROS 2).
        state: `ACTIVE`, …
        text: reason of the state.
    """

    id: Any
    name: str
    stamp: Any
    state: int = ACTIVE
    text: str = ""

    @property
    def sent(self) -> float:
        """Its stamp [s]."""
        return seconds(self.stamp)


class ActionTopics(ABC):
    """The topics of an action.

    Args:
        controller: the controller.
        name: name of the action, relative to the controller's.
        kind: type of its messages without ``ActionGoal``, such as ``control_msgs/msg/GripperCommand``.
        take: called with each goal and its message.
        cancel: called with the name of a goal, empty for all, and the latest time of sending [s], zero for any time.
        clock: returns the simulated time [s].

    Attributes:
        feedback: topic of the feedback.
        states: topic of the states.
        results: topic of the results.
        repeats: whether the states are published periodically.
    """

    feedback: Topic
    states: Topic
    results: Topic
    repeats: bool

    def __init__(
        self,
        controller: RosController,
        name: str,
        kind: str,
        *,
        take: Callable[[Goal, Any], None],
        cancel: Callable[[str, float], None],
        clock: Callable[[], float],
    ) -> None:
        self._controller, self._kind, self._base = controller, kind, controller.topic(name)
        self._take, self._cancel, self._clock = take, cancel, clock
        self._count = 0
        self.configure()

    @abstractmethod
    def configure(self) -> None:
        """Advertise and subscribe."""

    @abstractmethod
    def status(self, t: float, goal: Goal | None) -> Any:
        """Return the message of the states."""

    @abstractmethod
    def result(self, goal: Goal, fields: dict[str, Any]) -> Any:
        """Return the message of a result; None for a goal without a result message."""

    @abstractmethod
    def progress(self, t: float, goal: Goal, fields: dict[str, Any]) -> Any:
        """Return the message of the feedback."""


class Actionlib(ActionTopics):
    """Topics of actionlib: subscribes to ``goal`` and ``cancel``, publishes ``feedback``, ``result`` and ``status``."""

    repeats = True

    def configure(self) -> None:
        """Advertise and subscribe."""
        controller, base, kind, bus = self._controller, self._base, self._kind, self._controller.hardware.setup.bus
        controller.listen(f"{base}/goal", f"{kind}ActionGoal", self._goal)
        controller.listen(f"{base}/cancel", GOAL_ID, lambda m: self._cancel(m.id, seconds(m.stamp)))
        self.results = bus.advertise(f"{base}/result", f"{kind}ActionResult")
        self.states = bus.advertise(f"{base}/status", GOAL_STATUSES)
        self.feedback = bus.advertise(f"{base}/feedback", f"{kind}ActionFeedback")

    def _goal(self, message: Any) -> None:
        self._count += 1
        name = message.goal_id.id or f"{self._controller.name}-{self._count}"
        sent = message.goal_id.stamp if seconds(message.goal_id.stamp) else stamp(self._clock())
        self._take(Goal(message_type(GOAL_ID)(sent, name), name, sent), message.goal)

    def _about(self, goal: Goal) -> Any:
        return message_type("actionlib_msgs/msg/GoalStatus")(goal.id, goal.state, goal.text)

    def status(self, t: float, goal: Goal | None) -> Any:
        """Return the message of the states."""
        return message_type(GOAL_STATUSES)(header(t, ""), [] if goal is None else [self._about(goal)])

    def result(self, goal: Goal, fields: dict[str, Any]) -> Any:
        """Return the message of a result."""
        message = from_fields(f"{self._kind}ActionResult", {"result": fields})
        message.header, message.status = header(self._clock(), ""), self._about(goal)
        return message

    def progress(self, t: float, goal: Goal, fields: dict[str, Any]) -> Any:
        """Return the message of the feedback."""
        message = from_fields(f"{self._kind}ActionFeedback", None)
        message.header, message.status = header(t, ""), self._about(goal)
        for name, value in fields.items():
            setattr(message.feedback, name, value)
        return message


class RclAction(ActionTopics):
    """Topics of rcl_action, below ``_action``: subscribes to ``send_goal`` and ``cancel_goal``, publishes the others.

    The status is published on each change.
    """

    repeats = False

    def configure(self) -> None:
        """Advertise and subscribe."""
        controller, bus = self._controller, self._controller.hardware.setup.bus
        base, kind = f"{self._base}/_action", self._kind.replace("/msg/", "/action/")
        self._progress, self._answer = f"{kind}_FeedbackMessage", f"{kind}_GetResult_Response"
        controller.listen(f"{base}/send_goal", f"{kind}_SendGoal_Request", self._goal)
        controller.listen(f"{base}/cancel_goal", CANCEL_2, self._end)
        self.results = bus.advertise(f"{base}/get_result", self._answer)
        self.states = bus.advertise(f"{base}/status", STATES_2)
        self.feedback = bus.advertise(f"{base}/feedback", self._progress)

    def _goal(self, message: Any) -> None:
        self._count += 1
        id, name = message.goal_id, _hex(message.goal_id)
        if not name:  # no id in the message: use the count
            id.uuid[-8:] = list(self._count.to_bytes(8, "big"))
            name = _hex(id)
        self._take(Goal(id, name, stamp(self._clock())), message.goal)

    def _end(self, message: Any) -> None:
        self._cancel(_hex(message.goal_info.goal_id), seconds(message.goal_info.stamp))

    def status(self, t: float, goal: Goal | None) -> Any:
        """Return the message of the states."""
        if goal is None or goal.state not in ROS_2:
            return message_type(STATES_2)([])
        about = message_type("action_msgs/msg/GoalInfo")(goal.id, goal.stamp)
        return message_type(STATES_2)([message_type("action_msgs/msg/GoalStatus")(about, ROS_2[goal.state])])

    def result(self, goal: Goal, fields: dict[str, Any]) -> Any:
        """Return the message of a result; None for a goal that was rejected."""
        if goal.state not in ROS_2:
            return None
        return from_fields(self._answer, {"status": ROS_2[goal.state], "result": fields})

    def progress(self, t: float, goal: Goal, fields: dict[str, Any]) -> Any:
        """Return the message of the feedback."""
        message = from_fields(self._progress, None)
        message.goal_id = goal.id
        for name, value in fields.items():
            setattr(message.feedback, name, value)
        return message


def seconds(stamp: Any) -> float:
    """Return a ``builtin_interfaces/msg/Time`` in seconds."""
    return float(stamp.sec + 1e-9 * stamp.nanosec)


def _hex(uuid: Any) -> str:
    """Return a UUID as text; empty if it is zero."""
    found = bytes(int(byte) for byte in uuid.uuid)
    return found.hex() if any(found) else ""
