"""``urdfkit topic hz`` and ``urdfkit topic bw``: measure rate and size of messages.

Rates are per second of simulated time, which does not depend on the speed of the machine; ``--wall-time`` uses the
clock of the machine that runs the simulation.
"""

from __future__ import annotations

import argparse
import json
import math
from collections import deque
from contextlib import aclosing
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from urdfkit.cli.parser import count
from urdfkit.cli.topic.connection import find_topic, messages, topics

if TYPE_CHECKING:
    from urdfkit.view.protocol.client import Client

PERIOD = 1.0
"""Seconds between two reports."""
WINDOWS = {"hz": 10_000, "bw": 100}
"""Maximum number of messages in a measurement; the defaults of ros2 topic."""


@dataclass(frozen=True, slots=True)
class Statistics:
    """Statistics of periods or sizes.

    Attributes:
        rate: messages per second, or bytes per second.
        mean: mean of the periods [s] or of the sizes [byte]; `min`, `max` and `std` likewise.
        std: standard deviation of the population, not of a sample.
        window: number of messages.
    """

    rate: float
    mean: float
    min: float
    max: float
    std: float
    window: int


class Window:
    """The last messages of a topic.

    Args:
        size: maximum number of messages.
    """

    def __init__(self, size: int) -> None:
        self._messages: deque[tuple[float, int]] = deque(maxlen=size)
        self.new = 0

    def add(self, t: float, size: int = 0) -> None:
        """Add a message; start again when time decreases, as after a reset."""
        if self._messages and t < self._messages[-1][0]:
            self._messages.clear()
        self._messages.append((t, size))
        self.new += 1

    def periods(self) -> Statistics | None:
        """Return rate [Hz] and periods [s]; None before the second message."""
        times = [t for t, _ in self._messages]
        spans = [later - earlier for earlier, later in pairwise(times)]
        if not spans or times[-1] == times[0]:
            return None
        return _statistics(len(spans) / (times[-1] - times[0]), spans, len(times))

    def sizes(self) -> Statistics | None:
        """Return bytes per second and sizes [byte]; None before the second message."""
        if len(self._messages) < 2 or self._messages[-1][0] == self._messages[0][0]:
            return None
        sizes = [float(size) for _, size in self._messages]
        # N messages span N - 1 periods; the bytes of the first message belong to the period before it.
        rate = sum(sizes[1:]) / (self._messages[-1][0] - self._messages[0][0])
        return _statistics(rate, sizes, len(sizes))


def _statistics(rate: float, values: list[float], window: int) -> Statistics:
    mean = math.fsum(values) / len(values)
    std = math.sqrt(math.fsum((value - mean) ** 2 for value in values) / len(values))
    return Statistics(rate, mean, min(values), max(values), std, window)


def configure(parser: argparse.ArgumentParser, name: str) -> None:
    """Add the arguments."""
    parser.add_argument("topic", metavar="TOPIC", help="name of the topic")
    parser.add_argument(
        "-w",
        "--window",
        type=count(),
        default=WINDOWS[name],
        metavar="N",
        help=f"measure the last N messages (default: {WINDOWS[name]})",
    )
    parser.add_argument("--wall-time", action="store_true", help="use wall-clock time instead of simulated time")
    parser.add_argument("-n", "--number", type=count(), metavar="N", help="exit after N reports, one per second")
    parser.add_argument("--once", action="store_true", help="exit after one report")
    parser.add_argument("--json", action="store_true", help="print each report as JSON on one line")
    parser.epilog = f"examples:\n  urdfkit topic {name} /odom\n  urdfkit topic {name} /scan --window 50 --once"


async def run(client: Client, arguments: argparse.Namespace) -> int:
    """Print a report every second in which a message arrives."""
    is_hz = arguments.subcommand == "hz"
    row = find_topic(await topics(client), arguments.topic)
    number = 1 if arguments.once else arguments.number
    window = Window(max(2, arguments.window))
    printed = 0
    async with aclosing(messages(client, "times" if is_hz else "sizes", row.name, every=PERIOD)) as received:
        async for each in received:
            if each:
                window.add(each[1 if arguments.wall_time else 0], 0 if is_hz else each[2])
                continue
            measured = (window.periods() if is_hz else window.sizes()) if window.new else None
            window.new = 0
            if measured is None:
                if not arguments.json:
                    print("no new messages", flush=True)
                continue
            print(json.dumps(asdict(measured)) if arguments.json else report(measured, is_hz=is_hz), flush=True)
            printed += 1
            if printed == number:
                break
    return 0


def report(values: Statistics, *, is_hz: bool) -> str:
    """Return a report as ``rostopic hz`` or ``rostopic bw`` prints it."""
    if is_hz:
        return (
            f"average rate: {values.rate:.3f}\n\tmin: {values.min:.3f}s max: {values.max:.3f}s "
            f"std dev: {values.std:.5f}s window: {values.window}"
        )
    unit, name = next(((unit, name) for unit, name in ((1e6, "MB"), (1e3, "KB")) if values.rate >= unit), (1.0, "B"))
    mean, least, most, std = (
        f"{number / unit:.2f}{name}" for number in (values.mean, values.min, values.max, values.std)
    )
    return (
        f"average: {values.rate / unit:.2f}{name}/s\n\tmean: {mean} min: {least} max: {most} "
        f"std dev: {std} window: {values.window}"
    )
