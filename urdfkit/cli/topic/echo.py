"""``urdfkit topic echo``: print messages as YAML with ``---`` after each, or as one JSON value per line."""

from __future__ import annotations

import argparse
import json
import math
import re
from contextlib import aclosing
from typing import TYPE_CHECKING, Any

from urdfkit.cli.parser import count
from urdfkit.cli.topic.connection import find_topic, messages, topics
from urdfkit.errors import UsageError, did_you_mean

if TYPE_CHECKING:
    from urdfkit.view.protocol.client import Client

NOT_FINITE = {"inf": math.inf, "-inf": -math.inf, "nan": math.nan}
"""Strings by which the protocol represents numbers that JSON does not support."""
_STEP = re.compile(r"\.?([A-Za-z_]\w*)|\[(\d+)\]")


def configure(parser: argparse.ArgumentParser, _name: str) -> None:
    """Add the arguments."""
    parser.add_argument("topic", metavar="TOPIC", help="name of the topic")
    parser.add_argument("-n", "--number", type=count(), metavar="N", help="exit after N messages")
    parser.add_argument("--once", action="store_true", help="exit after one message")
    parser.add_argument(
        "--field", metavar="PATH", help="print only this field, such as pose.pose.position or ranges[0]"
    )
    parser.add_argument("-f", "--full-length", action="store_true", help="print long arrays in full")
    parser.add_argument("--json", action="store_true", help="print each message as JSON on one line")
    parser.epilog = (
        "examples:\n"
        "  urdfkit topic echo /odom --once\n"
        "  urdfkit topic echo /odom --field pose.pose.position -n 5 --json"
    )


async def run(client: Client, arguments: argparse.Namespace) -> int:
    """Print messages."""
    row = find_topic(await topics(client), arguments.topic)
    number = 1 if arguments.once else arguments.number
    # An entry of an array may be beyond the length at which the page cuts arrays.
    whole = arguments.full_length or "[" in (arguments.field or "")
    printed = 0
    async with aclosing(messages(client, "full_messages" if whole else "messages", row.name)) as received:
        async for _, _, message in received:
            shown = message if arguments.field is None else part(message, arguments.field)
            print(json.dumps(shown, ensure_ascii=False) if arguments.json else f"{as_yaml(shown)}---", flush=True)
            printed += 1
            if printed == number:
                break
    return 0


def part(message: Any, path: str) -> Any:
    """Return the value at a path in a message.

    Raises:
        UsageError: the path does not exist; names the nearest field.
    """
    at, value = 0, message
    while at < len(path):
        step = _STEP.match(path, at)
        if step is None:
            raise UsageError(f"--field {path}: write a path such as pose.position.x or ranges[0]")
        name, index = step[1], step[2]
        place = path[:at] or "the message"
        if name is not None:
            fields = value if isinstance(value, dict) else {}
            if name not in fields:
                raise UsageError(f"--field {path}: no field `{name}` in {place}{did_you_mean(name, fields)}")
            value = value[name]
        else:
            if not isinstance(value, list) or int(index) >= len(value):
                count = f"it has {len(value)} entries" if isinstance(value, list) else "it is not an array"
                raise UsageError(f"--field {path}: no entry {index} in {place}: {count}")
            value = value[int(index)]
        at = step.end()
    return value


def as_yaml(value: Any) -> str:
    """Return a message as ``rostopic echo`` prints it: one line per field, arrays of numbers on one line."""
    import yaml

    class Dumper(yaml.SafeDumper):
        """Dumper that writes lists of plain values on one line."""

    def represent(dumper: yaml.SafeDumper, entries: list[Any]) -> yaml.Node:
        plain = not any(isinstance(entry, dict | list) for entry in entries)
        return dumper.represent_sequence("tag:yaml.org,2002:seq", entries, flow_style=plain)

    Dumper.add_representer(list, represent)
    text = yaml.dump(
        _with_numbers(value),
        Dumper=Dumper,
        default_flow_style=False,
        sort_keys=False,
        allow_unicode=True,
        width=math.inf,
    )
    return str(text).removesuffix("...\n")


def _with_numbers(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _with_numbers(each) for name, each in value.items()}
    if isinstance(value, list):
        return [_with_numbers(each) for each in value]
    return NOT_FINITE.get(value, value) if isinstance(value, str) else value
