"""``--record FILE.mcap``: record every message of a simulation in one file."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.app.simulation.save_options import check_places

if TYPE_CHECKING:
    import argparse

    from urdfkit.sim.simulator import Simulator

NEW_TOPIC_PERIOD = 0.1
"""Simulated seconds between two checks for new topics."""


def add_record(parser: argparse.ArgumentParser) -> None:
    """Add ``--record``."""
    parser.add_argument(
        "--record", metavar="FILE.mcap", help="record every topic, including images, as MCAP for ros2 bag and Foxglove"
    )


def check_record(file: str | None) -> None:
    """Reject a recording that cannot be written, before a robot is loaded.

    Args:
        file: value of ``--record``; None without the option.

    Raises:
        UsageError: the suffix is not ``.mcap``, or the file cannot be written.
    """
    if file is None:
        return
    from urdfkit.bridges.recorder import check_name

    check_name(Path(file))
    check_places("--record", [Path(file)])


@contextmanager
def recording(simulator: Simulator, file: str | None, *, quiet: bool = False) -> Iterator[Callable[[], None]]:
    """Record inside the context; yield a function that subscribes to new topics.

    Args:
        simulator: the source of the messages.
        file: the file to write; None to record nothing.
        quiet: do not print a summary.

    Raises:
        UrdfkitError: the file cannot be written.
    """
    if file is None:
        yield lambda: None
        return
    from urdfkit.bridges.recorder import Recorder

    recorder = Recorder(simulator.bus, file, lambda: simulator.t)
    try:
        yield recorder.subscribe_new_topics
    finally:  # keep the recording after an error too
        recorder.subscribe_new_topics()
        recorder.close()
        if not quiet:
            print(f"urdfkit: recorded {recorder.count} messages of {recorder.topics} topics to {file}", file=sys.stderr)
