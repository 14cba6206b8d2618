"""`urdfkit sim run`: simulate headless, faster than real time, and report the final state."""

from __future__ import annotations

import argparse
import json
import re
import sys
import time
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.app.page import require_packages
from urdfkit.app.termination import ended_by_signals
from urdfkit.cli.parser import add_model
from urdfkit.cli.robot_arguments.file_name_case import warn_of_file_names
from urdfkit.cli.robot_arguments.launch_arguments import add_launch_arguments, with_launch_arguments
from urdfkit.cli.robot_arguments.macro_option import add_macro, with_macro
from urdfkit.cli.robot_arguments.robot_loading import load_robot
from urdfkit.cli.robot_arguments.unused_arguments import note_unused
from urdfkit.cli.sim import option_values
from urdfkit.cli.sim.bridge_options import add_bridges, bridge_options
from urdfkit.cli.sim.controllers_option import add_controllers
from urdfkit.cli.sim.record_option import NEW_TOPIC_PERIOD, add_record, check_record, recording
from urdfkit.cli.sim.renderer_option import add_renderer
from urdfkit.cli.sim.repair_options import add_repair_options
from urdfkit.cli.sim.ros_distro_option import add_distro
from urdfkit.cli.sim.warnings import GroupedWarnings
from urdfkit.errors import SimulationError, UsageError, suggestion

if TYPE_CHECKING:
    from urdfkit.bridges.bridge import Bridges
    from urdfkit.cli.sim.run_report import Effort
    from urdfkit.sim.simulator import Simulator

CHUNK = 1.0
"""Simulated seconds between two readings of the clock."""

COMMAND_PERIOD = 0.1
"""Simulated seconds between velocity commands to controllers, whose commands time out."""

PROGRESS = 0.5
"""Wall seconds between lines of progress."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    # argparse parses `-1,0,0` as an option unless this pattern matches it.
    parser._negative_number_matcher = re.compile(r"^-\.?\d|^-(inf|nan)", re.IGNORECASE)
    add_model(parser)
    add_macro(parser)
    add_launch_arguments(parser, "simulation")
    add = parser.add_argument
    add("--for", dest="duration", required=True, type=option_values.duration, metavar="SECONDS", help="simulated time")
    add(
        "--world",
        default="empty",
        metavar="WORLD",
        help="bundled world (empty, void, house, …) or an SDF file (default: empty)",
    )
    add(
        "--dt",
        type=option_values.positive,
        metavar="S",
        help="time step [s] (default: the step of the world, else 0.001)",
    )
    add("--seed", type=option_values.seed, default=0, metavar="N", help="seed of all random numbers (default: 0)")
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
        help="move joints along the trajectory in a file of `urdfkit retime`, from its first positions on",
    )
    add("--fixed-base", action="store_true", help="fix the root link to the world")
    add("--until", metavar='"EXPR"', help='stop when the expression is true, e.g. "x > 1 or t > 3"')
    add(
        "--save-image",
        type=option_values.topic_file(".png"),
        action="append",
        default=[],
        metavar="TOPIC=FILE.png",
        help="write the last image of a topic (repeatable; TOPIC is optional if there is only one)",
    )
    add(
        "--save-scan",
        type=option_values.topic_file(".json", ".csv"),
        action="append",
        default=[],
        metavar="TOPIC=FILE.json",
        help="write the last scan or point cloud of a topic as JSON or .csv (repeatable; TOPIC as in --save-image)",
    )
    add_record(parser)
    add("--save-world", metavar="FILE", help="write the final world without the robot as SDF")
    add_distro(parser)
    add_controllers(parser)
    add_renderer(parser)
    add_repair_options(parser)
    add_bridges(parser)
    add("--json", action="store_true", help="print one JSON value")
    parser.epilog = (
        "examples:\n"
        "  urdfkit sim run simpleton --for 10 --cmd-vel 0.5,0,0.5 --cmd-ramp 0.5\n"
        '  urdfkit sim run simpleton --for 60 --cmd-vel 0.5,0,0 --until "x > 2" --json'
    )


@ended_by_signals()
def run(arguments: argparse.Namespace) -> int:
    """Simulate and report."""
    if arguments.cmd_ramp is not None and arguments.cmd_vel is None:
        raise UsageError("sim run: --cmd-ramp requires --cmd-vel")
    require_packages("sim run", "sim", {name: name for name in ("numpy", "trimesh", "numba", "rosbags")})
    from urdfkit.app.page import note
    from urdfkit.app.simulation import image_files, save_options
    from urdfkit.app.simulation.bridging.bridges import bridged
    from urdfkit.app.simulation.bridging.real_time import RunControls
    from urdfkit.atomic import write_bytes
    from urdfkit.cli.sim import scan_files
    from urdfkit.cli.sim.run_report import as_json, as_text

    save_options.check_places("--save-image", (each.file for each in arguments.save_image))
    save_options.check_places("--save-scan", (each.file for each in arguments.save_scan))
    check_record(arguments)
    options = bridge_options(arguments)
    save_options.check_places("--save-world", [Path(arguments.save_world)] if arguments.save_world is not None else [])
    simulator = load(arguments)
    command(simulator, arguments)
    images = image_files.find_topics(simulator, arguments.save_image)
    ranges = scan_files.find_topics(simulator, arguments.save_scan)
    with (
        bridged(simulator, options, RunControls(simulator), note) as bridges,
        recording(simulator, arguments) as subscribe_to_new,
    ):
        if arguments.record is not None:
            simulator.every(NEW_TOPIC_PERIOD, subscribe_to_new)
        spent = advance(simulator, arguments.duration, arguments.until, bridges)
    for file, content in [*image_files.contents(simulator, images), *scan_files.contents(simulator, ranges)]:
        write_bytes(file, content)
    if arguments.save_world is not None:
        simulator.world.save(arguments.save_world)
    print(json.dumps(as_json(simulator, spent), indent=1) if arguments.json else as_text(simulator, spent))
    return 0


def load(arguments: argparse.Namespace) -> Simulator:
    """Return the simulator with the robot in its initial state; compile the kernel after robot and world are read.

    Raises:
        UrdfkitError: robot or world cannot be loaded or simulated.
    """
    from urdfkit.app.simulation.kernel_compilation import prepare_kernel
    from urdfkit.app.simulation.trajectory import read_trajectory
    from urdfkit.description.sdf import load_world
    from urdfkit.description.xml.cost_limit import loading_limit
    from urdfkit.resources import find_model
    from urdfkit.sim import Simulator, Spawn

    limit = loading_limit()
    with limit:
        named = with_macro(find_model(arguments.model, package_path=arguments.package_path), arguments)
        model = with_launch_arguments(named, arguments)
        robot = load_robot(model, arguments)
        note_unused(named, robot.files, quiet=arguments.quiet)
        world = load_world(arguments.world)
    prepare_kernel(sys.stderr)
    spawn = None
    if arguments.spawn or arguments.initial_twist or arguments.initial_joints or arguments.trajectory:
        positions, velocities = arguments.initial_joints or ({}, {})
        if arguments.trajectory:
            path = read_trajectory(arguments.trajectory)
            positions = {**dict(zip(path.joints, path.positions[0].tolist(), strict=True)), **positions}
        pose = arguments.spawn._asdict() if arguments.spawn else {}
        twist = arguments.initial_twist or (0.0,) * 6
        spawn = Spawn(**pose, twist=twist, joints=positions, velocities=velocities)
    warnings = GroupedWarnings()
    with limit, warnings:
        simulator = Simulator(
            robot,
            world=world,
            dt=arguments.dt,
            seed=arguments.seed,
            spawn=spawn,
            gravity=arguments.gravity,
            fixed_base=arguments.fixed_base,
            ros_distro=arguments.ros_distro,
            controllers=arguments.controllers,
            renderer=arguments.renderer,
            strict=arguments.strict,
            density=arguments.density,
            note=(lambda text: None) if arguments.quiet else warnings,
        )
    warn_of_file_names(robot, quiet=arguments.quiet)
    return simulator


def command(simulator: Simulator, arguments: argparse.Namespace) -> None:
    """Schedule the messages, targets and trajectory of the options.

    Raises:
        UrdfkitError: a topic, type, field or joint is unknown.
    """
    from urdfkit.app.simulation.trajectory import follow, read_trajectory

    if arguments.cmd_vel is not None:
        ramp(simulator, arguments.cmd_vel, arguments.cmd_ramp or 0.0)
    for joint, target in (arguments.joint_target or {}).items():
        _require_free(simulator, joint)
        simulator.motors.hold(joint, target)
    if arguments.trajectory is not None:
        follow(simulator, read_trajectory(arguments.trajectory))
    for message in arguments.topic_pub:
        publish_at(simulator, message)


def _require_free(simulator: Simulator, joint: str) -> None:
    """Reject a target for a joint that a controller commands in every step.

    Raises:
        SimulationError: a running controller claims the joint.
    """
    for one in simulator.controllers.list():
        if one.state in ("running", "active") and any(claim.split("/")[0] == joint for claim in one.claims):
            raise SimulationError(
                f"--joint-target {joint}: controller `{one.name}` commands this joint; publish to it with --topic-pub"
            )


def ramp(simulator: Simulator, command: tuple[float, float, float], seconds: float) -> None:
    """Publish a velocity command that increases linearly from zero.

    The command is published once per update of the drives, each time with the mean of the ramp until the next update:
    the commands that the drives hold add up to exactly the ramp. Controllers time out after about half a second, so
    they receive the final command ten times a second.

    Args:
        simulator: not yet advanced.
        command: VX, VY [m/s], WZ [rad/s].
        seconds: duration of the ramp.

    Raises:
        SimulationError: the robot has no drive.
    """
    vx, vy, wz = command
    period = simulator.command_period
    for i in range(ceil(seconds / period - 1e-9) + 1):
        begin, end = i * period, (i + 1) * period
        part = 1.0
        if begin < seconds:
            risen = (min(end, seconds) ** 2 - begin**2) / 2 / seconds
            part = (risen + max(0.0, end - seconds)) / period
        linear, angular = (part * vx, part * vy, 0.0), (0.0, 0.0, part * wz)
        simulator.at(begin, lambda linear=linear, angular=angular: simulator.command(linear, angular))  # type: ignore[misc]
    if simulator.controllers.command_topics:
        simulator.every(
            COMMAND_PERIOD, lambda: simulator.command((vx, vy, 0.0), (0.0, 0.0, wz)), start=seconds + COMMAND_PERIOD
        )
    if not simulator.command_topics:
        simulator.command((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))  # raises


def publish_at(simulator: Simulator, wanted: option_values.TopicMessage) -> None:
    """Schedule one message.

    Raises:
        UsageError: the type or a field is unknown, or the topic has another type.
    """
    import yaml

    from urdfkit.bus import absolute, nearest_topic
    from urdfkit.messages import from_fields, full_type_name

    try:
        fields = yaml.safe_load(wanted.text)
    except yaml.YAMLError as error:
        raise UsageError(f"--topic-pub {wanted.topic}: `{wanted.text}` is not YAML ({_first_line(error)})") from None
    kind = full_type_name(wanted.type)
    message = from_fields(kind, fields)
    subscribed = [topic.name for topic in simulator.bus.topics if topic.subscribers]
    simulator.bus.advertise(wanted.topic, kind)
    if absolute(wanted.topic) not in subscribed:
        own = sorted(topic for topic in subscribed if not topic.startswith(("/gazebo/", "/world/")))
        others = f" (topics with subscribers: {', '.join(own)})" if own else ""
        near = nearest_topic(absolute(wanted.topic), subscribed)
        simulator.note(f"{absolute(wanted.topic)} has no subscribers{suggestion(near) or others}")
    simulator.at(wanted.t, lambda: simulator.bus.publish(wanted.topic, kind, message))


def advance(simulator: Simulator, seconds: float, until: str | None, bridges: Bridges) -> Effort:
    """Advance, with progress on a terminal, in real time with bridges; return the time spent.

    Raises:
        UrdfkitError: the simulation diverged, or the condition cannot be evaluated.
    """
    from urdfkit.app.simulation.bridging.real_time import advance_in_real_time
    from urdfkit.cli.sim.run_report import Effort
    from urdfkit.cli.sim.until_condition import Condition

    joints = (*simulator.kinematics.joint_names, *simulator.kinematics.mimic_names)
    condition = Condition(until, joints) if until is not None else None
    total = round(seconds / simulator.dt)

    def ended() -> bool:
        return simulator.state.step >= total or (condition is not None and bool(condition(simulator.state)))

    chunk = max(1, round(CHUNK / simulator.dt)) if condition is None else 1
    shown = time.perf_counter() if sys.stderr.isatty() else float("inf")
    cpu, own, wall = time.process_time(), time.thread_time(), time.perf_counter()
    try:
        while not ended():
            if bridges:
                advance_in_real_time(simulator, bridges, ended)
                break
            simulator.step(min(chunk, total - simulator.state.step))
            if time.perf_counter() - shown > PROGRESS:
                shown = time.perf_counter()
                sys.stderr.write(f"\r{simulator.t:.1f} of {seconds:g} s \r")
                sys.stderr.flush()
    finally:
        if sys.stderr.isatty():
            sys.stderr.write("\x1b[K")
    # After a CPU timer such as that of `CostLimit`, Linux updates the time of the process only at ticks of 4 ms.
    spent = max(time.process_time() - cpu, time.thread_time() - own)
    return Effort(spent, time.perf_counter() - wall)


def _first_line(error: Exception) -> str:
    return str(error).splitlines()[0]
