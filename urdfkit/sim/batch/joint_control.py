"""Control of joints by the actions of a batch: velocities, positions or efforts."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from urdfkit.errors import SimulationError, UsageError
from urdfkit.linear_algebra import Array
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.state.arguments import nearest

VELOCITY, POSITION, EFFORT = "velocity", "position", "effort"
SERVO_LIMIT = "servo_effort"
"""Array of the engine with the effort limits of servos."""
MODES = (VELOCITY, POSITION, EFFORT)


@dataclass(frozen=True, slots=True)
class Servo:
    """Position servo of a joint with the effort stiffness·(action − q) − damping·q̇.

    Attributes:
        stiffness: [N·m/rad] or [N/m].
        damping: [N·m·s/rad] or [N·s/m].

    Examples:
        >>> from urdfkit.sim.batch import Batch, Servo
        >>> worlds = Batch("rrbot", 2, control={"joint1": Servo(stiffness=50.0, damping=5.0)}, threads=1)
        >>> worlds.actions.shape
        (2, 1)
    """

    stiffness: float
    damping: float


Control = Mapping[str, "str | Servo"]
"""Joint → ``velocity``, ``position``, ``effort`` or a `Servo`."""


class JointControl:
    """Control of the joints of a robot; sets their motors and servos in the simulation that is copied.

    Args:
        simulator: the simulation.
        control: the mode of each joint; None: see `default_control`.
        ranges: joint → least and greatest action; the limits of the joint for others.

    Raises:
        UsageError: a mode is invalid.
        UnknownNameError: a joint is unknown.

    Attributes:
        joints: names of the joints, in the order of the actions.
        modes: their modes.
        low: least actions, which replace lower ones; shape (joints,).
        high: greatest actions; shape (joints,).
        targets: array of the engine and degree of freedom of each joint's action.
        limits: array of the engine with the effort limit of each joint; None in the mode ``effort``.
    """

    def __init__(
        self, simulator: Simulator, control: Control | None, ranges: Mapping[str, Sequence[float]] | None
    ) -> None:
        control = default_control(simulator) if control is None else control
        if not control:
            raise UsageError(f"robot `{simulator.name}` has no joint to control")
        self.joints, self.modes = tuple(control), tuple(control.values())
        self.targets = [_set_up(simulator, joint, mode) for joint, mode in control.items()]
        self.limits = [_effort_limit(mode) for mode in self.modes]
        for joint in ranges or ():
            if joint not in control:
                raise UsageError(f"`ranges` names `{joint}`, which has no action{nearest(joint, control)}")
        found = [(ranges or {}).get(joint) or action_range(simulator, joint, mode) for joint, mode in control.items()]
        self.low, self.high = np.array(found, dtype=float).T.copy()
        if not (self.low <= self.high).all():
            wrong = int(np.flatnonzero(~(self.low <= self.high))[0])
            raise UsageError(f"the range {found[wrong]} of `{self.joints[wrong]}` is empty")

    def clipped(self, actions: Array) -> Array:
        """Return actions within their ranges."""
        return np.clip(actions, self.low, self.high)


def _effort_limit(mode: str | Servo) -> str | None:
    if isinstance(mode, Servo):
        return SERVO_LIMIT
    return None if mode == EFFORT else "motor_effort"


def default_control(simulator: Simulator) -> dict[str, str | Servo]:
    """Return the control of the joints that the robot's plugins move, or of all joints if no plugin moves one.

    Continuous joints are controlled by velocity, others by position. The simulation is reset.
    """
    if simulator.command_topics:
        simulator.command((0.1, 0.0, 0.0), (0.0, 0.0, 0.1))
    simulator.run(2.0 * simulator.command_period)
    robot = simulator.world.builder.robot_list[0].articulation
    moved = (robot.motor_effort > 0) | (robot.kp > 0) | (robot.kd > 0) | (robot.approach_rate > 0)
    simulator.reset()
    kinematics = simulator.kinematics
    joints = [joint for joint in kinematics.joint_names if _has_motor(simulator, joint)]
    driven = [joint for joint in joints if moved[kinematics.velocity_index(joint)]]
    by_name = simulator.robot.joint_by_name
    return {joint: VELOCITY if by_name[joint].type == "continuous" else POSITION for joint in driven or joints}


def _has_motor(simulator: Simulator, joint: str) -> bool:
    return simulator.robot.joint_by_name[joint].type in ("continuous", "revolute", "prismatic")


def _set_up(simulator: Simulator, joint: str, mode: str | Servo) -> tuple[str, int]:
    """Set the motor of a joint, and return the array and the degree of freedom of its actions."""
    motors = simulator.motors
    motors.release(joint)
    lower, upper = simulator.kinematics.limits(joint)
    start = min(upper, max(lower, simulator.state.position(joint)))
    index = simulator.kinematics.velocity_index(joint)
    if isinstance(mode, Servo):
        motors.servo(joint, stiffness=mode.stiffness, damping=mode.damping, position=start)
        return "position_target", index
    if mode == VELOCITY:
        motors.drive(joint, 0.0)
        return "motor_velocity", index
    if mode == POSITION:
        motors.hold(joint, start)
        return "position_target", index
    if mode != EFFORT:
        raise UsageError(f"unknown mode {mode!r} of joint `{joint}`; use {', '.join(MODES)} or a Servo")
    return "applied", index


def action_range(simulator: Simulator, joint: str, mode: str | Servo) -> tuple[float, float]:
    """Return the least and the greatest action of a joint by its limits; infinite without limits."""
    if mode == POSITION or isinstance(mode, Servo):
        lower, upper = simulator.kinematics.limits(joint)
        return lower, upper
    if mode == EFFORT:
        most = simulator.motors.limit(joint)
        return -most, most
    limit = simulator.robot.joint_by_name[joint].limit
    most = inf if limit is None else limit.velocity or inf
    return -most, most


def finite_ranges(control: JointControl) -> tuple[Array, Array]:
    """Return the least and greatest actions.

    Raises:
        SimulationError: a joint has no limit, and no range was given.
    """
    for joint, low, high in zip(control.joints, control.low, control.high, strict=True):
        if not (np.isfinite(low) and np.isfinite(high)):
            raise SimulationError(f"joint `{joint}` has no limit for its action; use ranges={{'{joint}': (low, high)}}")
    return control.low, control.high
