"""Actions over rclpy: a server whose goals the simulation executes."""

from collections.abc import Callable
from threading import Lock
from typing import Any

from urdfkit.bridges.actions import CANCELED, EXECUTING, REJECTED, SUCCEEDED, ActionServer
from urdfkit.bridges.node.node import Begin
from urdfkit.bridges.ros2.rclpy_messages import further_fields, rclpy_message
from urdfkit.messages import typestore
from urdfkit.messages.conversion import converted


class ServedGoal:
    """A goal of a client of ROS 2.

    The thread of the simulation reports its feedback and its end, which may arrive before rclpy has a handle for it.

    Args:
        kind: the action of rclpy.

    Attributes:
        state: of `bridges.actions`.
        cancel: requests that the simulation cancels it.
    """

    def __init__(self, kind: Any) -> None:
        self.state = EXECUTING
        self.cancel: Callable[[], None] = lambda: None
        self._kind = kind
        self._result: Any = None
        self._handle: Any = None
        self._finish: Callable[[], None] | None = None
        self._lock = Lock()

    def feedback(self, message: Any) -> None:
        """Publish feedback."""
        if self._handle is not None:
            self._handle.publish_feedback(rclpy_message(self._kind.Feedback, message))

    def ended(self, state: int, result: Any, _reason: str) -> None:
        """Take the end of the goal in the simulation."""
        with self._lock:
            self.state, self._result = state, result
        if self._finish is not None:
            self._finish()

    def accepted(self, handle: Any, finish: Callable[[], None]) -> None:
        """Take the handle that rclpy has made, and what ends the goal there."""
        with self._lock:
            if self.state == EXECUTING:
                self._handle, self._finish = handle, finish
                return
        finish()

    def close(self, handle: Any) -> Any:
        """Set the final state, in the thread of the executor, and return the result.

        A goal that another one has replaced is aborted: in ROS 2, only a goal that a client cancels is canceled.
        """
        if self.state == SUCCEEDED:
            handle.succeed()
        elif self.state == CANCELED and handle.is_cancel_requested:
            handle.canceled()
        else:
            handle.abort()
        return self._kind.Result() if self._result is None else rclpy_message(self._kind.Result, self._result)


def serve_action(
    node: Any, kind: Any, name: str, action: ActionServer, begin: Begin, report: Callable[[str], None]
) -> Any:
    """Serve an action of a simulation, and return the server of rclpy.

    Args:
        node: of rclpy.
        kind: the action of rclpy.
        name: on the graph.
        action: of the simulation.
        begin: sends a goal to the simulation.
        report: receives a line about fields of goals that urdfkit lacks, once for the same fields.
    """
    from rclpy.action import ActionServer as Server
    from rclpy.action import CancelResponse, GoalResponse

    waiting: dict[int, ServedGoal] = {}  # by request: rclpy accepts it and makes its handle in the same call
    goals: dict[bytes, ServedGoal] = {}
    reported: set[str] = set()

    class GoalServer(Server):  # type: ignore[misc]
        """Calls what ends a goal when the simulation has ended it, instead of what executes it."""

        def notify_execute(self, goal_handle: Any, execute_callback: Any) -> None:
            """Wait for the end of a goal, whose state is executing now."""
            notify, key = super().notify_execute, bytes(goal_handle.goal_id.uuid)
            goals[key] = goal = waiting.pop(id(goal_handle.request))

            def close(handle: Any) -> Any:
                del goals[key]
                return goal.close(handle)

            goal.accepted(goal_handle, lambda: notify(goal_handle, close))

    def take(request: Any) -> Any:
        """Wait until the simulation has accepted or rejected a goal."""
        further = ", ".join(further_fields(request, action.goal))
        if further and further not in reported:
            reported.add(further)
            report(f"{name}: fields of a goal are ignored, because urdfkit lacks them: {further}")
        goal = ServedGoal(kind)
        goal.cancel = begin(converted(request, action.goal, typestore()), goal.feedback, goal.ended)
        if goal.state == REJECTED:
            return GoalResponse.REJECT
        waiting[id(request)] = goal
        return GoalResponse.ACCEPT

    def cancel(handle: Any) -> Any:
        goals[bytes(handle.goal_id.uuid)].cancel()
        return CancelResponse.ACCEPT

    return GoalServer(node, kind, name, lambda _: None, goal_callback=take, cancel_callback=cancel)
