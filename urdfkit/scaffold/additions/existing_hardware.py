"""What moves the joints of a robot already: transmissions, ``<ros2_control>``, plugins, controllers that are there."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from urdfkit.description.control import Settings, read_settings
from urdfkit.description.urdf.robot import Plugin, Robot
from urdfkit.errors import UrdfkitError
from urdfkit.scaffold.additions.package_manifest import needs, package_of

KINDS = ("position", "velocity", "effort")
"""What a joint can be told; of several, the first."""

_TELLS_ONLY = re.compile(r"joint_?state", re.IGNORECASE)
_LOOPS = re.compile(r"(gazebo_ros2?|gz_ros2|ign_ros2)_control", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Hardware:
    """What joints can be told, and what tells them.

    Attributes:
        interfaces: what each joint with a transmission or in ``<ros2_control>`` can be told, of `KINDS`; empty for
            nothing that we know.
        drivers: what moves a joint already: a plugin, or a controller.
        loop: the plugin of Gazebo that runs controllers; None for none.
    """

    interfaces: Mapping[str, str] = field(default_factory=dict)
    drivers: Mapping[str, str] = field(default_factory=dict)
    loop: Plugin | None = None

    def loop_says(self, tag: str) -> str | None:
        """Return what an element of the plugin says; None where there is no such plugin or element."""
        element = self.loop.element.find(tag) if self.loop is not None else None
        return element.text.strip() or None if element is not None else None


def hardware(robot: Robot, path: Path | None = None, *, generation: str = "") -> Hardware:
    """Return what joints can be told, and what tells them.

    Args:
        robot: as loaded.
        path: its file; the YAML of its package and of those beside it says which controllers there are.
        generation: of the simulator: transmissions are ``classic``'s alone, ``<ros2_control>`` is of all others; empty
            for any.
    """
    plugins = [plugin for block in robot.gazebo for plugin in block.plugins]
    every = [plugin for plugin in plugins if _LOOPS.search(f"{plugin.filename} {plugin.name}")]
    loops = [plugin for plugin in every if _runs(plugin, generation)]
    names = {joint.name for joint in robot.joints}
    drivers: dict[str, str] = {}
    for plugin in plugins:
        if plugin not in every and not _TELLS_ONLY.search(f"{plugin.filename} {plugin.name}"):
            for element in plugin.element.walk():
                drivers |= {word: f"plugin `{plugin.name}`" for word in element.text.split() if word in names}
    loop = loops[0] if loops else None
    found = Hardware({}, {}, loop)
    files = [*_around(path), *_named(found.loop_says("parameters"))] if path is not None else []
    for file in dict.fromkeys(file.resolve() for file in files):
        drivers |= {joint: f"controller `{name}` ({file.name})" for joint, name in _controlled(file) if joint in names}
    return Hardware(dict(_interfaces(robot, generation)), drivers, loop)


def _runs(plugin: Plugin, generation: str) -> bool:
    """Whether a plugin that runs controllers does so in that generation of the simulator, ROS 1's or ROS 2's."""
    is_ros2 = "ros2_control" in f"{plugin.filename} {plugin.name}"
    return not generation or is_ros2 == (generation != "classic")


def _interfaces(robot: Robot, generation: str) -> Iterator[tuple[str, str]]:
    for transmission in robot.transmissions if generation in ("", "classic") else ():
        for joint in transmission.joints:
            kinds = (*joint.hardware_interfaces, *(k for a in transmission.actuators for k in a.hardware_interfaces))
            said = [kind.rpartition("/")[2].removesuffix("JointInterface").lower() for kind in kinds]
            yield joint.name or "", _first(said)
    for control in robot.ros2_control if generation != "classic" else ():
        for element in control.element.find_all("joint"):
            if commands := element.find_all("command_interface"):
                yield element.get("name") or "", _first([command.get("name") or "" for command in commands])


def _first(said: Iterable[str]) -> str:
    return next((kind for kind in KINDS if kind in said), "")


def _named(parameters: str | None) -> list[Path]:
    return [Path(parameters)] if parameters and Path(parameters).is_file() else []


def _around(path: Path) -> list[Path]:
    """Return the YAML of the package that a file is in, and of those beside it that are of the same robot.

    Those are called alike, need it, or it needs them.
    """
    package = package_of(path)
    if package is None:
        return []
    own, stem = needs(package), package.name.removesuffix("_description")
    beside = (folder for folder in sorted(package.parent.glob("*/")) if folder != package)
    bound = [
        folder
        for folder in beside
        if folder.name in own or folder.name.startswith(f"{stem}_") or package.name in needs(folder)
    ]
    return [file for folder in (package, *bound) for file in sorted(folder.glob("config/*.y*ml"))]


def _controlled(file: Path) -> Iterator[tuple[str, str]]:
    """Yield the joints that controllers of a file are for, and the controller of each."""
    try:
        settings = read_settings(file)
    except UrdfkitError:
        return  # it need not be about controllers at all
    for path, group in settings.walk():
        name = path.rpartition("/")[2]
        kind = group.children.get("type")
        own: Settings | None = group if kind is not None and "/" in (kind.value or "") else None
        if own is not None and _TELLS_ONLY.search((kind.value if kind is not None else None) or ""):
            continue
        if "ros__parameters" in group.children and name != "controller_manager":
            own = group.children["ros__parameters"]
        yield from ((joint, name) for joint in (_texts(own) if own is not None else ()))


def _texts(settings: Settings) -> Iterator[str]:
    """Yield the texts among parameters."""
    for item in (settings, *(settings.items or ())):
        if item.value is not None:
            yield item.value
    for child in settings.children.values():
        yield from _texts(child)
