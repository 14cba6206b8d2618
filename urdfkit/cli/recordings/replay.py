"""`urdfkit replay`: show a recording in the browser."""

import argparse
from contextlib import ExitStack

from urdfkit.cli.page_options import add_page_options, page_of, read_layout
from urdfkit.cli.parser import add_package_path
from urdfkit.cli.sim.bridge_options import add_bridges, bridge_options


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("file", metavar="FILE", help="a .mcap, .db3 or .bag file, or a folder of ros2 bag")
    parser.add_argument(
        "model",
        nargs="*",
        metavar="ROBOT",
        help="a .urdf or .xacro file, a package folder or a robot name; then key:=value xacro arguments (default: the "
        "robot description in the recording)",
    )
    add_package_path(parser)
    parser.add_argument(
        "--fixed-frame",
        metavar="FRAME",
        help="frame in which everything is shown (default: world, map or odom, the first that the recording has above "
        "the robot, else its root frame)",
    )
    parser.add_argument("--loop", action="store_true", help="start again at the end of the recording")
    add_page_options(parser)
    add_bridges(parser)
    parser.epilog = "examples:\n  urdfkit replay run.mcap simpleton\n  urdfkit replay lab.bag my_robot.urdf --loop"


def run(arguments: argparse.Namespace) -> int:
    """Show a recording until interrupted."""
    from urdfkit.app.page import require_page, until_interrupted

    require_page("replay", "view", modules=("rosbags",))
    from urdfkit.app.replay.replaying import recorded_model, replaying
    from urdfkit.bridges.bag_file import BagFile
    from urdfkit.cli.sim.warnings import GroupedWarnings
    from urdfkit.resources import find_model

    bridges = bridge_options(arguments)
    layout = read_layout(arguments)
    with until_interrupted(), ExitStack() as stack:
        bag = stack.enter_context(BagFile(arguments.file))
        words = arguments.model or [str(stack.enter_context(recorded_model(bag)))]
        model = find_model(words, package_path=arguments.package_path)
        page = page_of("sim", arguments, layout)
        session = stack.enter_context(
            replaying(page, bag, model, fixed_frame=arguments.fixed_frame, loop=arguments.loop)
        )
        if bridges:
            session.open_bridges(bridges, GroupedWarnings())
        session.run()
    return 0
