"""What a robot is meant for, guessed from the package.xml of its package."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.record import record

TARGETS = ("ros1", "ros2", "gz", "classic", "mujoco", "isaac", "drake", "moveit", "urdfkit")
"""Consumers that ``--target`` may name; without one every rule counts that holds for any of them."""

DISTROS: dict[str, tuple[str, ...]] = {
    "ros1": ("hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic"),
    "ros2": ("foxy", "galactic", "humble", "iron", "jazzy", "kilted", "lyrical", "rolling"),
    "gz": ("citadel", "edifice", "fortress", "garden", "harmonic", "ionic", "jetty"),
    "classic": ("7", "8", "9", "10", "11"),
}
"""Target → its releases, oldest first (REP-3, REP-2000, gazebosim.org/docs/all/releases)."""

WITHOUT_CLASSIC = frozenset(("jazzy", "kilted", "lyrical", "rolling"))
"""Releases of ROS 2 that have neither Gazebo classic nor its plugins (rosdistro#40759 and #41224)."""

_COMMENT = r"(?s)<!--.*?(?:-->|\Z)"
_BUILD = r"<build(?:tool_depend|_type)\b[^>]*>\s*([\w.-]+)\s*<"
_NEEDS = r"<(?:\w*depend|name)\b[^>]*>\s*([\w.-]+)\s*<"

_ROS = {
    "catkin": "ros1",
    "ament_cmake": "ros2",
    "ament_cmake_auto": "ros2",
    "ament_cmake_python": "ros2",
    "ament_python": "ros2",
}
"""Build tool or type → the ROS that has it (REP-149, and the build types of colcon)."""

_ONLY_ROS = {
    "roslaunch": "ros1",
    "rospy": "ros1",
    "roscpp": "ros1",
    "launch_ros": "ros2",
    "rclpy": "ros2",
    "rclcpp": "ros2",
}
"""Packages of one ROS only: they count where the build tool says nothing."""

_NEW_GAZEBO = ("ros_gz", "gz_ros2_control", "ign_ros2_control", "ros_ign", "gz_sim_vendor", "gz-sim", "ignition-gazebo")
_CLASSIC = ("gazebo_ros", "gazebo_plugins", "gazebo_ros2_control", "gazebo_dev", "gazebo_rosdev")


@record
class Guess:
    """What a package is for.

    Attributes:
        target: ``ros1``, ``ros2``, ``gz``, or None where package.xml does not tell, or tells of several.
        why: what it was guessed from, for the reader.
        manifest: the package.xml; None where there is none.
    """

    target: str | None
    why: str
    manifest: Path | None


def guess(path: Path) -> Guess:
    """Guess the target of a description file from the package.xml above it.

    A package that needs the new Gazebo and not the classic one is for ``gz``; else the build tool tells ROS 1 and 2.
    """
    above = (folder / "package.xml" for folder in path.absolute().parents)
    manifest = next((file for file in above if file.is_file()), None)
    if manifest is None:
        return Guess(None, "no package.xml", None)
    try:
        text = re.sub(_COMMENT, "", manifest.read_text("utf-8", "replace"))
    except OSError:
        return Guess(None, "package.xml cannot be read", None)
    needs = re.findall(_NEEDS, text)
    new = next((name for name in needs if name.startswith(_NEW_GAZEBO)), None)
    if new is not None and not any(name.startswith(_CLASSIC) for name in needs):
        return Guess("gz", f"depends on {new}", manifest)
    tools = [name for name in re.findall(_BUILD, text) if name in _ROS]
    versions = {_ROS[tool] for tool in tools}
    if len(versions) == 1:
        return Guess(versions.pop(), f"is built with {tools[0]}", manifest)
    known = [name for name in needs if name in _ONLY_ROS]
    others = {_ONLY_ROS[name] for name in known}
    if not versions and len(others) == 1:
        return Guess(others.pop(), f"depends on {known[0]}", manifest)
    return Guess(None, "is for ROS 1 and ROS 2" if len(versions | others) > 1 else "names no build tool", manifest)


def known_target(name: str | None, option: str = "--target") -> str | None:
    """Return the name of a target, which may name a release: ``ros2`` or ``ros2-jazzy``; a release alone will do.

    Case does not count, nor what stands between the two, and other names of the same are known: ``Ignition``,
    ``gazebo11``, ``ros_noetic``.

    Args:
        name: as the user gave it; None for none.
        option: what gave it.

    Raises:
        UsageError: there is none of that name, or several.
    """
    if name is None or name in TARGETS:
        return name
    written = re.sub(r"[\s_-]+", "-", name.strip().lower())
    family, distro = _split(written)
    found = f"{family}-{distro}" if distro else family
    if found in TARGETS or distro in DISTROS.get(family, ()):
        return found
    from urdfkit.errors import UsageError, did_you_mean

    if written in _SEVERAL:
        raise UsageError(f"{option} {name} is not known: {_SEVERAL[written]}?")
    releases = {one: known for known, distros in DISTROS.items() for one in distros}
    if distro and family in DISTROS and ("-" in written or distro.isdecimal()):
        others = {} if distro.isdecimal() else releases
        hint = did_you_mean(distro, DISTROS[family]) or did_you_mean(distro, others)
        near = hint.partition("`")[2].partition("`")[0]
        said = f"; did you mean `{releases[near]}-{near}`?" if near else f"; {family} has {', '.join(DISTROS[family])}"
        raise UsageError(f"{option} {name} is not known{said}")
    names = (one for one in releases if not one.isdecimal())
    hint = did_you_mean(written, (*TARGETS, *names, *(f"{known}-{one}" for one, known in releases.items())))
    families = f"; one of {', '.join(TARGETS)}"
    raise UsageError(f"{option} {name} is not known{hint or families}")


def _split(written: str) -> tuple[str, str]:
    """Return family and release of a name in lower case; the family may be what is written, and the release empty."""
    if written in TARGETS or written in _SAME:
        return _SAME.get(written, written), ""
    releases = {one: known for known, distros in DISTROS.items() for one in distros}
    known = "|".join(sorted((*TARGETS, *_SAME, *_SEVERAL), key=len, reverse=True))
    parts = re.fullmatch(rf"({known})-?([a-z]+|\d+)", written)
    family, distro = (_SAME.get(parts[1], parts[1]), parts[2]) if parts else (written, "")
    if family in _SEVERAL and distro in releases:  # `gazebo` and `ros` are told apart by their releases
        return releases[distro], distro
    if not distro and written in releases and not written.isdecimal():
        return releases[written], written
    return family, distro


_SAME = {
    "ros-1": "ros1",
    "ros-2": "ros2",
    "ign": "gz",
    "ignition": "gz",
    "gz-sim": "gz",
    "gazebo-sim": "gz",
    "gazebo-classic": "classic",
    "isaac-sim": "isaac",
    "isaacsim": "isaac",
    "moveit2": "moveit",
}
"""Other names of targets."""

_SEVERAL = {"gazebo": "`gz`, the new Gazebo, or `classic`", "ros": "`ros1` or `ros2`"}
"""Names of several targets, told apart by a release."""


def family_of(target: str | None) -> str | None:
    """Return the target without its release."""
    return target.partition("-")[0] if target is not None else None


def release_of(target: str | None) -> str:
    """Return the release that a target names; empty where it names none."""
    return target.partition("-")[2] if target is not None else ""
