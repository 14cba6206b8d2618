"""`urdfkit view`: show a robot in the browser with a slider for every joint; changed files are reloaded."""

import argparse
from pathlib import Path

from urdfkit.app.page import Page, note, require_page, until_interrupted
from urdfkit.cli.page_options import add_page_options, announce
from urdfkit.cli.parser import add_model
from urdfkit.cli.robot_arguments.file_name_case import warn_of_file_names
from urdfkit.cli.robot_arguments.launch_arguments import add_launch_arguments, with_launch_arguments
from urdfkit.cli.robot_arguments.macro_option import add_macro, with_macro
from urdfkit.cli.robot_arguments.required_arguments import listing_required_arguments
from urdfkit.cli.robot_arguments.robot_loading import add_strict
from urdfkit.cli.robot_arguments.unused_arguments import note_unused


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_model(parser)
    add_macro(parser)
    add_launch_arguments(parser, "display")
    add_page_options(parser)
    parser.add_argument(
        "--html", metavar="FILE", help="write a self-contained page with sliders that needs no server, and exit"
    )
    add_strict(parser, "a placeholder for a missing mesh")
    parser.epilog = (
        "examples:\n  urdfkit view simpleton\n  urdfkit view urdf/robot.urdf.xacro use_camera:=true --port 8080\n"
        "  urdfkit view simpleton --html simpleton.html"
    )


def run(arguments: argparse.Namespace) -> int:
    """Serve until interrupted, or write the page to a file."""
    require_page("view", "view", modules=("rosbags",))
    from urdfkit.app.repair_findings import note_repairs
    from urdfkit.app.simulation.save_options import check_places
    from urdfkit.app.viewer.shown_robot import ShownRobot
    from urdfkit.app.viewer.viewing import html_page, viewing
    from urdfkit.atomic import write_text
    from urdfkit.resources import find_model

    check_places("--html", [Path(arguments.html)] if arguments.html is not None else [])
    named = with_macro(find_model(arguments.model, package_path=arguments.package_path), arguments)
    model = with_launch_arguments(named, arguments)

    def read() -> ShownRobot:
        with listing_required_arguments(model, quiet=arguments.quiet):
            shown = ShownRobot.read(model, strict=arguments.strict)
        note_unused(named, shown.files, quiet=arguments.quiet)
        warn_of_file_names(shown.kinematics.robot, quiet=arguments.quiet)
        if not arguments.quiet:
            note_repairs(shown.repairs)
        return shown

    if arguments.html is not None:
        shown = read()
        html = html_page(model, shown)
        write_text(Path(arguments.html), html)
        if not arguments.quiet:
            note(f"wrote {arguments.html} ({len(html.encode()) / 1e6:.2f} MB)")
        return 0
    with until_interrupted():
        shown = read()
        page = Page("view", host=arguments.host, port=arguments.port, opened=announce(arguments))
        with viewing(page, model, shown, strict=arguments.strict) as session:
            session.run()
    return 0
