"""`urdfkit sim teleop`: simulate a robot in real time and drive it in the browser."""

import argparse
from contextlib import ExitStack

from urdfkit.app.page import note, require_page, until_interrupted
from urdfkit.cli.page_options import add_page_options, opens_browser, page_of, read_layout
from urdfkit.cli.robot_arguments.robot_loading import warn_of_file_names
from urdfkit.cli.sim.bridge_options import add_bridges, bridge_options
from urdfkit.cli.sim.record_option import add_record, check_record, recording
from urdfkit.cli.sim.run_options import load_robot_of_run
from urdfkit.cli.sim.simulation_options import add_simulation_options
from urdfkit.cli.sim.terminal_option import add_terminal, check_terminal, terminal_driving
from urdfkit.cli.sim.warnings import GroupedWarnings, note_lint_target

KEYS = """\
Drive with W A S D, the arrow keys, i j k l u o m , . or the pad; the robot stops when you release them.
Shift strafes; q/z change both speeds by 10 %, e/c the turning speed. Ctrl-C exits."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_simulation_options(parser)
    add_record(parser)
    add_page_options(parser)
    add_terminal(parser)
    add_bridges(parser)
    parser.add_argument(
        "--watchers-may",
        action="append",
        default=[],
        choices=("pause", "reset", "change"),
        help="requests to accept from other pages while a page drives (repeatable): pause (also step and speed), "
        "reset, or change (edit the world and publish); by default, other pages can only stop the robots",
    )
    parser.epilog = (
        "examples:\n  urdfkit sim teleop simpleton\n  urdfkit sim teleop simpleton --port 8080 --no-browser\n"
        "  urdfkit sim teleop simpleton --terminal"
    )


def run(arguments: argparse.Namespace) -> int:
    """Simulate and serve until interrupted."""
    require_page("sim teleop", "sim", modules=("numba", "rosbags"))
    from urdfkit.app.simulation.bridging.bridges import bridged
    from urdfkit.app.simulation.runs.run_options import RunOptions
    from urdfkit.app.simulation.simulation_handle import driving
    from urdfkit.description.sdf import load_world
    from urdfkit.description.xml.cost_limit import loading_limit

    check_record(arguments)
    bridges = bridge_options(arguments)
    layout = read_layout(arguments)
    arguments.no_browser = arguments.no_browser or bool(arguments.terminal)
    from_terminal = check_terminal(arguments, browser=opens_browser(arguments))
    with until_interrupted():
        with loading_limit():
            robot = load_robot_of_run(arguments)
            world = load_world(arguments.world)
        page = page_of("sim", arguments, layout, arguments.watchers_may)
        warnings = GroupedWarnings(quiet=arguments.quiet)
        options = RunOptions(
            ros_distro=arguments.ros_distro,
            controllers=tuple(arguments.controllers),
            renderer=arguments.renderer,
            strict=arguments.strict,
            density=arguments.density,
        )
        with ExitStack() as stack:
            with warnings:
                loop = stack.enter_context(driving(page, robot, world, options, note=warnings))
            note_lint_target(loop.simulator.repairs, quiet=arguments.quiet)
            loop.bridges = stack.enter_context(
                bridged(loop.simulator, bridges, loop, warnings, services=loop.services if bridges else {})
            )
            loop.look = stack.enter_context(recording(loop.simulator, arguments))
            if not loop.simulator.command_topics:
                note("this robot has no drive that accepts velocity commands")
            elif not from_terminal:
                note(KEYS)
            warn_of_file_names(robot, quiet=arguments.quiet)
            with terminal_driving(loop, active=from_terminal):
                loop.run()
    return 0
