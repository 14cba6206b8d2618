"""What ``sim run --save-…`` has in common: which topic is meant."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from urdfkit.bus import absolute
from urdfkit.description.packages.resolver import near_path
from urdfkit.errors import UsageError, did_you_mean

if TYPE_CHECKING:
    from urdfkit.sim.simulator import Simulator


class TopicFile(NamedTuple):
    """``TOPIC=FILE``: what to save where; the topic is empty where it is left out."""

    topic: str
    file: Path


SAVED_BY = {
    "sensor_msgs/msg/Image": ("--save-image", "pictures"),
    "sensor_msgs/msg/LaserScan": ("--save-scan", "scans"),
    "sensor_msgs/msg/PointCloud2": ("--save-scan", "points"),
}
"""Type of messages → the option that saves them, and what they are called."""


def check_places(option: str, files: Iterable[Path]) -> None:
    """Refuse what cannot be written, before anything is computed.

    Args:
        option: such as ``--save-image``.
        files: to be written.

    Raises:
        UsageError: there is no such folder, nothing may be written there, or a folder has the file's name.
    """
    for file in files:
        folder = file.parent
        if file.is_dir():
            raise UsageError(f"{option}: {file} is a folder")
        if not folder.is_dir():
            raise UsageError(f"{option}: cannot write {file}: no folder {folder}{near_path(folder)}")
        if not os.access(folder, os.W_OK | os.X_OK):
            raise UsageError(f"{option}: cannot write {file}: nothing may be written into {folder}")


def find_topics(
    simulator: Simulator, wanted: Sequence[TopicFile], *, option: str, types: Sequence[str], what: str, suffix: str
) -> list[tuple[str, Path]]:
    """Return the topic and the file of each use of an option.

    Args:
        simulator: where to look.
        wanted: what was asked for.
        option: such as ``--save-image``.
        types: of messages that can be saved.
        what: these are called.
        suffix: of the file.

    Raises:
        UsageError: there is no such topic, it carries something else, or none is named and there are several.
    """
    carries = {topic.name: topic.type for topic in simulator.bus.topics}
    there = [name for name, kind in carries.items() if kind in types]

    def topic(name: str) -> str:
        if name:
            if absolute(name) not in there:
                kind = carries.get(absolute(name), "")
                if kind in SAVED_BY:
                    right, come = SAVED_BY[kind]
                    raise UsageError(f"{option}: {come} come on {absolute(name)}, not {what}; save them by {right}")
                hint = did_you_mean(absolute(name), there) or (f"; there are {', '.join(there)}" if there else "")
                hint = hint or did_you_mean(absolute(name), [each for each, of in carries.items() if of in SAVED_BY])
                raise UsageError(f"{option}: no {what} come on {absolute(name)}{f', but {kind}' if kind else ''}{hint}")
            return absolute(name)
        if len(there) != 1:
            found = f"there are {', '.join(there)}" if there else "nothing here publishes any"
            raise UsageError(f"{option}: say which {what}, TOPIC=FILE{suffix}; {found}")
        return there[0]

    return [(topic(each.topic), each.file) for each in wanted]
