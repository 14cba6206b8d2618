"""Options of a run without a page: those of ``sim run`` that ``sim sweep`` has, too."""

from __future__ import annotations

import argparse
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.cli.robot_arguments.launch_arguments_option import with_launch_arguments
from urdfkit.cli.robot_arguments.robot_loading import load_robot, named_robot, warn_of_unused_arguments
from urdfkit.cli.sim import option_values
from urdfkit.cli.sim.simulation_options import add_simulation_options
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.app.simulation.runs.run_options import RunOptions
    from urdfkit.description import Robot


SETTLE = 0.5
"""Simulated time after the end of a trajectory without ``--for`` [s]."""


def add_run_options(parser: argparse.ArgumentParser) -> None:
    """Add the robot, the start, the step, the plugins and the commands."""
    # argparse parses `-1,0,0` as an option unless this pattern matches it.
    parser._negative_number_matcher = re.compile(r"^-\.?\d|^-(inf|nan)", re.IGNORECASE)
    add = parser.add_argument
    add(
        "--for",
        dest="duration",
        type=option_values.duration,
        metavar="SECONDS",
        help=f"simulated time (default with --trajectory: its last time plus {SETTLE:g} s)",
    )
    add(
        "--dt",
        type=option_values.positive,
        metavar="S",
        help="time step [s] (default: the step of the world, else 0.001)",
    )
    add(
        "--spawn",
        type=option_values.pose,
        metavar="X,Y,Z,YAW",
        help="pose of the root link, or X,Y,Z,ROLL,PITCH,YAW [m, rad]; an empty Z places the robot on the ground",
    )
    add(
        "--gravity",
        type=option_values.vector("GX,GY,GZ"),
        metavar="GX,GY,GZ",
        help="gravity [m/s²] (default: the world's)",
    )
    twist = "VX,VY,VZ,WX,WY,WZ"
    add(
        "--initial-twist",
        type=option_values.vector(twist),
        metavar=twist,
        help="velocity of the root link in world axes [m/s, rad/s]",
    )
    joints = "NAME=POSITION[:VELOCITY],…"
    add(
        "--initial-joints",
        type=option_values.joint_starts,
        metavar=joints,
        help="initial state of joints [rad or m, rad/s or m/s]",
    )
    velocity = option_values.vector("VX,VY,WZ", finite=False)
    add(
        "--cmd-vel",
        type=velocity,
        metavar="VX,VY,WZ",
        help="velocity command, constant from the start [m/s, m/s, rad/s]",
    )
    add("--cmd-ramp", type=option_values.duration, metavar="S", help="increase the command linearly over S seconds")
    add(
        "--topic-pub",
        type=option_values.topic_message,
        action="append",
        default=[],
        metavar='"TOPIC TYPE YAML@T"',
        help="publish at simulated time T (repeatable)",
    )
    add(
        "--joint-target",
        type=option_values.targets,
        metavar="NAME=VALUE,…",
        help="move joints to these positions and hold them [rad or m]",
    )
    add(
        "--trajectory",
        type=Path,
        metavar="FILE.csv",
        help="move joints along a trajectory written by `urdfkit retime`, starting at its first point",
    )
    add("--fixed-base", action="store_true", help="fix the root link to the world")
    add("--until", metavar='"EXPR"', help='stop when the expression is true, e.g. "x > 1 or t > 3"')
    add_simulation_options(parser)


def check_run_options(arguments: argparse.Namespace, command: str) -> None:
    """Reject options that need another one, and a run without an end.

    Args:
        arguments: with the options of `add_run_options`.
        command: name of the command.

    Raises:
        UsageError: ``--cmd-ramp`` without ``--cmd-vel``, or neither ``--for`` nor ``--trajectory``.
    """
    if arguments.duration is None and arguments.trajectory is None:
        raise UsageError(f"{command}: the following arguments are required: --for")
    if arguments.cmd_ramp is not None and arguments.cmd_vel is None:
        raise UsageError(f"{command}: --cmd-ramp requires --cmd-vel")


def duration_of(arguments: argparse.Namespace) -> float:
    """Return the simulated time [s]: that of ``--for``, else until shortly after the end of the trajectory.

    Raises:
        UrdfkitError: the trajectory cannot be read.
    """
    if arguments.duration is not None:
        return float(arguments.duration)
    from urdfkit.app.simulation.trajectory import read_trajectory

    times = read_trajectory(arguments.trajectory).time
    assert times is not None
    return float(times[-1]) + SETTLE


def run_options_of(arguments: argparse.Namespace) -> RunOptions:
    """Return the options as a record.

    Raises:
        UrdfkitError: the trajectory cannot be read.
    """
    from urdfkit.app.simulation.runs.run_options import RunOptions
    from urdfkit.app.simulation.trajectory import read_trajectory
    from urdfkit.sim import Spawn

    spawn = None
    if arguments.spawn or arguments.initial_twist or arguments.initial_joints or arguments.trajectory:
        positions, velocities = arguments.initial_joints or ({}, {})
        if arguments.trajectory:
            path = read_trajectory(arguments.trajectory)
            positions = {**dict(zip(path.joints, path.positions[0].tolist(), strict=True)), **positions}
        pose = arguments.spawn._asdict() if arguments.spawn else {}
        twist = arguments.initial_twist or (0.0,) * 6
        spawn = Spawn(**pose, twist=twist, joints=positions, velocities=velocities)
    return RunOptions(
        dt=arguments.dt,
        seed=getattr(arguments, "seed", 0),
        spawn=spawn,
        gravity=arguments.gravity,
        fixed_base=arguments.fixed_base,
        ros_distro=arguments.ros_distro,
        controllers=tuple(arguments.controllers),
        renderer=arguments.renderer,
        strict=arguments.strict,
        density=arguments.density,
        command=arguments.cmd_vel,
        ramp=arguments.cmd_ramp or 0.0,
        joint_targets=arguments.joint_target or {},
        trajectory=arguments.trajectory,
        messages=tuple(arguments.topic_pub),
    )


def load_robot_of_run(arguments: argparse.Namespace, more: Mapping[str, str] | None = None) -> Robot:
    """Load the robot of the command line.

    Args:
        arguments: with the options of `add_simulation_options`.
        more: further xacro arguments.

    Raises:
        UrdfkitError: it cannot be loaded.
    """
    from dataclasses import replace

    named = named_robot(arguments.model, arguments)
    named = replace(named, arguments={**named.arguments, **(more or {})})
    robot = load_robot(with_launch_arguments(named, arguments), arguments)
    warn_of_unused_arguments(named, robot.files, quiet=arguments.quiet)
    return robot
