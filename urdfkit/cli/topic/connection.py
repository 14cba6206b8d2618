"""Connection to a running simulation: find it, connect, request its topics, receive their messages."""

from __future__ import annotations

import argparse
import asyncio
from collections.abc import AsyncGenerator, Awaitable, Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import note
from urdfkit.errors import MissingDependencyError, ResourceError, UsageError

if TYPE_CHECKING:
    from urdfkit.app.replay.discovery import Search
    from urdfkit.view.protocol.client import Client

READY = 30.0
"""Seconds to wait for the list of topics, which comes twice a second."""


@dataclass(frozen=True, slots=True)
class Row:
    """One topic of a simulation.

    Attributes:
        name: absolute name.
        type: e.g. ``nav_msgs/msg/Odometry``.
        count: messages published so far.
        subscribers: subscribers in the simulation and in connected programs.
    """

    name: str
    type: str
    count: int
    subscribers: int


def add_connection_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that select a simulation or another graph."""
    parser.add_argument(
        "--url",
        metavar="ADDRESS",
        help="address of the simulation that `sim teleop` prints (default: the running simulation)",
    )
    parser.add_argument(
        "--live", metavar="SOURCE", help="connect to another graph: ros1, ros2 or rosbridge://HOST:PORT"
    )


def run_with_client(work: Callable[[Client, argparse.Namespace], Awaitable[int]], arguments: argparse.Namespace) -> int:
    """Run a coroutine with a connection to the running simulation; return its exit code.

    Raises:
        MissingDependencyError: tornado is not installed.
        ResourceError: no simulation is running, or it does not respond.
    """
    from importlib.util import find_spec

    if find_spec("tornado") is None:
        raise MissingDependencyError(f"{arguments.command} needs tornado: pip install 'urdfkit[view]'")
    from urdfkit.view.protocol.client import connect
    from urdfkit.view.server.running_simulations import find

    async def connected(url: str) -> int:
        async with await connect(url) as client:
            return await work(client, arguments)

    with suppress(KeyboardInterrupt):
        if arguments.live is None:
            return asyncio.run(connected(find(arguments.url)))
        from urdfkit.app.replay.topic_session import served_topics

        if arguments.url is not None:
            raise UsageError("--url names a simulation and --live another graph: use one of them")
        with served_topics(arguments.live, note, _search(arguments)) as url:
            return asyncio.run(connected(url))
    return 0


def _search(arguments: argparse.Namespace) -> Search | None:
    """Return the name that a command looks up; None if it waits for its topic, service or action itself."""
    from urdfkit.app.replay.discovery import Search
    from urdfkit.bus import absolute
    from urdfkit.messages import full_type_name

    subcommand = arguments.subcommand
    if subcommand == "list":
        return Search({"topic": "topics", "service": "services", "action": "actions"}[arguments.command])
    if subcommand == "find":
        return Search(type=full_type_name(arguments.type))
    if arguments.command == "topic" and (subcommand != "pub" or arguments.type is None or is_message(arguments.type)):
        return Search(name=absolute(arguments.topic))
    return None


def is_message(word: str) -> bool:
    """Return whether an argument is a message instead of its type."""
    return word.startswith(("{", "["))


async def topics(client: Client) -> list[Row]:
    """Return the topics, sorted by name; wait for a simulation that is starting, and report that once.

    Raises:
        ResourceError: the page is not a simulation, the list does not arrive, or the simulation has failed.
    """
    await client.subscribe("topics")
    reported = False
    while (text := await client.text(READY)) is not None:
        if text["type"] == "hello" and text["mode"] != "sim":
            raise ResourceError("that page is a viewer without topics; start a simulation: urdfkit sim teleop ROBOT")
        if text["type"] == "progress" and text["label"] and not reported:
            note(f"urdfkit: the simulation is starting: {text['label']}")
            reported = True
        if text["type"] == "fault" and text["message"]:
            raise ResourceError(f"the simulation reports: {text['message']}")
        if text["type"] == "topics":
            await client.subscribe()
            return sorted(
                (Row(name, kind, count, subscribers) for name, kind, count, _, subscribers in text["rows"]),
                key=lambda row: row.name,
            )
    raise ResourceError(f"the simulation has not sent its topics for {READY:g} s; try again when it has started")


def find_topic(rows: Sequence[Row], name: str) -> Row:
    """Return the topic with a name.

    Raises:
        UsageError: the topic is unknown; names the nearest.
    """
    from urdfkit.bus import absolute, similar_topic

    full = absolute(name)
    for row in rows:
        if row.name == full:
            return row
    raise UsageError(f"unknown topic `{full}`{similar_topic(full, [row.name for row in rows])}")


async def messages(
    client: Client, kind: str, topic: str, *, every: float | None = None
) -> AsyncGenerator[list[Any], None]:
    """Yield the messages of a topic in the form of the protocol, without end.

    Args:
        client: the connection.
        kind: the first part of the key: ``times``, ``sizes``, ``messages`` or ``full_messages``.
        topic: name of the topic.
        every: yield an empty list after every such period [s]; None for never.
    """
    key = f"{kind}:{topic}"
    await client.subscribe(key)
    loop = asyncio.get_running_loop()
    due = None if every is None else loop.time() + every
    while True:
        text = await client.text(None if due is None else max(0.0, due - loop.time()))
        if text is not None and text["type"] == "messages" and text["source"] == key:
            for row in text["rows"]:
                yield row
            if text["missed"]:
                note(f"urdfkit: dropped {text['missed']} messages of {topic}: the simulation had no time to send them")
        if due is not None and every is not None and loop.time() >= due:
            due = loop.time() + every
            yield []
