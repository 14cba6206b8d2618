"""`urdfkit service`: services of a simulation or live robot, as ``rosservice`` and ``ros2 service`` do."""

from __future__ import annotations

import argparse
import json
import re
from typing import TYPE_CHECKING, Any

from urdfkit.cli.parser import HelpFormatter
from urdfkit.cli.topic.connection import add_connection_options, run_with_client, topics
from urdfkit.cli.topic.echo import as_yaml
from urdfkit.cli.topic.pub import message_of
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.view.protocol.client import Client

SUBCOMMANDS = {
    "list": "list the services",
    "type": "print the type of a service",
    "call": "call a service and print its response",
}
"""Subcommand → its description."""
OK = 1
"""The result code of success in responses of simulation_interfaces."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the subcommands."""
    parser.epilog = (
        "examples:\n  urdfkit service list --types\n  urdfkit service call /spawn_entity '{name: box, entity_resource:"
        " {uri: box}}'"
    )
    subcommands = parser.add_subparsers(dest="subcommand", metavar="SUBCOMMAND", required=True)
    for name, summary in SUBCOMMANDS.items():
        sub = subcommands.add_parser(name, help=summary, description=summary, formatter_class=HelpFormatter)
        add_connection_options(sub)
        if name == "list":
            sub.add_argument("-t", "--types", action="store_true", help="print the types too")
            sub.epilog = "examples:\n  urdfkit service list\n  urdfkit service list --types --live ros1"
        else:
            sub.add_argument("service", metavar="SERVICE", help="name of the service")
        if name == "type":
            sub.epilog = "example:\n  urdfkit service type /spawn_entity"
        if name == "call":
            sub.add_argument(
                "request",
                nargs="*",
                metavar="YAML",
                help="the request, or its fields in order; missing fields are zero or empty",
            )
            sub.epilog = (
                "examples:\n"
                "  urdfkit service call /gazebo/reset_simulation\n"
                "  urdfkit service call /gazebo/delete_model '{model_name: box}' --json"
            )
        sub.add_argument("--json", action="store_true", help="print one JSON value")


def run(arguments: argparse.Namespace) -> int:
    """Run one subcommand; exit code 1 if a response reports a failure."""
    return run_with_client(_run, arguments)


async def _run(client: Client, arguments: argparse.Namespace) -> int:
    await topics(client)  # the simulation has started
    if arguments.subcommand == "list":
        names = (await client.request("services"))["services"]
        if not arguments.types:
            print(json.dumps(names) if arguments.json else "\n".join(names))
            return 0
        rows = [{"name": name, "type": await _type(client, name)} for name in names]
        print(json.dumps(rows) if arguments.json else "\n".join(f"{row['name']} [{row['type']}]" for row in rows))
        return 0
    kind = await _type(client, arguments.service)
    if arguments.subcommand == "type":
        print(json.dumps(kind) if arguments.json else kind)
        return 0
    words = arguments.request
    if words and re.fullmatch(r"\w+(/srv)?/\w+", words[0]):  # the type, as `ros2 service call` requires it
        named = words[0] if "/srv/" in words[0] else words[0].replace("/", "/srv/")
        if named != kind:
            raise UsageError(f"service `{arguments.service}` has type {kind}, not {named}")
        words = words[1:]
    answer = await client.request("call_service", service=arguments.service, request=message_of(words))
    response = answer["response"]
    print(json.dumps(response, ensure_ascii=False) if arguments.json else as_yaml(response).removesuffix("\n"))
    return int(not succeeded(response))


async def _type(client: Client, service: str) -> str:
    return str((await client.request("service_type", service=service))["type"])


def succeeded(response: Any) -> bool:
    """Return whether a response reports no failure: by ``success``, ``ok``, or the result of simulation_interfaces."""
    if not isinstance(response, dict):
        return True
    result = response.get("result")
    if isinstance(result, dict) and {"result", "error_message"} <= result.keys():
        return bool(result["result"] == OK)
    return bool(response.get("success", response.get("ok", True)))
