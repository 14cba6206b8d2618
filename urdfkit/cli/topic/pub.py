"""``urdfkit topic pub``: publish a message written as YAML, once or periodically."""

from __future__ import annotations

import argparse
import asyncio
import json
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import note
from urdfkit.cli.parser import count
from urdfkit.cli.topic.connection import find_topic, is_message, topics
from urdfkit.errors import UsageError, did_you_mean

if TYPE_CHECKING:
    from urdfkit.view.protocol.client import Client

RATE = 1.0
"""Messages per second of wall time; the default of ros2 topic pub."""
FASTEST = 1000.0
"""Highest rate [Hz]."""


def configure(parser: argparse.ArgumentParser, _name: str) -> None:
    """Add the arguments."""
    parser.add_argument("topic", metavar="TOPIC", help="name of the topic")
    parser.add_argument("type", nargs="?", metavar="TYPE", help="message type (default: type of the topic)")
    parser.add_argument(
        "message",
        nargs="*",
        metavar="YAML",
        help="the message, or its fields in order; missing fields are zero or empty",
    )
    often = parser.add_mutually_exclusive_group()
    often.add_argument("-r", "--rate", type=_rate, metavar="RATE", help=f"messages per second (default: {RATE:g})")
    often.add_argument("--once", action="store_true", help="publish one message and exit")
    parser.add_argument("-n", "--number", type=count(), metavar="N", help="exit after N messages")
    parser.epilog = (
        "examples:\n"
        "  urdfkit topic pub /cmd_vel geometry_msgs/Twist '{linear: {x: 0.5}}' -r 10\n"
        "  urdfkit topic pub /cmd_vel geometry_msgs/msg/Twist --once"
    )


def _rate(text: str) -> float:
    try:
        rate = float(text)
    except ValueError:
        rate = 0.0
    if not 0.0 < rate <= FASTEST:
        raise argparse.ArgumentTypeError(f"`{text}` is not a rate of more than 0 and at most {FASTEST:g} Hz")
    return rate


async def run(client: Client, arguments: argparse.Namespace) -> int:
    """Publish messages; wait for each response, so that an error is reported."""
    from urdfkit.bus import absolute
    from urdfkit.messages import full_type_name

    rows = await topics(client)
    name = absolute(arguments.topic)
    row_by_name = {row.name: row for row in rows}
    kind, words = arguments.type, arguments.message
    if kind is not None and is_message(kind):  # no type, only a message
        kind, words = None, [kind, *words]
    values = message_of(words)
    kind = kind or find_topic(rows, name).type
    number = 1 if arguments.once else arguments.number
    if not (arguments.quiet or arguments.live) and (name not in row_by_name or not row_by_name[name].subscribers):
        subscribed = [row.name for row in rows if row.subscribers and row.name != name]
        same = [row.name for row in rows if row.subscribers and row.type == full_type_name(kind)]
        near = did_you_mean(name, subscribed) or (
            f"; topics of this type with subscribers: {', '.join(same)}" if same else ""
        )
        note(f"urdfkit: {name} has no subscribers{near}")
    loop = asyncio.get_running_loop()
    due, sent, rate = loop.time(), 0, arguments.rate or RATE
    target = f"{full_type_name(kind)} to {name}"
    try:
        while True:
            await client.request("publish", topic=name, type=kind, message=values)
            sent += 1
            if sent == number:
                return 0
            if sent == 1 and not arguments.quiet:
                end = "; Ctrl-C stops" if number is None else ""
                print(f"publishing {target} at {rate:g} Hz{end}", flush=True)
            due = max(due + 1.0 / rate, loop.time())
            while (remaining := due - loop.time()) > 0:
                await client.text(remaining)  # receive and discard other messages
    finally:
        if sent and not arguments.quiet:
            print(f"published {sent} {'message' if sent == 1 else 'messages'} of type {target}", flush=True)


def message_of(words: list[str]) -> Any:
    """Return the fields of a message from the YAML on a command line.

    Args:
        words: one word with the whole message, or one word per field; none for an empty message.

    Raises:
        UsageError: the words are not YAML, or hold a value that no message supports.
    """
    import yaml

    try:
        read = [yaml.safe_load(word) for word in words]
        json.dumps(read, allow_nan=False)
    except yaml.YAMLError as error:
        raise UsageError(f"the message is not YAML: {' '.join(str(error).split())}") from error
    except (TypeError, ValueError) as error:
        raise UsageError(f"`{' '.join(words)}` contains a value that no message supports: {error}") from error
    if len(read) == 1:
        # The one field of a std_msgs/Float64 may be written alone.
        return read if not isinstance(read[0], dict | list | None) else read[0]
    return read or None
