"""``urdfkit topic list`` and ``urdfkit topic info``."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from typing import TYPE_CHECKING

from urdfkit.cli.topic.connection import find_topic, topics

if TYPE_CHECKING:
    from urdfkit.view.protocol.client import Client


def configure(parser: argparse.ArgumentParser, name: str) -> None:
    """Add the arguments."""
    if name == "list":
        parser.add_argument("-t", "--types", action="store_true", help="print the types too")
        parser.add_argument(
            "-v",
            "--verbose",
            action="store_true",
            help="print the type and the numbers of messages and subscribers of each topic",
        )
        parser.epilog = "examples:\n  urdfkit topic list\n  urdfkit topic list -v"
    else:
        parser.add_argument("topic", metavar="TOPIC", help="name of the topic")
        parser.epilog = "examples:\n  urdfkit topic info /odom\n  urdfkit topic info /odom --json"
    parser.add_argument("--json", action="store_true", help="print one JSON value")


async def run(client: Client, arguments: argparse.Namespace) -> int:
    """Print the list, or one topic."""
    rows = await topics(client)
    if arguments.subcommand == "info":
        row = find_topic(rows, arguments.topic)
        if arguments.json:
            print(json.dumps(asdict(row)))
        else:
            print(f"Type: {row.type}\nMessages: {row.count}\nSubscribers: {row.subscribers}")
    elif arguments.json:
        print(json.dumps([asdict(row) for row in rows]))
    else:
        for row in rows:
            counts = f" {row.count} messages, {row.subscribers} subscribers" if arguments.verbose else ""
            print(f"{row.name} [{row.type}]{counts}" if arguments.types or arguments.verbose else row.name)
    return 0
