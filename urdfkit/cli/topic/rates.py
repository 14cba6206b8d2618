"""``urdfkit topic hz`` and ``urdfkit topic bw``: how often messages come and how long they are.

Time is simulated time, so that what is printed is the robot's and not the machine's; ``--wall-time`` takes the clock of
the machine on which the simulation runs.
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

from urdfkit.cli.topic.connection import messages, named, positive, topics

if TYPE_CHECKING:
    from urdfkit.view.protocol.client import Client

PERIOD = 1.0
"""Seconds between two lines."""
WINDOWS = {"hz": 10_000, "bw": 100}
"""Messages looked at, at most; the defaults of ros2 topic."""


@dataclass(frozen=True, slots=True)
class Figures:
    """What is known of some numbers.

    Attributes:
        rate: messages per second, or bytes per second.
        mean: of the periods [s], or of the lengths [byte]; so are the others.
        std: standard deviation of all of them, not an estimate of what they are samples of.
        window: messages looked at.
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
        size: how many.
    """

    def __init__(self, size: int) -> None:
        self._seen: deque[tuple[float, int]] = deque(maxlen=size)
        self.came = 0

    def add(self, t: float, size: int = 0) -> None:
        """Take note of a message; time that goes back, as at a reset, begins anew."""
        if self._seen and t < self._seen[-1][0]:
            self._seen.clear()
        self._seen.append((t, size))
        self.came += 1

    def periods(self) -> Figures | None:
        """Return rate [Hz] and periods [s]; None before the second message."""
        times = [t for t, _ in self._seen]
        spans = [later - earlier for earlier, later in pairwise(times)]
        if not spans or times[-1] == times[0]:
            return None
        return _figures(len(spans) / (times[-1] - times[0]), spans, len(times))

    def sizes(self) -> Figures | None:
        """Return bytes per second and lengths [byte]; None before the second message."""
        if len(self._seen) < 2 or self._seen[-1][0] == self._seen[0][0]:
            return None
        sizes = [float(size) for _, size in self._seen]
        # So many messages began so many periods less one; the first one's bytes belong to the period before it.
        rate = sum(sizes[1:]) / (self._seen[-1][0] - self._seen[0][0])
        return _figures(rate, sizes, len(sizes))


def _figures(rate: float, values: list[float], window: int) -> Figures:
    mean = math.fsum(values) / len(values)
    std = math.sqrt(math.fsum((value - mean) ** 2 for value in values) / len(values))
    return Figures(rate, mean, min(values), max(values), std, window)


def configure(parser: argparse.ArgumentParser, name: str) -> None:
    """Add the arguments."""
    parser.add_argument("topic", metavar="TOPIC", help="name of the topic")
    parser.add_argument(
        "-w",
        "--window",
        type=positive,
        default=WINDOWS[name],
        metavar="N",
        help=f"look at the last N messages (default: {WINDOWS[name]})",
    )
    parser.add_argument("--wall-time", action="store_true", help="measure by the machine's clock")
    parser.add_argument("-n", "--number", type=positive, metavar="N", help="end after N reports, one a second")
    parser.add_argument("--once", action="store_true", help="end after one report")
    parser.add_argument("--json", action="store_true", help="print one JSON value a line for each report")
    parser.epilog = f"examples:\n  urdfkit topic {name} /odom\n  urdfkit topic {name} /scan --window 50 --once"


async def run(client: Client, arguments: argparse.Namespace) -> int:
    """Print a report every second; a second without a message is no report."""
    is_hz = arguments.subcommand == "hz"
    row = named(await topics(client), arguments.topic)
    number = 1 if arguments.once else arguments.number
    window = Window(max(2, arguments.window))
    printed = 0
    async with aclosing(messages(client, "times" if is_hz else "sizes", row.name, every=PERIOD)) as heard:
        async for each in heard:
            if each:
                window.add(each[1 if arguments.wall_time else 0], 0 if is_hz else each[2])
                continue
            found = (window.periods() if is_hz else window.sizes()) if window.came else None
            window.came = 0
            if found is None:
                if not arguments.json:
                    print("no new messages", flush=True)
                continue
            print(json.dumps(asdict(found)) if arguments.json else report(found, is_hz=is_hz), flush=True)
            printed += 1
            if printed == number:
                break
    return 0


def report(found: Figures, *, is_hz: bool) -> str:
    """Return a report as ``rostopic hz`` or ``rostopic bw`` prints it."""
    if is_hz:
        return (
            f"average rate: {found.rate:.3f}\n\tmin: {found.min:.3f}s max: {found.max:.3f}s "
            f"std dev: {found.std:.5f}s window: {found.window}"
        )
    unit, name = next(((unit, name) for unit, name in ((1e6, "MB"), (1e3, "KB")) if found.rate >= unit), (1.0, "B"))
    mean, least, most, std = (f"{value / unit:.2f}{name}" for value in (found.mean, found.min, found.max, found.std))
    return (
        f"average: {found.rate / unit:.2f}{name}/s\n\tmean: {mean} min: {least} max: {most} "
        f"std dev: {std} window: {found.window}"
    )
