"""`urdfkit action`: list actions of a simulation or a live robot and send goals, as ``ros2 action`` does."""

from __future__ import annotations

import argparse
import asyncio
import json
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import note
from urdfkit.cli.parser import HelpFormatter
from urdfkit.cli.topic.connection import add_connection_options, run_with_client, topics
from urdfkit.cli.topic.echo import as_yaml
from urdfkit.cli.topic.pub import message_of

if TYPE_CHECKING:
    from urdfkit.view.protocol.client import Client

SUBCOMMANDS = {"list": "list the actions", "send": "send a goal, wait until it ends, and print its result"}
"""Subcommand → its description."""
PERIOD = 0.05
"""Seconds between two requests for the state of a goal."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the subcommands."""
    parser.epilog = (
        "examples:\n  urdfkit action list --types\n"
        "  urdfkit action send /arm_controller/follow_joint_trajectory '{trajectory:\n"
        "    {joint_names: [elbow], points: [{positions: [0.5], time_from_start: 2}]}}'"
    )
    subcommands = parser.add_subparsers(dest="subcommand", metavar="SUBCOMMAND", required=True)
    for name, summary in SUBCOMMANDS.items():
        sub = subcommands.add_parser(name, help=summary, description=summary, formatter_class=HelpFormatter)
        add_connection_options(sub)
        if name == "list":
            sub.add_argument("-t", "--types", action="store_true", help="print the types too")
            sub.epilog = "example:\n  urdfkit action list --types"
        else:
            sub.add_argument("action", metavar="ACTION", help="name of the action")
            sub.add_argument("goal", nargs="*", metavar="YAML", help="the goal, or its fields in order")
            sub.add_argument("-f", "--feedback", action="store_true", help="print the feedback too")
            sub.epilog = "example:\n  urdfkit action send /gripper_controller/gripper_cmd '{command: {position: 0.02}}'"
        sub.add_argument("--json", action="store_true", help="print JSON, one value per line")


def run(arguments: argparse.Namespace) -> int:
    """Run one subcommand; exit code 1 if a goal has not succeeded. Ctrl-C cancels the goal."""
    return run_with_client(_list if arguments.subcommand == "list" else _send, arguments)


async def _list(client: Client, arguments: argparse.Namespace) -> int:
    await topics(client)  # the simulation has started
    rows = (await client.request("actions"))["actions"]
    if arguments.json:
        print(json.dumps([{"name": name, "type": type} for name, type in rows]))
    else:
        for name, type in rows:
            print(f"{name} [{type}]" if arguments.types else name)
    return 0


async def _send(client: Client, arguments: argparse.Namespace) -> int:
    from urdfkit.bridges.actions import EXECUTING, NAMES, SUCCEEDED

    await topics(client)
    goal = message_of(arguments.goal)
    answer = await client.request("send_goal", action=arguments.action, goal=goal)
    number, warnings = answer["goal"], answer.get("warnings", [])
    try:
        while True:
            found = await client.request("goal_state", goal=number)
            if arguments.feedback and found["feedback"] is not None:
                _print(found["feedback"], arguments, separator="---\n")
            if found["state"] != EXECUTING:
                break
            await asyncio.sleep(PERIOD)
    except asyncio.CancelledError:
        await client.request("cancel_goal", goal=number)
        raise
    if found["result"] is not None:
        _print(found["result"], arguments)
    if found["state"] == SUCCEEDED:
        return 0
    reason = "; ".join([*([found["reason"]] if found["reason"] else []), *warnings])
    note(f"urdfkit: the goal is {NAMES[found['state']]}{f': {reason}' if reason else ''}")
    return 1


def _print(value: Any, arguments: argparse.Namespace, separator: str = "") -> None:
    text = f"{json.dumps(value, ensure_ascii=False)}\n" if arguments.json else as_yaml(value) + separator
    print(text, end="", flush=True)
