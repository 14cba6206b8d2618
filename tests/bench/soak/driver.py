"""Who drives: somebody who does not look."""

from __future__ import annotations

import numpy as np

from urdfkit.messages import from_fields
from urdfkit.sim import Simulator


class Driver:
    """Commands what a driver would who does not look: twists, and positions of joints that have a topic for them.

    A robot that no topic moves, such as a legged one without controllers, gets its positions from the motors.
    """

    def __init__(self, simulator: Simulator, random: np.random.Generator) -> None:
        self._simulator = simulator
        self._random = random
        self._until = 0.0
        listened = [topic for topic in simulator.bus.topics if topic.subscribers]
        self._positions = [topic for topic in listened if topic.type == "std_msgs/msg/Float64"]
        self._trajectories = [topic for topic in listened if topic.type == "trajectory_msgs/msg/JointTrajectory"]
        self.by_motors = not (self._positions or self._trajectories or simulator.command_topics)
        """Whether no topic moves the robot."""

    def drive(self, t: float, *, resting: bool) -> None:
        """Command something else when it is time to."""
        if resting:
            if self._until >= 0.0:
                self._twist((0.0, 0.0, 0.0))
            self._until = -1.0
            return
        if t < self._until:
            return
        self._until = t + self._random.uniform(0.5, 3.0)
        if self.by_motors:
            for name in filter(self._is_free, self._simulator.kinematics.joint_names):
                lower, upper = self._simulator.kinematics.limits(name)
                self._simulator.motors.hold(name, self._random.uniform(max(lower, -1.5), min(upper, 1.5)))
        self._twist(tuple(self._random.uniform(-1.0, 1.0, 3) * (1.0, 0.5, 2.0)))
        for topic in self._positions:
            value = {"data": float(self._random.uniform(-1.5, 1.5))}
            self._simulator.bus.publish(topic.name, topic.type, from_fields(topic.type, value))
        if self._trajectories:
            joints = [name for name in self._simulator.kinematics.joint_names if self._is_free(name)]
            point = {
                "positions": self._random.uniform(-1.5, 1.5, len(joints)).tolist(),
                "time_from_start": {"sec": int(self._random.integers(1, 4)), "nanosec": 0},
            }
            for topic in self._trajectories:
                message = from_fields(topic.type, {"joint_names": joints, "points": [point]})
                self._simulator.bus.publish(topic.name, topic.type, message)

    def start_again(self) -> None:
        """Command something new at once."""
        self._until = 0.0

    def _is_free(self, joint: str) -> bool:
        return self._simulator.robot.joint_by_name[joint].type == "revolute"

    def _twist(self, command: tuple[float, ...]) -> None:
        if self._simulator.command_topics:
            vx, vy, wz = command
            self._simulator.command((vx, vy, 0.0), (0.0, 0.0, wz))
