"""``urdfkit topic list``, ``info``, ``type`` and ``find``."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from typing import TYPE_CHECKING

from urdfkit.app.page import note
from urdfkit.cli.topic.connection import find_topic, topics
from urdfkit.errors import did_you_mean

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
    elif name == "type":
        parser.add_argument("topic", metavar="TOPIC", help="name of the topic")
        parser.epilog = "example:\n  urdfkit topic type /odom"
    elif name == "find":
        parser.add_argument("type", metavar="TYPE", help="message type, such as geometry_msgs/Twist")
        parser.epilog = "example:\n  urdfkit topic find geometry_msgs/msg/Twist"
    else:
        parser.add_argument("topic", metavar="TOPIC", help="name of the topic")
        parser.epilog = "examples:\n  urdfkit topic info /odom\n  urdfkit topic info /odom --json"
    parser.add_argument("--json", action="store_true", help="print one JSON value")


async def run(client: Client, arguments: argparse.Namespace) -> int:
    """Print the list, one topic, or the topics of one type; exit code 1 if there is no topic of the type."""
    rows = await topics(client)
    if arguments.subcommand == "find":
        from urdfkit.messages import full_type_name

        kind = full_type_name(arguments.type)
        found = [row.name for row in rows if row.type == kind]
        if not found and not arguments.json:
            note(f"urdfkit: no topic has the type {kind}{did_you_mean(kind, [row.type for row in rows])}")
            return 1
        print(json.dumps(found) if arguments.json else "\n".join(found))
        return 0 if found else 1
    if arguments.subcommand == "type":
        kind = find_topic(rows, arguments.topic).type
        print(json.dumps(kind) if arguments.json else kind)
        return 0
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
