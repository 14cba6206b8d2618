"""A talk with a running simulation: find it, connect, ask for its topics, take their messages as they come."""

from __future__ import annotations

import argparse
import asyncio
from collections.abc import AsyncGenerator, Awaitable, Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import note
from urdfkit.errors import MissingDependencyError, ResourceError, UsageError, did_you_mean

if TYPE_CHECKING:
    from urdfkit.view.protocol.client import Client

READY = 30.0
"""Seconds to wait for the list of topics, which comes twice a second."""


@dataclass(frozen=True, slots=True)
class Row:
    """A topic in the list.

    Attributes:
        name: absolute.
        type: e.g. ``nav_msgs/msg/Odometry``.
        count: messages published so far.
        listeners: in the simulation, and those that this command's like have there.
    """

    name: str
    type: str
    count: int
    listeners: int


def talk(work: Callable[[Client, argparse.Namespace], Awaitable[int]], arguments: argparse.Namespace) -> int:
    """Do some work with a running simulation and return the exit code.

    Raises:
        MissingDependencyError: tornado is not installed.
        ResourceError: no simulation is running, or it does not answer.
    """
    from importlib.util import find_spec

    if find_spec("tornado") is None:
        raise MissingDependencyError("topic needs tornado: pip install 'urdfkit[view]'")
    from urdfkit.view.protocol.client import connect
    from urdfkit.view.server.running_simulations import find

    url = find(arguments.url)

    async def all_of_it() -> int:
        async with await connect(url) as client:
            return await work(client, arguments)

    try:
        return asyncio.run(all_of_it())
    except KeyboardInterrupt:
        return 0


def positive(text: str) -> int:
    """Return a whole number from one on, for an option."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"`{text}` is no whole number from 1 on")
    return int(text)


async def topics(client: Client) -> list[Row]:
    """Return the topics there are, sorted by name; wait for a simulation that is starting, and say so.

    Raises:
        ResourceError: the page has none, the list does not come, or the simulation cannot go on.
    """
    await client.watch("topics")
    said = False
    while (text := await client.text(READY)) is not None:
        if text["type"] == "hello" and text["mode"] != "sim":
            raise ResourceError("that page is a viewer; topics are in a simulation: urdfkit sim teleop MODEL")
        if text["type"] == "progress" and text["label"] and not said:
            note(f"urdfkit: the simulation is starting: {text['label']}")
            said = True
        if text["type"] == "fault" and text["message"]:
            raise ResourceError(f"the simulation says: {text['message']}")
        if text["type"] == "topics":
            await client.watch()
            return sorted(
                (Row(name, kind, count, listeners) for name, kind, count, _, listeners in text["rows"]),
                key=lambda row: row.name,
            )
    raise ResourceError(f"the simulation has not told its topics for {READY:g} s; is it still starting?")


def named(rows: Sequence[Row], name: str) -> Row:
    """Return the topic of this name.

    Raises:
        UsageError: there is none, with the nearest.
    """
    from urdfkit.bus import absolute

    full = absolute(name)
    for row in rows:
        if row.name == full:
            return row
    hint = did_you_mean(full, [row.name for row in rows])
    last = {row.name.rpartition("/")[2]: row.name for row in rows}  # perhaps the robot's name was left out
    if not hint and (near := did_you_mean(full.rpartition("/")[2], last)):
        hint = f"; did you mean `{last[near.split('`')[1]]}`?"
    raise UsageError(f"no topic `{full}`{hint}")


async def messages(
    client: Client, kind: str, topic: str, *, every: float | None = None
) -> AsyncGenerator[list[Any], None]:
    """Yield the messages of a topic as they come, as the protocol has them; ends never.

    Args:
        client: the connection.
        kind: the first part of the key: ``times``, ``sizes``, ``every`` or ``whole``.
        topic: its name.
        every: yield an empty list whenever so many seconds have passed; None for never.
    """
    key = f"{kind}:{topic}"
    await client.watch(key)
    loop = asyncio.get_running_loop()
    due = None if every is None else loop.time() + every
    while True:
        text = await client.text(None if due is None else max(0.0, due - loop.time()))
        if text is not None and text["type"] == "heard" and text["source"] == key:
            for row in text["rows"]:
                yield row
            if text["missed"]:
                note(f"urdfkit: {text['missed']} messages of {topic} missed: there was no time for them")
        if due is not None and every is not None and loop.time() >= due:
            due = loop.time() + every
            yield []
