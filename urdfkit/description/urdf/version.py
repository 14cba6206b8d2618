"""Version of a URDF: the attribute ``version`` of ``<robot>``, and what each version adds.

Source: urdfdom 6.0 (urdf_parser.h, pose.cpp, link.cpp, joint.cpp). It ignores attributes of a later version than the
robot's, drops a capsule from URDF 1.0, and refuses a robot of an unknown version.
"""

import re

from urdfkit.description.xml.element import Element

Version = tuple[int, int]
"""Major and minor number."""

VERSIONS: tuple[Version, ...] = ((1, 0), (1, 1), (1, 2))
"""The versions of URDF, oldest first."""

QUATERNION: Version = (1, 1)
"""First version with ``quat_xyzw``."""
CAPSULE: Version = (1, 1)
"""First version with ``<capsule>``."""
RATE_LIMITS: Version = (1, 2)
"""First version with limits of acceleration, deceleration and jerk, and with optional limits of effort and velocity."""

RATES = ("acceleration", "deceleration", "jerk")
"""Attributes of ``<limit>`` since `RATE_LIMITS`."""

FIRST_VERSIONS = {"quat_xyzw": QUATERNION, "capsule": CAPSULE, **dict.fromkeys(RATES, RATE_LIMITS)}
"""Attributes and elements of later versions → the first version that has them."""


def written_version(root: Element) -> Version | None:
    """Return the version of a robot as in its attribute, 1.0 without attribute; None if it is not of the form x.y."""
    text = root.attributes.get("version")
    if text is None:
        return VERSIONS[0]
    parts = re.fullmatch(r"([0-9]{1,9})\.([0-9]{1,9})", text)
    return (int(parts[1]), int(parts[2])) if parts is not None else None


def version_of(root: Element) -> Version:
    """Return the version that a robot is read with: the nearest known one if its own is unknown."""
    version = written_version(root)
    if version is None:
        number = re.match(r"\s*([0-9]{1,9})(?:\.([0-9]{1,9}))?", root.attributes["version"])
        version = (int(number[1]), int(number[2] or 0)) if number is not None else VERSIONS[0]
    return min(max(version, VERSIONS[0]), VERSIONS[-1])


def shown(version: Version) -> str:
    """Return a version as text."""
    return f"{version[0]}.{version[1]}"
