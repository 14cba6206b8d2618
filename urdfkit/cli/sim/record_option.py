"""``--record FILE.mcap`` and the options of the recording."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.atomic import check_output_files
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.bridges.recording_options import RecordingOptions
    from urdfkit.sim.simulator import Simulator

NEW_TOPIC_PERIOD = 0.1
"""Simulated seconds between two checks for new topics."""


def add_record(parser: argparse.ArgumentParser) -> None:
    """Add ``--record`` and the options of the recording."""
    parser.add_argument(
        "--record",
        metavar="FILE.mcap",
        help="record topics, including images, as MCAP for ros2 bag and Foxglove, losslessly compressed",
    )
    group = parser.add_argument_group("options of --record")
    group.add_argument(
        "--topics",
        action="append",
        default=[],
        metavar="GLOB",
        help='record only topics that match GLOB, e.g. "/scan*" (repeatable; default: all)',
    )
    group.add_argument(
        "--exclude",
        action="append",
        default=[],
        metavar="GLOB",
        help="do not record topics that match GLOB (repeatable)",
    )
    group.add_argument("--no-compression", action="store_true", help="do not compress the file")
    group.add_argument(
        "--jpeg",
        nargs="?",
        type=_quality,
        const=0,
        metavar="QUALITY",
        help="record colour and grey images as JPEG, on TOPIC/compressed (quality 1 to 95, default 90)",
    )
    group.add_argument(
        "--split",
        type=_split,
        metavar="LIMIT",
        help="start a new file (FILE_1.mcap, FILE_2.mcap, …) after this duration or size, e.g. 30s, 5min or 500MB",
    )


def check_record(arguments: argparse.Namespace) -> None:
    """Reject a recording that cannot be written, and options without one, before a robot is loaded.

    Args:
        arguments: with the options of `add_record`.

    Raises:
        UsageError: the suffix is not ``.mcap``, the file cannot be written, or there are options without ``--record``.
    """
    if arguments.record is None:
        options = {
            "--topics": arguments.topics,
            "--exclude": arguments.exclude,
            "--no-compression": arguments.no_compression,
            "--jpeg": arguments.jpeg is not None,
            "--split": arguments.split,
        }
        for option, value in options.items():
            if value:
                raise UsageError(f"{option} is an option of a recording: add --record FILE.mcap")
        return
    from urdfkit.bridges.recorder import check_name

    check_name(Path(arguments.record))
    check_output_files("--record", [Path(arguments.record)])


@contextmanager
def recording(simulator: Simulator, arguments: argparse.Namespace) -> Iterator[Callable[[], None]]:
    """Record inside the context; yield a function that subscribes to new topics.

    Args:
        simulator: the source of the messages.
        arguments: with the options of `add_record`; nothing is recorded without ``--record``.

    Raises:
        UrdfkitError: the file cannot be written.
    """
    if arguments.record is None:
        yield lambda: None
        return
    from urdfkit.app.simulation.bridging.description_text import publish_description
    from urdfkit.bridges.recorder import Recorder

    publish_description(simulator)
    recorder = Recorder(simulator.bus, arguments.record, lambda: simulator.t, _options(arguments))
    try:
        yield recorder.subscribe_new_topics
    finally:  # keep the recording after an error too
        recorder.subscribe_new_topics()
        recorder.close()
        for text in recorder.options.unused(topic.name for topic in simulator.bus.topics):
            print(f"urdfkit: warning: {text}", file=sys.stderr)
        if not arguments.quiet:
            files = recorder.files
            where = f"{files[0]}" if len(files) == 1 else f"{len(files)} files, {files[0]} to {files[-1].name}"
            print(
                f"urdfkit: recorded {recorder.count} messages of {recorder.topics} topics to {where}", file=sys.stderr
            )


def _options(arguments: argparse.Namespace) -> RecordingOptions:
    from urdfkit.bridges.recording_options import JPEG_QUALITY, RecordingOptions

    return RecordingOptions(
        topics=tuple(arguments.topics),
        exclude=tuple(arguments.exclude),
        compression=not arguments.no_compression,
        jpeg=None if arguments.jpeg is None else arguments.jpeg or JPEG_QUALITY,
        **(arguments.split or {}),
    )


def _quality(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text) <= 95:
        raise argparse.ArgumentTypeError(f"`{text}` is not a quality from 1 to 95")
    return int(text)


def _split(text: str) -> dict[str, float]:
    from urdfkit.bridges.recording_options import parse_split

    try:
        return parse_split(text)
    except UsageError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
