"""Arms: a slider for every joint of every controller, and of the drives of the new Gazebo that take one number."""

from __future__ import annotations

from math import isfinite, pi
from typing import TYPE_CHECKING, Any

from urdfkit.app.simulation.features.feature import Done, Part, Takes
from urdfkit.errors import UnknownNameError, did_you_mean
from urdfkit.messages import FLOAT, FLOATS, TRAJECTORY, from_fields
from urdfkit.sim.plugins.controllers.joints.forward_command import Forward, ForwardGroup
from urdfkit.sim.plugins.controllers.joints.gripper import Gripper
from urdfkit.sim.plugins.controllers.joints.pid_position import PidGroup, PidPosition, PidVelocity
from urdfkit.sim.plugins.controllers.trajectory.joint_trajectory import TrajectoryFollower
from urdfkit.view.protocol.page_requests import Order, Schema, number, text

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.sim.plugins.controllers.controller import Law
    from urdfkit.sim.plugins.controllers.joint_handle import JointHandle
    from urdfkit.sim.simulator import Simulator
    from urdfkit.sim.world.simulated_robot import SimulatedRobot
    from urdfkit.view.server.server import Server

KEY = "arms"
"""Key that pages want the joints' positions by."""
PERIOD = 0.1
"""Seconds between two of them."""
FASTEST, STRONGEST = 2.0, 10.0
"""Ends of a slider of a joint without limit [rad/s or m/s], [N·m or N]."""
SPEED = 0.5
"""Part of its fastest at which a joint is sent to a slider's place."""
BRISK = 1.0
"""How fast a joint without ``<limit velocity>`` goes there [rad/s or m/s]."""

GOALS = {1: ("goal", "ActionGoal"), 2: ("_action/send_goal", "_SendGoal_Request")}
"""Where a goal goes below an action, and what its type ends in, in ROS 1 and 2."""


class Arm:
    """A controller that can be told by sliders.

    Args:
        robot: whose.
        law: the controller.

    Attributes:
        name: ``ROBOT/CONTROLLER``.
        values: joint → what it was told last.
    """

    def __init__(self, robot: SimulatedRobot, law: Law) -> None:
        self.robot, self.law = robot, law
        self.name = f"{robot.name}/{law.name}"
        self.of = _commanded(law)
        self.handles: dict[str, JointHandle] = {output.handle.name: output.handle for output in law.outputs}
        self.values = {name: self._now(name) for name in self.handles}

    def _now(self, joint: str) -> float:
        return self.robot.state.position(joint) if self.of == "position" else 0.0

    def row(self) -> dict[str, Any]:
        """Return what the page needs to know."""
        joints = []
        for name, handle in self.handles.items():
            lower, upper = self._bounds(handle)
            prismatic = self.robot.kinematics.robot.joint_by_name[name].type == "prismatic"
            unit = {"position": "m" if prismatic else "rad", "velocity": "m/s" if prismatic else "rad/s"}
            effort = "N" if prismatic else "N·m"
            joints.append(
                {
                    "name": name,
                    "lower": lower,
                    "upper": upper,
                    "unit": unit.get(self.of, effort),
                    "value": self.values[name],
                }
            )
        return {"name": self.name, "type": self.law.type, "of": self.of, "running": self.law.running, "joints": joints}

    def _bounds(self, handle: JointHandle) -> tuple[float, float]:
        if self.of == "velocity":
            most = handle.fastest if isfinite(handle.fastest) else FASTEST
            return -most, most
        if self.of == "effort":
            most = handle.limit if isfinite(handle.limit) else STRONGEST
            return -most, most
        if isfinite(handle.lower) and isfinite(handle.upper):
            return handle.lower, handle.upper
        return -pi, pi

    def tell(self, bus: Any, joint: str, value: float) -> None:
        """Tell one joint, and the others of the controller what they were told before.

        Raises:
            SimulationError: no such joint.
        """
        if joint not in self.values:
            raise UnknownNameError(f"no joint `{joint}` in `{self.name}`{did_you_mean(joint, self.values)}")
        self.values[joint] = value
        law = self.law
        if isinstance(law, ForwardGroup | PidGroup):
            ending = "commands" if law.hardware.ros == 2 and isinstance(law, ForwardGroup) else "command"
            bus.publish(law.topic(ending), FLOATS, from_fields(FLOATS, {"data": list(self.values.values())}))
        elif isinstance(law, TrajectoryFollower):
            bus.publish(law.topic("command" if law.hardware.ros == 1 else "joint_trajectory"), TRAJECTORY, self._way())
        elif isinstance(law, Gripper):
            place, ending = GOALS[law.hardware.ros]
            kind = (law.kind if law.hardware.ros == 1 else law.kind.replace("/msg/", "/action/")) + ending
            goal = {"goal": law.command(value)}
            bus.publish(law.topic(f"gripper_cmd/{place}"), kind, from_fields(kind, goal))
        else:
            bus.publish(law.topic("command"), FLOAT, from_fields(FLOAT, {"data": value}))

    def _way(self) -> Any:
        """Return a trajectory from here to where the sliders stand, at half the joints' fastest."""
        longest = 0.0
        for name, handle in self.handles.items():
            fastest = SPEED * handle.fastest if isfinite(handle.fastest) else BRISK
            longest = max(longest, abs(handle.target(self.values[name], self._now(name)) - self._now(name)) / fastest)
        seconds = max(0.1, longest)
        end = {"sec": int(seconds), "nanosec": int(seconds % 1 * 1e9)}
        point = {"positions": list(self.values.values()), "time_from_start": end}
        return from_fields(TRAJECTORY, {"joint_names": list(self.values), "points": [point]})


class Arms(Part):
    """The sliders of all controllers."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._arms: dict[str, Arm] = {}
        self._states: list[tuple[str, str]] = []

    @property
    def takes(self) -> Takes:
        """The orders it takes."""
        return {
            "arm": (Schema({"controller": text(), "joint": text(), "value": number()}), self._tell),
            "controller": (Schema({"controller": text(), "running": lambda value: bool(value)}), self._switch),
        }

    def show(self) -> None:
        """Tell the pages which sliders there are."""
        before, self._arms = self._arms, {}
        for robot in self.simulator.robots.values():
            for controller in robot.plugins.controllers:
                if controller.loop is None:
                    continue
                for law in controller.loop.laws.values():
                    if _commanded(law) and law.outputs:
                        arm = Arm(robot, law)
                        if (known := before.get(arm.name)) is not None and known.law is law:
                            arm = known
                        self._arms[arm.name] = arm
        self._declare()

    def _declare(self) -> None:
        self._states = self._now()
        self.server.declare("arms", arms=[arm.row() for arm in self._arms.values()])

    def _now(self) -> list[tuple[str, str]]:
        robots = self.simulator.robots.values()
        return [(f"{robot.name}/{each.name}", each.state) for robot in robots for each in robot.controllers.list()]

    def forget(self) -> None:
        """Put the sliders where the joints are."""
        self._arms = {}
        self.show()

    def tick(self) -> None:
        """Send where the joints are."""
        if not self._arms or KEY not in self.server.hub.wanted or not self.is_due(PERIOD):
            return
        if self._now() != self._states:  # somebody loaded, started or stopped one
            self.show()
        measure = {"position": "position", "velocity": "velocity", "effort": "effort"}
        rows = {
            name: {joint: round(getattr(arm.robot.state, measure[arm.of])(joint), 6) for joint in arm.handles}
            for name, arm in self._arms.items()
        }
        self.server.tell_who_wants(KEY, KEY + "_now", values=rows)

    def _tell(self, order: Order) -> Done:
        arm = self._known(order.values["controller"])
        self.server.driver.touch(order.client)
        arm.tell(self.simulator.bus, order.values["joint"], order.values["value"])
        return None

    def _switch(self, order: Order) -> Done:
        arm = self._known(order.values["controller"])
        if order.values["running"]:
            arm.robot.controllers.start(arm.law.name)
        else:
            arm.robot.controllers.stop(arm.law.name)
        self._declare()
        return None

    def _known(self, name: str) -> Arm:
        if name not in self._arms:
            raise UnknownNameError(f"no controller `{name}`{did_you_mean(name, self._arms)}")
        return self._arms[name]


def _commanded(law: Law) -> str:
    """Return what a controller is told: position, velocity or effort; "" for one that sliders cannot tell."""
    if isinstance(law, PidVelocity):
        return "velocity"
    if isinstance(law, PidPosition | PidGroup | TrajectoryFollower | Gripper):
        return "position"
    if isinstance(law, Forward) and law.outputs:
        return law.outputs[0].interface
    return ""
