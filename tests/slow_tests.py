"""A pytest plugin: what each test costs in CPU time, and whether the mark ``slow`` tells the truth.

``--cpu-times=FILE`` writes a line for each test: seconds of CPU time of this process and of the programs that it waited
for, and the test's name. The summary then prints the sum and lists the tests whose mark is wrong. It works in several
processes too (``-n 2``) and never fails a run: time on a shared machine is no verdict.
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

SLOW = 0.5
"""CPU time from which a test is slow [s]; ``make quick`` leaves it out."""
MARGIN = 2.0
"""A mark is wrong where the time is this many times above or below `SLOW`."""

seconds: defaultdict[str, float] = defaultdict(float)
marked: set[str] = set()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add ``--cpu-times``."""
    parser.addoption("--cpu-times", metavar="FILE", type=Path, help="write the CPU time of each test into a file")


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Measure setup, call and teardown of a test."""
    before = cpu_time()
    try:
        return (yield)
    finally:
        seconds[item.nodeid] += cpu_time() - before
        if item.get_closest_marker("slow"):
            marked.add(item.nodeid)


def cpu_time() -> float:
    """Return the CPU time of this process and of the programs that it has waited for [s]."""
    return sum(os.times()[:4])


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Send the times from a process of pytest-xdist."""
    if (output := getattr(session.config, "workeroutput", None)) is not None:
        output["cpu_times"] = dict(seconds), sorted(marked)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """Receive the times of a process of pytest-xdist, unless it crashed."""
    times, names = getattr(node, "workeroutput", {}).get("cpu_times", ({}, []))
    seconds.update(times)
    marked.update(names)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Write the times, and list the tests whose mark is wrong."""
    file: Path | None = config.getoption("--cpu-times")
    if file is None:
        return
    file.write_text(
        "".join(f"{time:.2f} {name}\n" for name, time in sorted(seconds.items(), key=lambda item: -item[1]))
    )
    terminalreporter.write_line(f"CPU time of {len(seconds)} tests: {sum(seconds.values()):.0f} s")
    for line in wrong_marks(seconds, marked):
        terminalreporter.write_line(line)


def wrong_marks(seconds: dict[str, float], marked: set[str]) -> list[str]:
    """Return a line for each test function that wants the mark ``slow``, or has it without need.

    The mark stands on a function, so the slowest of its cases decides.
    """
    slowest: dict[str, float] = {}
    for name, time in seconds.items():
        function = name.partition("[")[0]
        slowest[function] = max(time, slowest.get(function, 0.0))
    is_marked = {name.partition("[")[0] for name in marked}
    return [
        f"{name}: {time:.1f} s of CPU time, {'not slow' if name in is_marked else 'slow'}"
        for name, time in sorted(slowest.items())
        if (time < SLOW / MARGIN if name in is_marked else time > SLOW * MARGIN)
    ]
