"""Existing control of a robot's joints: transmissions, ``<ros2_control>``, plugins and configured controllers."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from urdfkit.description.control import Settings, read_settings
from urdfkit.description.urdf.robot import Plugin, Robot
from urdfkit.errors import UrdfkitError
from urdfkit.scaffold.additions.package_manifest import needs, package_of

KINDS = ("position", "velocity", "effort")
"""Command interfaces that a joint may have, in order of preference."""

_STATE_ONLY = re.compile(r"joint_?state", re.IGNORECASE)
_LOOPS = re.compile(r"(gazebo_ros2?|gz_ros2|ign_ros2)_control", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class ExistingHardware:
    """The command interfaces of joints, and what drives them already.

    Attributes:
        interfaces: command interface, one of `KINDS`, of each joint with a transmission or in ``<ros2_control>``;
            empty if the joint has none of them.
        drivers: plugin or controller that moves a joint already, by joint.
        loop: the Gazebo plugin that runs controllers; None without one.
    """

    interfaces: Mapping[str, str] = field(default_factory=dict)
    drivers: Mapping[str, str] = field(default_factory=dict)
    loop: Plugin | None = None

    def loop_parameter(self, tag: str) -> str | None:
        """Return the text of an element of the plugin; None without the plugin or the element."""
        element = self.loop.element.find(tag) if self.loop is not None else None
        return element.text.strip() or None if element is not None else None


def hardware(robot: Robot, path: Path | None = None, *, generation: str = "") -> ExistingHardware:
    """Return the command interfaces of joints, and what drives them already.

    Args:
        robot: the loaded robot.
        path: the model's file; controllers are read from the YAML files of its package and of related packages.
        generation: generation of the simulator: only ``classic`` has transmissions, all others have
            ``<ros2_control>``; empty for any.
    """
    plugins = [plugin for block in robot.gazebo for plugin in block.plugins]
    control_plugins = [plugin for plugin in plugins if _LOOPS.search(f"{plugin.filename} {plugin.name}")]
    loops = [plugin for plugin in control_plugins if _runs(plugin, generation)]
    names = {joint.name for joint in robot.joints}
    drivers: dict[str, str] = {}
    for plugin in plugins:
        if plugin not in control_plugins and not _STATE_ONLY.search(f"{plugin.filename} {plugin.name}"):
            for element in plugin.element.walk():
                drivers |= {word: f"plugin `{plugin.name}`" for word in element.text.split() if word in names}
    loop = loops[0] if loops else None
    declared = ExistingHardware({}, {}, loop)
    files = [*_around(path), *_named(declared.loop_parameter("parameters"))] if path is not None else []
    for file in dict.fromkeys(file.resolve() for file in files):
        drivers |= {joint: f"controller `{name}` ({file.name})" for joint, name in _controlled(file) if joint in names}
    return ExistingHardware(dict(_interfaces(robot, generation)), drivers, loop)


def _runs(plugin: Plugin, generation: str) -> bool:
    """Return whether a plugin runs controllers in that generation of the simulator, with ROS 1 or ROS 2."""
    is_ros2 = "ros2_control" in f"{plugin.filename} {plugin.name}"
    return not generation or is_ros2 == (generation != "classic")


def _interfaces(robot: Robot, generation: str) -> Iterator[tuple[str, str]]:
    for transmission in robot.transmissions if generation in ("", "classic") else ():
        for joint in transmission.joints:
            kinds = (*joint.hardware_interfaces, *(k for a in transmission.actuators for k in a.hardware_interfaces))
            names = [kind.rpartition("/")[2].removesuffix("JointInterface").lower() for kind in kinds]
            yield joint.name or "", _first(names)
    for control in robot.ros2_control if generation != "classic" else ():
        for element in control.element.find_all("joint"):
            if commands := element.find_all("command_interface"):
                yield element.get("name") or "", _first([command.get("name") or "" for command in commands])


def _first(names: Iterable[str]) -> str:
    return next((kind for kind in KINDS if kind in names), "")


def _named(parameters: str | None) -> list[Path]:
    return [Path(parameters)] if parameters and Path(parameters).is_file() else []


def _around(path: Path) -> list[Path]:
    """Return the YAML files of the package of a file, and of neighbouring packages of the same robot.

    A package belongs to the same robot if the names have the same stem, or one depends on the other.
    """
    package = package_of(path)
    if package is None:
        return []
    own, stem = needs(package), package.name.removesuffix("_description")
    neighbours = (folder for folder in sorted(package.parent.glob("*/")) if folder != package)
    related = [
        folder
        for folder in neighbours
        if folder.name in own or folder.name.startswith(f"{stem}_") or package.name in needs(folder)
    ]
    return [file for folder in (package, *related) for file in sorted(folder.glob("config/*.y*ml"))]


def _controlled(file: Path) -> Iterator[tuple[str, str]]:
    """Yield the joints that the controllers in a file move, each with the name of its controller."""
    try:
        settings = read_settings(file)
    except UrdfkitError:
        return  # not a parameter file
    for path, group in settings.walk():
        name = path.rpartition("/")[2]
        kind = group.children.get("type")
        own: Settings | None = group if kind is not None and "/" in (kind.value or "") else None
        if own is not None and _STATE_ONLY.search((kind.value if kind is not None else None) or ""):
            continue
        if "ros__parameters" in group.children and name != "controller_manager":
            own = group.children["ros__parameters"]
        yield from ((joint, name) for joint in (_texts(own) if own is not None else ()))


def _texts(settings: Settings) -> Iterator[str]:
    """Yield all texts among parameters."""
    for item in (settings, *(settings.items or ())):
        if item.value is not None:
            yield item.value
    for child in settings.children.values():
        yield from _texts(child)
