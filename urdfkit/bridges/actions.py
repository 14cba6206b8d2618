"""Actions of a simulation, and goals that its peers send: over topics of its bus, of actionlib or rcl_action.

https://wiki.ros.org/actionlib/DetailedDescription, https://design.ros2.org/articles/actions.html
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any
from uuid import uuid4

from urdfkit.bridges.json_messages import from_json
from urdfkit.bus import Bus, absolute, similar_topic
from urdfkit.errors import UsageError
from urdfkit.messages import from_fields
from urdfkit.messages.control import GOAL_ID

REJECTED, EXECUTING, SUCCEEDED, CANCELED, ABORTED = 0, 2, 4, 5, 6
"""States of a goal: those of action_msgs/GoalStatus, where a rejected goal is unknown."""
STATES = {1: EXECUTING, 2: CANCELED, 3: SUCCEEDED, 4: ABORTED}
"""State of actionlib_msgs/GoalStatus → that of action_msgs; others are rejected."""
NAMES = {REJECTED: "rejected", SUCCEEDED: "succeeded", CANCELED: "canceled", ABORTED: "aborted"}
CANCEL = "action_msgs/srv/CancelGoal_Request"
RCL = "/_action"
REPORTS = ("feedback", "status")


@dataclass(frozen=True, slots=True)
class ActionServer:
    """An action server of a simulation.

    Attributes:
        name: absolute, e.g. ``/arm_controller/follow_joint_trajectory``.
        type: e.g. ``control_msgs/action/FollowJointTrajectory``.
        is_rcl: whether its topics are those of rcl_action, not of actionlib.
    """

    name: str
    type: str
    is_rcl: bool

    @property
    def goal(self) -> str:
        """Message type of its goals."""
        return self.type.replace("/action/", "/msg/") + "Goal"

    @property
    def topics(self) -> tuple[str, ...]:
        """Names of its topics on the bus."""
        if self.is_rcl:
            return tuple(f"{self.name}{RCL}/{each}" for each in ("send_goal", "cancel_goal", "get_result", *REPORTS))
        return tuple(f"{self.name}/{each}" for each in ("goal", "cancel", "result", *REPORTS))


def actions(bus: Bus) -> dict[str, ActionServer]:
    """Return the action servers of a simulation by name."""
    found = {}
    for topic in bus.topics:
        base, _, last = topic.name.rpartition("/")
        if last == "goal" and topic.type.endswith("ActionGoal"):
            found[base] = ActionServer(base, topic.type.removesuffix("ActionGoal").replace("/msg/", "/action/"), False)
        elif last == "send_goal" and base.endswith(RCL) and topic.type.endswith("_SendGoal_Request"):
            name = base.removesuffix(RCL)
            found[name] = ActionServer(name, topic.type.removesuffix("_SendGoal_Request"), True)
    return found


def find_action(bus: Bus, name: str) -> ActionServer:
    """Return the action server with a name.

    Raises:
        UsageError: the action is unknown; names the nearest.
    """
    found = actions(bus)
    full = absolute(name)
    if full not in found:
        raise UsageError(f"unknown action `{full}`{similar_topic(full, list(found))}")
    return found[full]


class SentGoal:
    """A goal that was sent to an action server; used in the thread of the simulation.

    Args:
        bus: of the simulation.
        action: the action.
        fields: of the goal, as JSON or YAML writes them, or its message.
        feedback: receives each feedback, a message.
        ended: receives the state, the result, a message or None, and the reason for the state, once.
        is_live: whether the server is in another program, which answers later.

    Raises:
        UsageError: the goal has no such fields.
    """

    def __init__(
        self,
        bus: Bus,
        action: ActionServer,
        fields: Any,
        *,
        feedback: Callable[[Any], None],
        ended: Callable[[int, Any, str], None],
        is_live: bool = False,
    ) -> None:
        self._bus, self._action, self._feedback, self._ended = bus, action, feedback, ended
        self._id = uuid4()
        self._accepted, self._result = False, None
        base, kind = (action.name + RCL, action.type) if action.is_rcl else (action.name, action.goal[:-4])
        goal = fields if hasattr(fields, "__msgtype__") else from_json(action.goal, fields)
        if action.is_rcl:
            request = from_fields(f"{kind}_SendGoal_Request", {"goal_id": {"uuid": list(self._id.bytes)}})
            topics = {
                "feedback": (f"{kind}_FeedbackMessage", self._take_feedback),
                "get_result": (f"{kind}_GetResult_Response", self._keep_result),
                "status": ("action_msgs/msg/GoalStatusArray", self._take_states),
            }
        else:
            request = from_fields(f"{kind}ActionGoal", {"goal_id": {"id": self._id.hex}})
            topics = {
                "feedback": (f"{kind}ActionFeedback", self._take_feedback),
                "result": (f"{kind}ActionResult", self._take_result),
                "status": ("actionlib_msgs/msg/GoalStatusArray", self._take_states),
            }
        request.goal = goal
        self._subscriptions = [
            bus.subscribe(f"{base}/{name}", type, receive) for name, (type, receive) in topics.items()
        ]
        bus.publish(f"{base}/{'send_goal' if action.is_rcl else 'goal'}", request.__msgtype__, request)
        if not is_live and self.is_open and not self._accepted:  # the server answers before it returns
            self._end(REJECTED, None, "the goal is rejected")

    @property
    def is_open(self) -> bool:
        """Whether the goal has not ended."""
        return bool(self._subscriptions)

    def cancel(self) -> None:
        """Request that the goal is cancelled; its end is reported as that of other goals."""
        if not self.is_open:
            return
        if self._action.is_rcl:
            fields: Any = {"goal_info": {"goal_id": {"uuid": list(self._id.bytes)}}}
            self._bus.publish(f"{self._action.name}{RCL}/cancel_goal", CANCEL, from_fields(CANCEL, fields))
        else:
            self._bus.publish(f"{self._action.name}/cancel", GOAL_ID, from_fields(GOAL_ID, {"id": self._id.hex}))

    def close(self) -> None:
        """End the subscriptions; the goal is still executed."""
        for subscription in self._subscriptions:
            subscription.close()
        self._subscriptions = []

    def _is_mine(self, id: Any) -> bool:
        found = bytes(int(byte) for byte in id.uuid) if self._action.is_rcl else id.id
        return bool(found == (self._id.bytes if self._action.is_rcl else self._id.hex))

    def _take_feedback(self, message: Any) -> None:
        if self._is_mine(message.goal_id if self._action.is_rcl else message.status.goal_id):
            self._feedback(message.feedback)

    def _take_states(self, message: Any) -> None:
        for each in message.status_list:
            if self._is_mine(each.goal_info.goal_id if self._action.is_rcl else each.goal_id):
                self._accepted = True
                if self._action.is_rcl and each.status in NAMES:
                    self._end(each.status, self._result, "")

    def _keep_result(self, message: Any) -> None:
        """Keep a result, which has no identifier; the state of its goal follows."""
        self._result = message.result

    def _take_result(self, message: Any) -> None:
        if self._is_mine(message.status.goal_id):
            self._end(STATES.get(message.status.status, REJECTED), message.result, message.status.text)

    def _end(self, state: int, result: Any, reason: str) -> None:
        if self.is_open:
            self.close()
            self._ended(state, result, reason)
