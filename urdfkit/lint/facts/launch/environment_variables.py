"""Environment variables in launch files that are misspelt or that only the other Gazebo reads.

Sources: gz-sim (tutorials/resources.md), gazebo-classic (tutorial "Gazebo components", environment variables) and ROS 2
(documentation of logging and of middleware implementations).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.model.model import Model

_OF_CLASSIC = {
    "GAZEBO_MODEL_PATH": "GZ_SIM_RESOURCE_PATH",
    "GAZEBO_RESOURCE_PATH": "GZ_SIM_RESOURCE_PATH",
    "GAZEBO_PLUGIN_PATH": "GZ_SIM_SYSTEM_PLUGIN_PATH",
}
"""Variable of Gazebo classic → that of gz-sim."""

_OF_GZ = {
    "GZ_SIM_RESOURCE_PATH": "GAZEBO_MODEL_PATH",
    "IGN_GAZEBO_RESOURCE_PATH": "GAZEBO_MODEL_PATH",
    "GZ_SIM_SYSTEM_PLUGIN_PATH": "GAZEBO_PLUGIN_PATH",
    "IGN_GAZEBO_SYSTEM_PLUGIN_PATH": "GAZEBO_PLUGIN_PATH",
}
"""Variable of gz-sim → that of Gazebo classic."""

_OTHERS = (
    *("RMW_IMPLEMENTATION", "ROS_DOMAIN_ID", "RCUTILS_COLORIZED_OUTPUT", "RCUTILS_LOGGING_BUFFERED_STREAM"),
    *("RCUTILS_CONSOLE_OUTPUT_FORMAT", "ROSCONSOLE_FORMAT", "ROSCONSOLE_CONFIG_FILE", "CYCLONEDDS_URI", "SDF_PATH"),
    *("FASTRTPS_DEFAULT_PROFILES_FILE", "GAZEBO_MASTER_URI", "GAZEBO_MODEL_DATABASE_URI", "GZ_PARTITION"),
)
_EVERY = (*_OF_CLASSIC, *_OF_GZ, *_OTHERS)
_NAME = r"[\"']([A-Z][A-Z0-9]+(?:_[A-Z0-9]+)+)[\"']"
_GZ, _CLASSIC = r"\bros_(?:gz_sim|ign_gazebo)\b", r"\bgazebo_ros\b|\bgzserver\b|\blibgazebo_ros_"
"""Matches a launch file that starts gz-sim; the second one, Gazebo classic."""

_FORTRESS = r"\bros_ign_gazebo\b"
"""Matches a launch file for Gazebo Fortress, whose variables start with ``IGN_GAZEBO_``."""


def wrong_variables(model: Model) -> Iterator[tuple[Source, int, str, str]]:
    """Yield file, offset, name and message of each variable that nothing reads.

    A file that sets variables of both versions of Gazebo is written for both.
    """
    files = [source for name, source in model.related_files.items() if name.endswith(LAUNCH)]
    texts = [uncommented(source) for source in files]
    has_gz, has_classic = (any(re.search(pattern, text) for text in texts) for pattern in (_GZ, _CLASSIC))
    for source, text in zip(files, texts, strict=True):
        found = list(re.finditer(_NAME, text))
        names = {each[1] for each in found}
        for each in found:
            name, near = each[1], None
            if name not in _EVERY:
                near = next((other for other in _EVERY if is_slip(name, other)), None)
                message = f"unknown environment variable `{name}`"
            elif name in _OF_CLASSIC and has_gz and not has_classic and names.isdisjoint(_OF_GZ):
                near, message = _OF_CLASSIC[name], f"only Gazebo classic reads `{name}`"
                if any(re.search(_FORTRESS, each) for each in texts):
                    near = near.replace("GZ_SIM_", "IGN_GAZEBO_")
            elif name in _OF_GZ and has_classic and not has_gz and names.isdisjoint(_OF_CLASSIC):
                near, message = _OF_GZ[name], f"Gazebo classic does not read `{name}`"
            if near is not None:
                yield source, each.start(1), name, message + Suggestion(near, name)
