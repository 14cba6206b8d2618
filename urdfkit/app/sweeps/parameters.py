"""Parameters that a sweep varies: the values of a run in its options, robot and simulator.

A parameter changes the options before the run (``cmd.vx``, ``spawn.x``, ``dt``, …), the description of the robot
(``JOINT.damping``), or the simulator before its first step (``LINK.mass``, ``LINK.mu``, ``JOINT.p``).
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from urdfkit.app.simulation.runs.run_options import RunOptions
from urdfkit.app.sweeps.variations import WORLD, XACRO, Value
from urdfkit.description import Robot
from urdfkit.description.urdf.robot import Dynamics, Joint, Limit
from urdfkit.errors import UnknownNameError, UsageError, did_you_mean
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.sim.simulator import Simulator

POSE = ("x", "y", "z", "roll", "pitch", "yaw")
COMMAND = ("vx", "vy", "wz")
RESISTANCE, GAINS, SURFACE = ("damping", "friction", "effort"), ("p", "i", "d"), ("mass", "mu")
FORMS = (
    "LINK.mass", "LINK.mu", "JOINT.damping", "JOINT.friction", "JOINT.effort", "JOINT.p", "JOINT.i", "JOINT.d",
    "spawn.x", "spawn.yaw", "spawn.JOINT", "cmd.vx", "cmd.wz", "cmd.ramp", "target.JOINT", "gravity", "dt", "world",
    "xacro.NAME",
)  # fmt: skip


def require_valid_names(names: Iterable[str]) -> None:
    """Reject names of no form of a parameter; links and joints are checked with the robot.

    Raises:
        UsageError: a name has no such form.
    """
    for name in names:
        subject, _, kind = name.rpartition(".")
        fixed = name in ("gravity", "dt", WORLD) or (name.startswith(XACRO) and kind)
        scheduled = subject in ("spawn", "target") or (subject == "cmd" and kind in (*COMMAND, "ramp"))
        if not (fixed or scheduled or (subject and kind in (*RESISTANCE, *GAINS, *SURFACE))):
            form = next((form for form in FORMS if form.rpartition(".")[2] == name), None)  # `mu`: of which link?
            near = (*RESISTANCE, *GAINS, *SURFACE) if subject else FORMS
            hint = f"; did you mean `{form}`?" if form else did_you_mean(kind if subject else name, near)
            raise UsageError(f"unknown parameter `{name}`{hint} (parameters: {', '.join(FORMS)})")


def options_with(options: RunOptions, values: Mapping[str, Value]) -> RunOptions:
    """Return the options of a run with these values."""
    spawn: dict[str, Any] = {}
    joints: dict[str, Any] = {}
    command: dict[str, Any] = {}
    targets: dict[str, Any] = {}
    changes: dict[str, Any] = {}
    for name, value in values.items():
        subject, _, kind = name.rpartition(".")
        if name == "gravity":
            changes["gravity"] = 0.0, 0.0, -float(value)
        elif name == "dt":
            changes["dt"] = value
        elif subject == "spawn":
            (spawn if kind in POSE else joints)[kind] = value
        elif subject == "target":
            targets[kind] = value
        elif name == "cmd.ramp":
            changes["ramp"] = value
        elif subject == "cmd":
            command[kind] = value
    if spawn or joints:
        before = options.spawn or Spawn()
        changes["spawn"] = replace(before, **spawn, joints={**before.joints, **joints})
    if targets:
        changes["joint_targets"] = {**options.joint_targets, **targets}
    if command:
        start = dict(zip(COMMAND, options.command or (0.0, 0.0, 0.0), strict=True))
        changes["command"] = tuple({**start, **command}.values())
    return replace(options, **changes)


def robot_with(robot: Robot, values: Mapping[str, Value]) -> Robot:
    """Return the robot with the damping, dry friction and effort limits of these values.

    Raises:
        UsageError: a joint is unknown, or a value is negative.
    """
    changed: dict[str, Joint] = {}
    for name, value in values.items():
        subject, _, kind = name.rpartition(".")
        if kind not in RESISTANCE or subject in ("spawn", "target", "cmd", XACRO[:-1]):
            continue
        if subject not in robot.joint_by_name:
            raise UnknownNameError(f"`{name}`: no joint `{subject}`{did_you_mean(subject, robot.joint_by_name)}")
        number = float(value)
        if number < 0.0:
            raise UsageError(f"`{name}` is {number:g}; it must not be negative")
        joint = changed.get(subject, robot.joint_by_name[subject])
        if kind == "effort":
            limit = joint.limit or Limit(None, None, None, None, joint.element)
            changed[subject] = replace(joint, limit=replace(limit, effort=number))
        else:
            dynamics = joint.dynamics or Dynamics(0.0, 0.0, joint.element)
            changed[subject] = replace(
                joint,
                dynamics=replace(dynamics, damping=number) if kind == "damping" else replace(dynamics, friction=number),
            )
    if not changed:
        return robot
    return replace(robot, joints=tuple(changed.get(joint.name, joint) for joint in robot.joints))


def tune(simulator: Simulator, values: Mapping[str, Value]) -> None:
    """Set masses, friction and gains in a simulator that has not been advanced.

    Raises:
        UsageError: a link, model or controller is unknown, or several have the name.
        SimulationError: a value is invalid or has no effect.
    """
    from urdfkit.sim.world.live_tuning import Tuning

    tuning = Tuning(simulator.world)
    links, models = ({each.name for each in group} for group in (tuning.links(simulator.name), tuning.models))
    for name, value in values.items():
        subject, _, kind = name.rpartition(".")
        if subject in ("spawn", "target", "cmd", XACRO[:-1]):
            continue
        if kind in SURFACE:
            if subject not in links | models:
                hint = did_you_mean(subject, links | models)
                raise UnknownNameError(f"`{name}`: no link or model `{subject}`{hint}")
            entity = (simulator.name, subject) if subject in links else (subject, "")
            change = tuning.set_mass if kind == "mass" else tuning.set_mu
            change(entity[0], float(value), entity[1])
        elif kind in GAINS:
            path = _gains_path(tuning.gains, simulator.name, name)
            gain: dict[str, Any] = {kind: float(value)}
            tuning.set_gains(path, replace(tuning.gains[path], **gain))


def _gains_path(gains: Mapping[str, Any], robot: str, name: str) -> str:
    """Return the path of the gains of ``JOINT`` or ``CONTROLLER/JOINT``."""
    subject = name.rpartition(".")[0]
    own = [path.partition("/")[2] for path in gains if path.startswith(f"{robot}/")]
    found = [path for path in own if path == subject or path.endswith(f"/{subject}")]
    if len(found) != 1:
        hint = did_you_mean(subject, own) or (f" (controllers with gains: {', '.join(own)})" if own else "")
        number = "several controllers have" if found else "no controller has"
        raise UnknownNameError(f"`{name}`: {number} gains for `{subject}`{hint}")
    return f"{robot}/{found[0]}"
