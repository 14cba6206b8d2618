"""Xacro arguments that the launch files of a package pass to a description."""

from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfkit.description.launch.launch_file import read_launch_file
from urdfkit.description.launch.launch_scope import LaunchContents
from urdfkit.description.packages.related_files import LAUNCH, around, package_of
from urdfkit.description.packages.resolver import Packages
from urdfkit.record import record

_SIMULATORS = frozenset(("gazebo_ros", "ros_gz_sim", "ros_ign_gazebo", "gazebo", "gz", "ign", "gzserver"))
_JOINT_SLIDERS = frozenset(("joint_state_publisher_gui", "joint_state_publisher", "urdf_launch"))
_RVIZ = frozenset(("rviz2", "rviz"))


@record(eq=False)
class Passed:
    """The constant arguments that one launch file passes to a description.

    Attributes:
        launch: the launch file.
        arguments: argument → value.
        own: whether the launch file is in the package of the description.
        contents: everything that was read in the launch file.
    """

    launch: Path
    arguments: Mapping[str, str]
    own: bool
    contents: LaunchContents


@record(eq=False)
class Choice:
    """The arguments to use.

    Attributes:
        chosen: launch file → the arguments that it passes and no earlier launch file does.
        conflicts: argument → value → the first launch file that passes it, for arguments with several values.
            With a conflict, `chosen` is empty.
    """

    chosen: Mapping[Path, Mapping[str, str]]
    conflicts: Mapping[str, Mapping[str, Path]]


def passed_to(description: Path, packages: Packages) -> list[Passed]:
    """Return the arguments that launch files of the package, and of packages that depend on it, pass to a description.

    A launch file is ignored if another one includes it and passes arguments to the description too.

    Args:
        description: the file that xacro expands.
        packages: finds packages.
    """
    package = package_of(description)
    if package is None:
        return []
    wanted = description.resolve()
    found: list[Passed] = []
    for file in around(package):
        if not file.name.endswith(LAUNCH):
            continue
        contents = read_launch_file(file, packages)
        own = package in file.parents
        calls = [call.arguments for call in contents.commands if call.description.resolve() == wanted]
        found += [Passed(file, arguments, own, contents) for arguments in calls]
    included = {path.resolve() for each in found for path in each.contents.included}
    return [each for each in found if each.launch.resolve() not in included]


def choose(passed: list[Passed], purpose: str, named: Mapping[str, str]) -> Choice:
    """Choose the arguments of the launch files for a purpose.

    Launch files in the package of the description take precedence, and launch files that agree with the
    arguments of the command line.

    Args:
        passed: from `passed_to`.
        purpose: ``simulation`` or ``display``.
        named: arguments of the command line, which are never overridden.
    """
    files = for_purpose(passed, purpose)
    files = [each for each in files if each.own] or files
    files = [each for each in files if all(named.get(k, v) == v for k, v in each.arguments.items())] or files
    values: dict[str, dict[str, Path]] = {}
    for each in files:
        for name, value in each.arguments.items():
            if name not in named:
                values.setdefault(name, {}).setdefault(value, each.launch)
    if conflicts := {name: by_value for name, by_value in values.items() if len(by_value) > 1}:
        return Choice({}, conflicts)
    chosen: dict[Path, dict[str, str]] = {}
    for name, by_value in values.items():
        for value, launch in by_value.items():
            chosen.setdefault(launch, {})[name] = value
    return Choice(chosen, {})


def for_purpose(passed: list[Passed], purpose: str) -> list[Passed]:
    """Return the launch files that start Gazebo, or sliders for joints, or without these RViz; see `choose`."""
    simulations = [each for each in passed if each.contents.started & _SIMULATORS]
    if purpose == "simulation":
        return simulations
    others = [each for each in passed if each not in simulations]
    sliders = [each for each in others if each.contents.started & _JOINT_SLIDERS]
    return sliders or [each for each in others if each.contents.started & _RVIZ]


def values_of(name: str, passed: list[Passed]) -> Iterator[tuple[str, Path]]:
    """Yield each value that launch files pass to an argument, with the first launch file that passes it."""
    seen: set[str] = set()
    for each in passed:
        value = each.arguments.get(name)
        if value is not None and value not in seen:
            seen.add(value)
            yield value, each.launch


def description_of(name: str, passed: list[Passed]) -> str:
    """Return the description of the launch argument with this name; empty without one."""
    return next((text for each in passed if (text := each.contents.descriptions.get(name))), "")
