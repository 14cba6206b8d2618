"""``--record FILE.mcap``: every message of a simulation in one file."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.app.simulation.saved_topics import check_places

if TYPE_CHECKING:
    import argparse

    from urdfkit.sim.simulator import Simulator

LOOK = 0.1
"""Simulated seconds between looks for topics that have come up."""


def add_record(parser: argparse.ArgumentParser) -> None:
    """Add ``--record``."""
    parser.add_argument(
        "--record", metavar="FILE.mcap", help="record every topic, pictures too, for ros2 bag and its relatives"
    )


def check_record(file: str | None) -> None:
    """Refuse a recording that cannot be written, before anything is loaded.

    Args:
        file: of ``--record``; None for none.

    Raises:
        UsageError: it is not called ``.mcap``, or cannot be written where it is.
    """
    if file is None:
        return
    from urdfkit.bridges.recorder import check_name

    check_name(Path(file))
    check_places("--record", [Path(file)])


@contextmanager
def recording(simulator: Simulator, file: str | None, *, quiet: bool = False) -> Iterator[Callable[[], None]]:
    """Record while inside; what is yielded looks for topics that have come up.

    Args:
        simulator: whose messages.
        file: where to; None records nothing.
        quiet: do not say what was recorded.

    Raises:
        UrdfkitError: the file cannot be written.
    """
    if file is None:
        yield lambda: None
        return
    from urdfkit.bridges.recorder import Recorder

    recorder = Recorder(simulator.bus, file, lambda: simulator.t)
    try:
        yield recorder.look
    finally:  # what was recorded is kept, whatever ended it
        recorder.look()
        recorder.close()
        if not quiet:
            print(f"urdfkit: recorded {recorder.count} messages of {recorder.topics} topics to {file}", file=sys.stderr)
