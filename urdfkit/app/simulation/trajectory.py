"""Motion of a simulated robot along a trajectory: through the controllers of the joints, or directly."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from urdfkit.errors import SimulationError, UsageError
from urdfkit.kinematics.retiming import JointPath, read_path
from urdfkit.linear_algebra import Array
from urdfkit.messages import TRAJECTORY, from_fields
from urdfkit.sim import Simulator
from urdfkit.sim.plugins.controllers.control_loop import ControllerStatus

PERIOD = 0.01
"""Time between two commands [s]."""
_NUMBERS = ("std_msgs/msg/Float64", "std_msgs/msg/Float64MultiArray")


def read_trajectory(file: Path) -> JointPath:
    """Return the trajectory in a CSV file.

    Raises:
        ResourceError: the file cannot be read.
        UsageError: the file has no times.
    """
    path = read_path(file)
    if path.time is None:
        raise UsageError(f"{file} has no column `time`; compute a trajectory from the path with `urdfkit retime`")
    if path.time[0] < 0.0:
        raise UsageError(f"{file} starts at {path.time[0]:g} s, before the simulation")
    return path


def follow(simulator: Simulator, trajectory: JointPath) -> None:
    """Move joints along a trajectory that starts now, then hold its end.

    A joint trajectory controller gets the whole trajectory of its joints, a controller that takes positions gets one
    every `PERIOD`. Joints without a controller move with
    velocities that reach each position `PERIOD` later, within their limits of velocity and effort.

    Args:
        simulator: the simulator.
        trajectory: with times [s] from now.

    Raises:
        UnknownNameError: a joint is unknown.
        SimulationError: a joint's controller accepts neither trajectories nor positions.
    """
    assert trajectory.time is not None
    for joint in trajectory.joints:
        simulator.state.position(joint)  # raises
    left = list(trajectory.joints)
    for controller in simulator.controllers.list():
        claimed = list(dict.fromkeys(claim.split("/")[0] for claim in controller.claims))
        common = [joint for joint in left if joint in claimed]
        if controller.state not in ("running", "active") or not common:
            continue
        left = [joint for joint in left if joint not in claimed]
        name = f"/{controller.namespace.strip('/')}/{controller.name}/".replace("//", "/")
        topics = {
            topic.type: topic.name
            for topic in simulator.bus.topics
            if topic.subscribers and topic.name.startswith(name)
        }
        columns = _columns(simulator, trajectory, claimed)
        if TRAJECTORY in topics:
            _publish_whole(simulator, topics[TRAJECTORY], trajectory.time, claimed, columns)
        elif _takes_positions(controller) and (number := next((kind for kind in _NUMBERS if kind in topics), None)):
            _publish_positions(simulator, topics[number], number, trajectory.time, columns)
        else:
            raise SimulationError(
                f"joint `{common[0]}`: controller `{controller.name}` of type {controller.type} commands it and "
                "accepts neither trajectories nor positions"
            )
    if left:
        _drive(simulator, trajectory.time, left, _columns(simulator, trajectory, left))


def _takes_positions(controller: ControllerStatus) -> bool:
    """Whether the commands of a controller that takes numbers are positions."""
    package, _, kind = controller.type.partition("/")
    all_positions = all(claim.endswith("/position") for claim in controller.claims)
    return "Position" in kind or package == "position_controllers" or all_positions


def _columns(simulator: Simulator, trajectory: JointPath, joints: Sequence[str]) -> Array:
    """Return the positions of joints; those without a column keep theirs; shape (N, n)."""
    return np.stack(
        [
            trajectory.positions[:, trajectory.joints.index(joint)]
            if joint in trajectory.joints
            else np.full(len(trajectory.positions), simulator.state.position(joint))
            for joint in joints
        ],
        axis=1,
    )


def _publish_whole(simulator: Simulator, topic: str, times: Array, joints: Sequence[str], positions: Array) -> None:
    """Publish a trajectory at once, with velocities, at rest at both ends."""
    velocities = np.gradient(positions, times, axis=0) if len(times) > 1 else np.zeros_like(positions)
    velocities[0] = velocities[-1] = 0.0
    points = []
    for time, position, velocity in zip(times.tolist(), positions.tolist(), velocities.tolist(), strict=True):
        seconds, nanoseconds = divmod(round(time * 1e9), 10**9)
        after = {"sec": seconds, "nanosec": nanoseconds}
        points.append({"positions": position, "velocities": velocity, "time_from_start": after})
    message = from_fields(TRAJECTORY, {"joint_names": list(joints), "points": points})
    simulator.at(simulator.t, lambda: simulator.publish(topic, TRAJECTORY, message))


def _publish_positions(simulator: Simulator, topic: str, kind: str, times: Array, positions: Array) -> None:
    """Publish the present positions of a trajectory until its end."""
    start = simulator.t

    def command() -> None:
        passed = simulator.t - start
        if passed <= times[-1] + 2.0 * PERIOD:
            values = [float(np.interp(passed, times, column)) for column in positions.T]
            simulator.publish(topic, kind, from_fields(kind, {"data": values[0] if kind == _NUMBERS[0] else values}))

    simulator.every(PERIOD, command, start=start)


def _drive(simulator: Simulator, times: Array, joints: Sequence[str], positions: Array) -> None:
    """Move joints without a controller."""
    start = simulator.t
    limits = [simulator.kinematics.robot.joint_by_name[joint].limit for joint in joints]
    fastest = [limit.velocity if limit is not None and limit.velocity else np.inf for limit in limits]
    period = max(simulator.dt, round(PERIOD / simulator.dt) * simulator.dt)

    def command() -> None:
        passed = simulator.t - start
        if passed > times[-1] + period:
            return
        for joint, column, most in zip(joints, positions.T, fastest, strict=True):
            if passed >= times[-1]:
                simulator.motors.hold(joint, float(column[-1]))
                continue
            velocity = (float(np.interp(passed + period, times, column)) - simulator.state.position(joint)) / period
            simulator.motors.drive(joint, max(-most, min(most, velocity)))

    simulator.every(period, command, start=start)
