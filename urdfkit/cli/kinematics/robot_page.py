"""The page of a robot with a result of a command, served (``--view``) or as one file (``--html``)."""

import argparse
from collections.abc import Mapping
from typing import Any

from urdfkit.app.page import note, until_interrupted
from urdfkit.cli.page_options import page_of, read_layout
from urdfkit.resources import ModelArgument


def show_page(arguments: argparse.Namespace, model: ModelArgument, messages: Mapping[str, Mapping[str, Any]]) -> None:
    """Write the page to the file of ``--html``, or serve it until interrupted with ``--view``, or both.

    Args:
        arguments: of the command line.
        model: the robot as it was given.
        messages: messages for the page: type → values; see docs/protocol.md.
    """
    from urdfkit.app.viewer.shown_robot import ShownRobot
    from urdfkit.app.viewer.viewing import html_page, viewing
    from urdfkit.atomic import write_text

    shown = ShownRobot.read(model, strict=arguments.strict)
    if arguments.html is not None:
        write_text(arguments.html, html_page(model, shown, messages))
        if not arguments.quiet:
            note(f"wrote {arguments.html}")
    if arguments.view:
        layout = read_layout(arguments)
        with until_interrupted():
            page = page_of("view", arguments, layout)
            with viewing(page, model, shown, strict=arguments.strict) as session:
                for name, values in messages.items():
                    session.server.publish_latched(name, **values)
                session.run()
