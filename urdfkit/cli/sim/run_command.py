"""`urdfkit sim run`: simulate headless, faster than real time, and report the final state."""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.app.page import note, require_packages
from urdfkit.app.termination import ended_by_signals
from urdfkit.cli.progress_line import ProgressLine
from urdfkit.cli.robot_arguments.robot_loading import warn_of_file_names
from urdfkit.cli.sim import option_values
from urdfkit.cli.sim.bridge_options import add_bridges, bridge_options
from urdfkit.cli.sim.record_option import NEW_TOPIC_PERIOD, add_record, check_record, recording
from urdfkit.cli.sim.run_options import (
    add_run_options,
    check_run_options,
    duration_of,
    load_robot_of_run,
    run_options_of,
)
from urdfkit.cli.sim.warnings import GroupedWarnings, note_lint_target
from urdfkit.errors import short_lines

if TYPE_CHECKING:
    from urdfkit.app.simulation.runs.run_options import RunOptions
    from urdfkit.bridges.bridge import Bridges
    from urdfkit.cli.sim.run_report import Effort
    from urdfkit.sim.simulator import Simulator

CHUNK = 1.0
"""Simulated seconds between two readings of the clock."""

PROGRESS = 0.5
"""Wall seconds between lines of progress."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_run_options(parser)
    add = parser.add_argument
    add("--seed", type=option_values.seed, default=0, metavar="N", help="seed of all random numbers (default: 0)")
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
    add_bridges(parser, note=" (the simulation then runs in real time)")
    add("--json", action="store_true", help="print one JSON value")
    parser.epilog = (
        "examples:\n"
        "  urdfkit sim run simpleton --for 10 --cmd-vel 0.5,0,0.5 --cmd-ramp 0.5\n"
        '  urdfkit sim run simpleton --for 60 --cmd-vel 0.5,0,0 --until "x > 2" --json'
    )


@ended_by_signals()
def run(arguments: argparse.Namespace) -> int:
    """Simulate and report."""
    check_run_options(arguments, "sim run")
    require_packages("sim run", "sim", {name: name for name in ("numpy", "trimesh", "numba", "rosbags")})
    from urdfkit.app.simulation import image_files
    from urdfkit.app.simulation.bridging.bridges import bridged
    from urdfkit.app.simulation.bridging.real_time import RunControls
    from urdfkit.atomic import check_output_files, write_bytes
    from urdfkit.cli.sim import scan_files
    from urdfkit.cli.sim.run_report import as_json, as_text

    check_output_files("--save-image", (each.file for each in arguments.save_image))
    check_output_files("--save-scan", (each.file for each in arguments.save_scan))
    check_record(arguments)
    options = bridge_options(arguments)
    check_output_files("--save-world", [Path(arguments.save_world)] if arguments.save_world is not None else [])
    run_options, duration = run_options_of(arguments), duration_of(arguments)
    simulator = load(arguments, run_options)
    run_options.schedule(simulator, others_may_subscribe=bool(options) or arguments.record is not None)
    images = image_files.find_topics(simulator, arguments.save_image)
    ranges = scan_files.find_topics(simulator, arguments.save_scan)
    with (
        bridged(simulator, options, RunControls(simulator), note) as bridges,
        recording(simulator, arguments) as subscribe_to_new,
    ):
        if arguments.record is not None:
            simulator.every(NEW_TOPIC_PERIOD, subscribe_to_new)
        spent = advance(simulator, duration, arguments.until, bridges)
    for file, content in [*image_files.contents(simulator, images), *scan_files.contents(simulator, ranges)]:
        write_bytes(file, content)
    if arguments.save_world is not None:
        simulator.world.save(arguments.save_world)
    print(json.dumps(as_json(simulator, spent), indent=1) if arguments.json else short_lines(as_text(simulator, spent)))
    return 0


def load(arguments: argparse.Namespace, options: RunOptions) -> Simulator:
    """Return the simulator with the robot in its initial state; compile the kernel after robot and world are read.

    Raises:
        UrdfkitError: robot or world cannot be loaded or simulated.
    """
    from urdfkit.app.simulation.kernel_compilation import prepare_kernel
    from urdfkit.description.sdf import load_world
    from urdfkit.description.xml.cost_limit import loading_limit

    limit = loading_limit()
    with limit:
        robot = load_robot_of_run(arguments)
        world = load_world(arguments.world)
    prepare_kernel(sys.stderr)
    warnings = GroupedWarnings(quiet=arguments.quiet)
    with limit, warnings:
        simulator = options.build(robot, world, warnings)
    note_lint_target(simulator.repairs, quiet=arguments.quiet)
    warn_of_file_names(robot, quiet=arguments.quiet)
    return simulator


def advance(simulator: Simulator, seconds: float, until: str | None, bridges: Bridges) -> Effort:
    """Advance, with progress on a terminal, in real time with bridges; return the time spent.

    Raises:
        UrdfkitError: the simulation diverged, or the condition cannot be evaluated.
    """
    from urdfkit.app.simulation.bridging.real_time import advance_in_real_time
    from urdfkit.app.simulation.runs.expression import Expression, state_values
    from urdfkit.cli.sim.run_report import Effort

    joints = (*simulator.kinematics.joint_names, *simulator.kinematics.mimic_names)
    condition = Expression(until, joints) if until is not None else None
    total = round(seconds / simulator.dt)

    def ended() -> bool:
        return simulator.state.step >= total or (
            condition is not None and bool(condition(simulator.state, state_values(simulator.state)))
        )

    chunk = max(1, round(CHUNK / simulator.dt)) if condition is None else 1
    cpu, own, wall = time.process_time(), time.thread_time(), time.perf_counter()
    with ProgressLine(period=PROGRESS) as progress:
        while not ended():
            if bridges:
                advance_in_real_time(simulator, bridges, ended)
                break
            simulator.step(min(chunk, total - simulator.state.step))
            progress(f"{simulator.t:.1f} of {seconds:g} s")
    # After a CPU timer such as that of `CostLimit`, Linux updates the time of the process only at ticks of 4 ms.
    spent = max(time.process_time() - cpu, time.thread_time() - own)
    return Effort(spent, time.perf_counter() - wall, is_paced=bool(bridges))
