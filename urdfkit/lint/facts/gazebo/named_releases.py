"""Releases of ROS 2 that the files of a robot name."""

from __future__ import annotations

import re

from urdfkit.lint.project.target_platform import WITHOUT_CLASSIC

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.model.model import Model

_FROM_JAZZY = r"(?i)\b(?:jazzy|kilted|lyrical|harmonic|ionic|jetty|default_planning_request_adapters)\b"
_BEFORE_JAZZY = r"(?i)\b(?:foxy|galactic|humble|iron|fortress|garden|default_planner_request_adapters)\b"
"""Match the releases since ROS 2 Jazzy and Gazebo Harmonic, and those before (REP-2000).

MoveIt's package of request adapters has another name since Jazzy (moveit2, MIGRATION.md).
"""


def is_since_jazzy(model: Model) -> bool:
    """Return whether the robot is for ROS 2 Jazzy or later, by its target or else by the names in related files."""
    if model.release:
        return model.release in WITHOUT_CLASSIC
    texts = [source.text for source in model.related_files.values()]
    since, before = (any(re.search(each, text) for text in texts) for each in (_FROM_JAZZY, _BEFORE_JAZZY))
    return since and not before
