"""Targets: names and releases of the consumers of a robot, and the guess from package.xml."""

import re
from pathlib import Path

from urdfkit.record import record

TARGETS = ("ros1", "ros2", "gz", "classic", "mujoco", "isaac", "drake", "moveit", "urdfkit")
"""Consumers that ``--target`` accepts; without a target, all rules that apply to any consumer run."""

DISTROS: dict[str, tuple[str, ...]] = {
    "ros1": ("hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic"),
    "ros2": ("foxy", "galactic", "humble", "iron", "jazzy", "kilted", "lyrical", "rolling"),
    "gz": ("citadel", "edifice", "fortress", "garden", "harmonic", "ionic", "jetty"),
    "classic": ("7", "8", "9", "10", "11"),
}
"""Target → its releases, oldest first (REP-3, REP-2000, gazebosim.org/docs/all/releases)."""

WITHOUT_CLASSIC = frozenset(("jazzy", "kilted", "lyrical", "rolling"))
"""ROS 2 releases that have neither Gazebo Classic nor its plugins (rosdistro#40759 and #41224)."""

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
"""Build tool or build type → ROS version (REP-149, and the build types of colcon)."""

_ONLY_ROS = {
    "roslaunch": "ros1",
    "rospy": "ros1",
    "roscpp": "ros1",
    "launch_ros": "ros2",
    "rclpy": "ros2",
    "rclcpp": "ros2",
}
"""Packages that exist in one ROS version only; used if the build tool does not decide."""

_NEW_GAZEBO = ("ros_gz", "gz_ros2_control", "ign_ros2_control", "ros_ign", "gz_sim_vendor", "gz-sim", "ignition-gazebo")
_CLASSIC = ("gazebo_ros", "gazebo_plugins", "gazebo_ros2_control", "gazebo_dev", "gazebo_rosdev")


@record
class Guess:
    """Guessed target of a package.

    Attributes:
        target: ``ros1``, ``ros2``, ``gz``, or None if package.xml fits none or several.
        why: the reason for the guess, for messages.
        manifest: path of the package.xml; None if it was not found.
    """

    target: str | None
    why: str
    manifest: Path | None


def guess(path: Path) -> Guess:
    """Guess the target of a description file from the package.xml above it.

    A package that depends on gz sim, and not on Gazebo Classic, has the target ``gz``; otherwise the build tool
    distinguishes ROS 1 from ROS 2.
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
    new = [name for name in needs if name.startswith(_NEW_GAZEBO)]
    if new and not any(name.startswith(_CLASSIC) for name in needs):
        others = [name for name in new if f"<name>{name}<" not in text]
        return Guess("gz", f"depends on {others[0]}" if others else "is named after it", manifest)
    tools = [name for name in re.findall(_BUILD, text) if name in _ROS]
    versions = {_ROS[tool] for tool in tools}
    if len(versions) == 1:
        return Guess(versions.pop(), f"is built with {tools[0]}", manifest)
    specific = [name for name in needs if name in _ONLY_ROS]
    by_needs = {_ONLY_ROS[name] for name in specific}
    if not versions and len(by_needs) == 1:
        return Guess(by_needs.pop(), f"depends on {specific[0]}", manifest)
    return Guess(None, "is for ROS 1 and ROS 2" if len(versions | by_needs) > 1 else "names no build tool", manifest)


def parse_target(name: str | None, option: str = "--target") -> str | None:
    """Return the canonical name of a target, with its release if given: ``ros2`` or ``ros2-jazzy``.

    A release alone is sufficient. Case and separators are ignored, and common aliases are accepted: ``Ignition``,
    ``gazebo11``, ``ros_noetic``.

    Args:
        name: the name from the user; None for no target.
        option: the option or setting, for messages.

    Raises:
        UsageError: the name is unknown or ambiguous.
    """
    if name is None or name in TARGETS:
        return name
    written = re.sub(r"[\s_-]+", "-", name.strip().lower())
    family, distro = _split(written)
    found = f"{family}-{distro}" if distro else family
    if found in TARGETS or distro in DISTROS.get(family, ()):
        return found
    from urdfkit.errors import UsageError, did_you_mean, nearest

    if written in _SEVERAL:
        raise UsageError(f"{option} {name} is ambiguous: use {_SEVERAL[written]}")
    releases = {release: target for target, distros in DISTROS.items() for release in distros}
    if distro and family in DISTROS and ("-" in written or distro.isdecimal()):
        others = {} if distro.isdecimal() else releases
        near = nearest(distro, DISTROS[family]) or nearest(distro, others)
        hint = f"; did you mean `{releases[near]}-{near}`?" if near else f"; {family} has {', '.join(DISTROS[family])}"
        raise UsageError(f"{option} {name}: unknown target{hint}")
    names = (one for one in releases if not one.isdecimal())
    hint = did_you_mean(written, (*TARGETS, *names, *(f"{target}-{release}" for release, target in releases.items())))
    families = f"; one of {', '.join(TARGETS)}"
    raise UsageError(f"{option} {name}: unknown target{hint or families}")


def _split(written: str) -> tuple[str, str]:
    """Split a lower-case name into family and release; the release may be empty."""
    if written in TARGETS or written in _SAME:
        return _SAME.get(written, written), ""
    releases = {release: target for target, distros in DISTROS.items() for release in distros}
    families = "|".join(sorted((*TARGETS, *_SAME, *_SEVERAL), key=len, reverse=True))
    parts = re.fullmatch(rf"({families})-?([a-z]+|\d+)", written)
    family, distro = (_SAME.get(parts[1], parts[1]), parts[2]) if parts else (written, "")
    if family in _SEVERAL and distro in releases:  # the release resolves the ambiguity of `gazebo` and `ros`
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
"""Aliases of targets."""

_SEVERAL = {"gazebo": "`gz` (gz sim) or `classic`", "ros": "`ros1` or `ros2`"}
"""Ambiguous names, which a release resolves."""


def family_of(target: str | None) -> str | None:
    """Return the target without its release."""
    return target.partition("-")[0] if target is not None else None


def release_of(target: str | None) -> str:
    """Return the release of a target; empty if it has none."""
    return target.partition("-")[2] if target is not None else ""
