"""Selection of the topic for options ``sim run --save-…``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from urdfkit.bus import absolute
from urdfkit.errors import UsageError, did_you_mean

if TYPE_CHECKING:
    from urdfkit.sim.simulator import Simulator


class TopicFile(NamedTuple):
    """``TOPIC=FILE``: what to save where; the topic is empty if it is omitted."""

    topic: str
    file: Path


SAVED_BY = {
    "sensor_msgs/msg/Image": ("--save-image", "images"),
    "sensor_msgs/msg/LaserScan": ("--save-scan", "scans"),
    "sensor_msgs/msg/PointCloud2": ("--save-scan", "points"),
}
"""Type of messages → the option that saves them, and the name of their content."""


def find_topics(
    simulator: Simulator, wanted: Sequence[TopicFile], *, option: str, types: Sequence[str], what: str, suffix: str
) -> list[tuple[str, Path]]:
    """Return topic and file of each use of an option.

    Args:
        simulator: simulator with the topics.
        wanted: values of the option.
        option: name of the option, such as ``--save-image``.
        types: types of messages that the option can save.
        what: name of their content.
        suffix: suffix of the file.

    Raises:
        UsageError: the topic is unknown or has another type, or none is named and several are possible.
    """
    type_by_topic = {topic.name: topic.type for topic in simulator.bus.topics}
    candidates = [name for name, kind in type_by_topic.items() if kind in types]

    def topic(name: str) -> str:
        if name:
            if absolute(name) not in candidates:
                kind = type_by_topic.get(absolute(name), "")
                if kind in SAVED_BY:
                    right_option, content = SAVED_BY[kind]
                    raise UsageError(f"{option}: {absolute(name)} carries {content}, not {what}; use {right_option}")
                hint = did_you_mean(absolute(name), candidates) or (
                    f"; topics with {what}: {', '.join(candidates)}" if candidates else ""
                )
                hint = hint or did_you_mean(
                    absolute(name), [each for each, of in type_by_topic.items() if of in SAVED_BY]
                )
                problem = f"{absolute(name)} carries {kind}, not {what}" if kind else f"unknown topic {absolute(name)}"
                raise UsageError(f"{option}: {problem}{hint}")
            return absolute(name)
        if len(candidates) != 1:
            available = f"topics with {what}: {', '.join(candidates)}" if candidates else f"no topic contains {what}"
            raise UsageError(f"{option}: select a topic with TOPIC=FILE{suffix}; {available}")
        return candidates[0]

    return [(topic(each.topic), each.file) for each in wanted]
