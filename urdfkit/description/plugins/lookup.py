"""Find the table of a plugin and read its parameters by meaning."""

import re
import sys
from collections.abc import Iterator
from functools import cache

from urdfkit.description.plugins.controller_plugins import CONTROL
from urdfkit.description.plugins.drives.table import DRIVES
from urdfkit.description.plugins.sensors.table import SENSORS
from urdfkit.description.plugins.spec import Parameter, PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.element import Element
from urdfkit.entry_points import PLUGIN_GROUPS, entry_points
from urdfkit.errors import ResourceError

ALL_SPECS: tuple[PluginSpec, ...] = (*DRIVES, *CONTROL, *SENSORS)
"""The tables of all plugins that urdfkit brings."""

_VERSIONED = re.compile(r"^(gz-sim|ignition-gazebo)\d+-(.+-system)$")


def stem(filename: str) -> str:
    """Return a library's bare name: no directory, ``lib``, ``.so`` or Gazebo version."""
    name = filename.strip().replace("\\", "/").rpartition("/")[2]
    name = name.removesuffix(".so").rstrip().removeprefix("lib")
    if versioned := _VERSIONED.match(name):
        name = f"{versioned[1]}-{versioned[2]}"
    return name


def tables_of(name: str) -> list[PluginSpec]:
    """Return the tables of a library's bare name, of every generation: urdfkit's own, else those of other packages."""
    found = [spec for spec in ALL_SPECS if name in spec.filenames]
    return found or [spec for spec in _installed(tuple(sys.path)) if name in spec.filenames]


@cache
def _installed(path: tuple[str, ...]) -> tuple[PluginSpec, ...]:
    """Return the tables of installed packages; the simulator reports a package that cannot be imported."""
    found: list[PluginSpec] = []
    for entry in entry_points(*PLUGIN_GROUPS, path=path):
        try:
            found += entry.load().specs
        except ResourceError:
            continue
    return tuple(found)


def match(plugin: Plugin) -> PluginSpec | None:
    """Return the table of a plugin, by file name; None for an unknown plugin.

    ROS 1 and ROS 2 plugins of Gazebo Classic share file names and differ in spelling. A ``<ros>`` block means ROS 2;
    without one, the table that contains more of the written parameters is used; in a tie, more snake_case than
    camelCase means ROS 2. In gz sim, a library may contain several classes, so a known class in the plugin's
    ``name`` takes precedence over the file name.
    """
    if plugin.filename is None:
        return None
    name = stem(plugin.filename)
    candidates = tables_of(name)
    if len(candidates) < 2:
        return candidates[0] if candidates else None
    by_class = [spec for spec in candidates if (plugin.name or "").strip() in spec.class_names]
    if by_class:
        return by_class[0]
    if "ros" not in (tags := [child.tag for child in plugin.element.children]):
        matches = [sum(spec.parameter(tag) is not None for tag in tags) for spec in candidates]
        if matches.count(max(matches)) == 1:
            return candidates[matches.index(max(matches))]
    ros2 = _is_ros2(plugin.element)
    return next((spec for spec in candidates if (spec.generation == "ros2") is ros2), candidates[0])


def _is_ros2(plugin: Element) -> bool:
    tags = [child.tag for child in plugin.children]
    if "ros" in tags:
        return True
    return sum("_" in tag for tag in tags) > sum(tag != tag.lower() and "_" not in tag for tag in tags)


def values(plugin: Plugin, parameter: Parameter) -> Iterator[tuple[str, Element]]:
    """Yield the values of a parameter, each with its element; values joined by the separator are yielded separately."""
    for child in plugin.element.children:
        if child.tag == parameter.tag:
            words = child.text.split(parameter.separator) if parameter.separator else [child.text]
            for word in words:
                yield word.strip(), child
            if not parameter.repeats:
                return


def read(plugin: Plugin, spec: PluginSpec) -> dict[str, str]:
    """Return meaning → text: the first value, or the default; parameters without either are omitted."""
    found = read_all(plugin, spec)
    return {meaning: texts[0] for meaning, texts in found.items() if texts}


def read_all(plugin: Plugin, spec: PluginSpec) -> dict[str, tuple[str, ...]]:
    """Return meaning → all values, or the default; an empty tuple for parameters without either."""
    found: dict[str, tuple[str, ...]] = {}
    for parameter in spec.parameters:
        texts = tuple(text for text, _ in values(plugin, parameter) if text)
        if not texts and parameter.default is not None:
            texts = (parameter.default,)
        found[parameter.meaning] = texts
    return found
