"""Sliders for the joints of controllers, and of the Gazebo drives that are commanded by one number."""

from collections.abc import Callable
from math import isfinite, pi
from typing import Any

from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.errors import UnknownNameError, did_you_mean
from urdfkit.messages import FLOAT, FLOATS, TRAJECTORY, from_fields
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.controllers.joint_handle import JointHandle
from urdfkit.sim.plugins.controllers.joints.forward_command import Forward, ForwardGroup
from urdfkit.sim.plugins.controllers.joints.gripper import Gripper
from urdfkit.sim.plugins.controllers.joints.pid_position import PidGroup, PidPosition, PidVelocity
from urdfkit.sim.plugins.controllers.trajectory.joint_trajectory import TrajectoryFollower
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.world.simulated_robot import SimulatedRobot
from urdfkit.view.protocol.page_requests import Request, Schema, number, text
from urdfkit.view.server.server import Server

KEY = "arms"
"""Key of the stream of joint positions."""
PERIOD = 0.1
"""Seconds between two messages."""
FASTEST, STRONGEST = 2.0, 10.0
"""Range of the slider of a joint without limit [rad/s or m/s], [N·m or N]."""
SPEED = 0.5
"""Share of its maximum velocity at which a joint moves to the position of its slider."""
BRISK = 1.0
"""Velocity of a joint without ``<limit velocity>`` [rad/s or m/s]."""

GOALS = {1: ("goal", "ActionGoal"), 2: ("_action/send_goal", "_SendGoal_Request")}
"""Topic of an action's goal and suffix of its type, in ROS 1 and 2."""


class ControllerSliders:
    """A controller that is commanded by sliders.

    Args:
        robot: the robot of the controller.
        controller: the controller.

    Attributes:
        name: ``ROBOT/CONTROLLER``.
        values: joint → last command.
    """

    def __init__(self, robot: SimulatedRobot, controller: RosController) -> None:
        self.robot, self.controller = robot, controller
        self.name = f"{robot.name}/{controller.name}"
        self.of = _commanded(controller)
        self.handles: dict[str, JointHandle] = {output.handle.name: output.handle for output in controller.outputs}
        self.values = {name: self._now(name) for name in self.handles}

    def _now(self, joint: str) -> float:
        return self.robot.state.position(joint) if self.of == "position" else 0.0

    def row(self) -> dict[str, Any]:
        """Return the description of the controller for the page."""
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
        return {
            "name": self.name,
            "type": self.controller.type,
            "of": self.of,
            "running": self.controller.running,
            "joints": joints,
        }

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

    def command(self, bus: Any, joint: str, value: float) -> None:
        """Command one joint, and repeat the last commands of the controller's other joints.

        Raises:
            SimulationError: the joint is unknown.
        """
        if joint not in self.values:
            raise UnknownNameError(f"unknown joint `{joint}` in `{self.name}`{did_you_mean(joint, self.values)}")
        self.values[joint] = value
        controller = self.controller
        if isinstance(controller, ForwardGroup | PidGroup):
            ending = "commands" if controller.hardware.ros == 2 and isinstance(controller, ForwardGroup) else "command"
            bus.publish(controller.topic(ending), FLOATS, from_fields(FLOATS, {"data": list(self.values.values())}))
        elif isinstance(controller, TrajectoryFollower):
            bus.publish(
                controller.topic("command" if controller.hardware.ros == 1 else "joint_trajectory"),
                TRAJECTORY,
                self._way(),
            )
        elif isinstance(controller, Gripper):
            place, ending = GOALS[controller.hardware.ros]
            kind = (
                controller.kind if controller.hardware.ros == 1 else controller.kind.replace("/msg/", "/action/")
            ) + ending
            goal = {"goal": controller.command(value)}
            bus.publish(controller.topic(f"gripper_cmd/{place}"), kind, from_fields(kind, goal))
        else:
            bus.publish(controller.topic("command"), FLOAT, from_fields(FLOAT, {"data": value}))

    def _way(self) -> Any:
        """Return a trajectory from the current positions to those of the sliders, at half the maximum velocities."""
        longest = 0.0
        for name, handle in self.handles.items():
            fastest = SPEED * handle.fastest if isfinite(handle.fastest) else BRISK
            longest = max(longest, abs(handle.target(self.values[name], self._now(name)) - self._now(name)) / fastest)
        seconds = max(0.1, longest)
        end = {"sec": int(seconds), "nanosec": int(seconds % 1 * 1e9)}
        point = {"positions": list(self.values.values()), "time_from_start": end}
        return from_fields(TRAJECTORY, {"joint_names": list(self.values), "points": [point]})


class JointSliders(Feature):
    """The sliders of all controllers."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._arms: dict[str, ControllerSliders] = {}
        self._states: list[tuple[str, str]] = []

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        return {
            "arm": (Schema({"controller": text(), "joint": text(), "value": number()}), self._command),
            "controller": (Schema({"controller": text(), "running": lambda value: bool(value)}), self._switch),
        }

    def show(self) -> None:
        """Publish the sliders."""
        before, self._arms = self._arms, {}
        for robot in self.simulator.world.robots.values():
            for plugin in robot.plugins.controllers:
                if plugin.loop is None:
                    continue
                for controller in plugin.loop.controllers.values():
                    if _commanded(controller) and controller.outputs:
                        arm = ControllerSliders(robot, controller)
                        if (previous := before.get(arm.name)) is not None and previous.controller is controller:
                            arm = previous
                        self._arms[arm.name] = arm
        self._declare()

    def _declare(self) -> None:
        self._states = self._now()
        self.server.publish_latched("arms", arms=[arm.row() for arm in self._arms.values()])

    def _now(self) -> list[tuple[str, str]]:
        robots = self.simulator.world.robots.values()
        return [(f"{robot.name}/{each.name}", each.state) for robot in robots for each in robot.controllers.list()]

    def forget(self) -> None:
        """Set the sliders to the positions of the joints."""
        self._arms = {}
        self.show()

    def tick(self) -> None:
        """Send the positions of the joints."""
        if not self._arms or KEY not in self.server.hub.subscribed_keys or not self.is_due(PERIOD):
            return
        if self._now() != self._states:  # a controller was loaded, started or stopped
            self.show()
        rows = {
            name: {joint: round(getattr(arm.robot.state, arm.of)(joint), 6) for joint in arm.handles}
            for name, arm in self._arms.items()
        }
        self.server.send_to_subscribers(KEY, KEY + "_now", values=rows)

    def _command(self, request: Request) -> Done:
        arm = self._arm(request.values["controller"])
        self.server.drive_lock.claim(request.client)
        arm.command(self.simulator.bus, request.values["joint"], request.values["value"])
        return None

    def _switch(self, request: Request) -> Done:
        arm = self._arm(request.values["controller"])
        if request.values["running"]:
            arm.robot.controllers.start(arm.controller.name)
        else:
            arm.robot.controllers.stop(arm.controller.name)
        self._declare()
        return None

    def _arm(self, name: str) -> ControllerSliders:
        if name not in self._arms:
            raise UnknownNameError(f"unknown controller `{name}`{did_you_mean(name, self._arms)}")
        return self._arms[name]


def _commanded(controller: RosController) -> str:
    """Return the quantity that a controller is commanded by: position, velocity or effort; "" if not by sliders."""
    if isinstance(controller, PidVelocity):
        return "velocity"
    if isinstance(controller, PidPosition | PidGroup | TrajectoryFollower | Gripper):
        return "position"
    if isinstance(controller, Forward) and controller.outputs:
        return controller.outputs[0].interface
    return ""
