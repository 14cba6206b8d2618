"""`urdfkit view`: show a robot in the browser with a slider for every joint; changed files are reloaded."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import note, require_page, until_interrupted
from urdfkit.cli.page_options import add_page_options, page_of, read_layout
from urdfkit.cli.parser import add_model
from urdfkit.cli.picture_options import add_picture_options, check_picture_options, set_picture_defaults, write_pictures
from urdfkit.cli.robot_arguments.launch_arguments_option import add_launch_arguments, with_launch_arguments
from urdfkit.cli.robot_arguments.required_arguments import listing_required_arguments
from urdfkit.cli.robot_arguments.robot_loading import (
    add_macro,
    add_strict,
    named_robot,
    shown_repairs,
    warn_of_file_names,
    warn_of_unused_arguments,
)
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.app.viewer.shown_robot import ShownRobot


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_model(parser)
    add_macro(parser)
    add_launch_arguments(parser, "display")
    add_page_options(parser)
    parser.add_argument(
        "--html", metavar="FILE", help="write a self-contained page with sliders, which needs no server, and exit"
    )
    parser.add_argument(
        "--live", metavar="SOURCE", help="show and drive a real robot: through ros1, ros2 or rosbridge://HOST:PORT"
    )
    parser.add_argument("--fixed-frame", metavar="FRAME", help="with --live: frame in which all data is shown")
    add_picture_options(parser)
    add_strict(parser, "a placeholder for a missing mesh")
    parser.epilog = (
        "examples:\n  urdfkit view simpleton\n  urdfkit view urdf/robot.urdf.xacro use_camera:=true --port 8080\n"
        "  urdfkit view simpleton --html simpleton.html\n"
        "  urdfkit view simpleton --image simpleton.png --size 800,600\n"
        "  urdfkit view seven_dof_arm --video arm.gif --motion joints"
    )


def run(arguments: argparse.Namespace) -> int:
    """Serve until interrupted, or write the page or pictures to files."""
    if arguments.fixed_frame is not None and arguments.live is None:
        raise UsageError("--fixed-frame is an option of --live ros1, ros2 or rosbridge://HOST:PORT")
    if arguments.live is not None and arguments.html is not None:
        raise UsageError("--html writes a page without a server, so it cannot be combined with --live")
    set_picture_defaults(arguments)
    is_picture = arguments.image is not None or arguments.video is not None
    if is_picture and arguments.live is not None:
        raise UsageError("--image and --video show a robot of a file, so they cannot be combined with --live")
    require_page("view", "view", modules=("rosbags",))
    from urdfkit.app.page_modes import view_and_simulate
    from urdfkit.app.repair_findings import note_repairs
    from urdfkit.app.viewer.shown_robot import ShownRobot
    from urdfkit.app.viewer.viewing import html_page
    from urdfkit.atomic import check_output_files, write_text

    if is_picture:
        check_picture_options(arguments)
    check_output_files("--html", [Path(arguments.html)] if arguments.html is not None else [])
    named = named_robot(arguments.model, arguments)
    model = with_launch_arguments(named, arguments)

    def read() -> ShownRobot:
        with listing_required_arguments(model, quiet=arguments.quiet):
            shown = ShownRobot.read(model, strict=arguments.strict)
        warn_of_unused_arguments(named, shown.files, quiet=arguments.quiet)
        warn_of_file_names(shown.kinematics.robot, quiet=arguments.quiet)
        note_repairs(shown_repairs(shown.repairs, quiet=arguments.quiet))
        return shown

    if is_picture:
        write_pictures(arguments, shown := read())
        if arguments.html is None:
            return 0
    if arguments.html is not None:
        shown = shown if is_picture else read()
        html = html_page(model, shown)
        write_text(Path(arguments.html), html)
        if not arguments.quiet:
            note(f"wrote {arguments.html} ({len(html.encode()) / 1e6:.2f} MB)")
        return 0
    layout = read_layout(arguments)
    with until_interrupted():
        shown = read()
        if arguments.live is not None:
            _follow(arguments, shown, layout)
            return 0
        view_and_simulate(page_of("view", arguments, layout), model, shown, strict=arguments.strict)
    return 0


def _follow(arguments: argparse.Namespace, shown: ShownRobot, layout: dict[str, Any] | None) -> None:
    """Show a live robot until interrupted."""
    from urdfkit.app.replay.live_view import following

    page = page_of("sim", arguments, layout)
    with following(page, shown, arguments.live, note, fixed_frame=arguments.fixed_frame) as session:
        session.run()
