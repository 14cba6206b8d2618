"""Releases of Gazebo and ROS 2 that the files of a robot name."""

from __future__ import annotations

import re

from urdfkit.lint.project.target_platform import WITHOUT_CLASSIC

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from urdfkit.description.xml.source import Source
    from urdfkit.lint.model.model import Model

_OF_FORTRESS = r"\bignition-gazebo-|\bignition::gazebo\b|\bign_ros2_control\b"
_AFTER_FORTRESS = r"\bgz-sim-|\bgz::sim::|\bgz_ros2_control\b"
"""Match plugins of Gazebo Fortress, and those of later releases (gz-sim Migration.md)."""

_FROM_JAZZY = r"(?i)\b(?:jazzy|kilted|lyrical|harmonic|ionic|jetty)\b"
_BEFORE_JAZZY = r"(?i)\b(?:foxy|galactic|humble|iron|fortress|garden)\b"
"""Match the releases since ROS 2 Jazzy and Gazebo Harmonic, and those before (REP-2000)."""


def is_of_fortress(model: Model) -> bool:
    """Return whether the robot is for Gazebo Fortress, by its target or else by all of its plugins."""
    if model.release:
        return model.release in ("fortress", "humble")
    return _matches(model.expanded.sources.values(), _OF_FORTRESS, _AFTER_FORTRESS)


def is_since_jazzy(model: Model) -> bool:
    """Return whether the robot is for ROS 2 Jazzy or later, by its target or else by the names in related files."""
    if model.release:
        return model.release in WITHOUT_CLASSIC
    return _matches(model.related_files.values(), _FROM_JAZZY, _BEFORE_JAZZY)


def _matches(sources: Iterable[Source], wanted: str, other: str) -> bool:
    """Return whether a text matches the first pattern, and none the second."""
    texts = [source.text for source in sources]
    return any(re.search(wanted, each) for each in texts) and not any(re.search(other, each) for each in texts)
