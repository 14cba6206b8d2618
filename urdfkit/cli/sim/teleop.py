"""`urdfkit sim teleop`: simulate a robot in real time and drive it in the browser."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from urdfkit.app.page import Page, add_page_options, faults_on_page, note, require_page, until_interrupted
from urdfkit.app.simulation.progress import compile_kernel, compile_rays, progress
from urdfkit.cli.parser import add_model
from urdfkit.cli.sim.controllers_option import add_controllers
from urdfkit.cli.sim.record_option import add_record, check_record, recording
from urdfkit.cli.sim.renderer_option import add_renderer
from urdfkit.cli.sim.ros_distro_option import add_distro
from urdfkit.cli.unused_arguments import note_unused

if TYPE_CHECKING:
    from urdfkit.app.simulation.loop import DriveLoop
    from urdfkit.app.simulation.placeholder import Placeholder
    from urdfkit.description import Robot
    from urdfkit.description.sdf import World
    from urdfkit.view.server.server import Server

KEYS = """\
Drive with W A S D, the arrow keys, i j k l u o m , . or the pad; the robot stops when you release them.
Shift strafes; q/z change both speeds by 10 %, e/c the turning speed. Ctrl-C exits."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_model(parser)
    parser.add_argument(
        "--world",
        default="empty",
        metavar="WORLD",
        help="bundled world (empty, void, house, …) or an SDF file (default: empty)",
    )
    add_distro(parser)
    add_controllers(parser)
    add_renderer(parser)
    add_record(parser)
    add_page_options(parser)
    parser.epilog = "examples:\n  urdfkit sim teleop simpleton\n  urdfkit sim teleop simpleton --port 8080 --no-browser"


def run(arguments: argparse.Namespace) -> int:
    """Simulate and serve until interrupted."""
    require_page("sim teleop", "sim", modules=("numba", "rosbags"))
    from urdfkit.app.simulation.placeholder import Placeholder
    from urdfkit.description import load
    from urdfkit.description.sdf import load_world
    from urdfkit.resources import find_model
    from urdfkit.view.server.running_simulations import noted
    from urdfkit.view.server.server import Server

    check_record(arguments.record)
    with until_interrupted():
        model = find_model(arguments.model, package_path=arguments.package_path)
        robot = load(model.path, arguments=model.arguments, package_path=model.package_path)
        note_unused(model.arguments, robot.files, quiet=arguments.quiet)
        world = load_world(arguments.world)
        placeholder = Placeholder(robot, world)
        server = Server("sim", host=arguments.host, port=arguments.port)
        page = Page(server, host=arguments.host, browser=not arguments.no_browser)
        try:
            page.open()  # the browser starts and shows the robot while the engine is compiled
            with noted(
                server.port, server.url, robot.name or "robot"
            ):  # `urdfkit topic` finds the simulation from here on
                with faults_on_page(server):
                    placeholder.show(server)
                    server.declare("progress", label="preparing the engine …")
                    ride = _ride(arguments, robot, world, placeholder, server)
                simulator = ride.simulator
                with recording(simulator, arguments.record) as ride.look:
                    note(KEYS if simulator.command_topics else "this robot has no drive that takes velocity commands")
                    ride.run()
        finally:
            server.stop()
    return 0


def _ride(
    arguments: argparse.Namespace, robot: Robot, world: World, placeholder: Placeholder, server: Server
) -> DriveLoop:
    """Compile the kernels, build the world and show it on the page."""
    from urdfkit.app.simulation.loop import DriveLoop
    from urdfkit.sim import Simulator

    compile_kernel(server)
    with progress(server, "loading meshes, building the world …"):
        simulator = Simulator(
            robot,
            world=world,
            scene=placeholder.scene,
            ros_distro=arguments.ros_distro,
            controllers=arguments.controllers,
            renderer=arguments.renderer,
            note=lambda text: note(f"urdfkit: {text}"),
        )
        ride = DriveLoop(simulator, server)
    with progress(server, "drawing …"):
        ride.show()
    if ride.sensor_views.find():
        compile_rays(server)
        with progress(server, "building the ray-casting trees of sensors …"):
            ride.sensor_views.prepare()
    return ride
