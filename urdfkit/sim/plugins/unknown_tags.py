"""What to say of a robot's ``<gazebo>`` blocks: names that nobody reads, with the nearest right one."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from urdfkit.description.plugins import PluginSpec
from urdfkit.description.plugins.gazebo_materials import unknown_materials
from urdfkit.description.plugins.sensor_elements import unknown_elements
from urdfkit.description.plugins.sensors.table import INSTEAD, SENSOR_TYPES
from urdfkit.description.plugins.unread_parameters import unread
from urdfkit.description.urdf.robot import Plugin, Robot, SensorTag
from urdfkit.description.xml.element import Element
from urdfkit.errors import did_you_mean


def misspelt(robot: Robot) -> Iterator[str]:
    """Yield what is wrong with names of materials, and in sensors with those of elements."""
    for element, name, meant in unknown_materials(robot):
        yield f"{element.origin.position}: no material `{name}`{_hint(meant)}; the link keeps its plain colour"
    for block in robot.gazebo:
        for sensor in block.sensors:
            for each in unknown_elements(sensor.element):
                meant = None if each.meant is None else f"<{each.meant}>"
                yield _ignored(each.element, f"unknown element <{each.element.tag}> in <{each.inside}>", meant)


def not_read(plugin: Plugin, spec: PluginSpec) -> Iterator[str]:
    """Yield what is wrong with names of a plugin's parameters."""
    for each in unread(plugin, spec):
        if not each.promised:
            meant = None if each.meant is None else f"<{each.meant}>"
            yield _ignored(each.element, f"unknown parameter <{each.element.tag}> of `{plugin.filename}`", meant)


def strange(sensor: SensorTag, *, simulated: bool) -> str:
    """Return why a sensor is left out before it is looked into: its place, and the nearest type; empty if it is not."""
    place, kind = sensor.element.origin.position, (sensor.type or "").strip()
    left_out = f"sensor `{sensor.name or 'sensor'}` is left out"
    if not kind:
        return f"{place}: a sensor has no type; {left_out}"
    if kind in SENSOR_TYPES and simulated:
        return ""
    if kind in INSTEAD:
        return f"{place}: sensors of type `{kind}` are not simulated: {INSTEAD[kind]}; {left_out}"
    if kind not in SENSOR_TYPES:
        return f"{place}: no sensor is of type `{kind}`{did_you_mean(kind, SENSOR_TYPES)}; {left_out}"
    return f"{place}: sensors of type `{kind}` are not simulated yet; {left_out}"


class SharedTopics:
    """Remarks on sensors that publish on one topic.

    Args:
        note: tells the user.
    """

    def __init__(self, note: Callable[[str], None]) -> None:
        self._note = note
        self._known: dict[str, str] = {}

    def add(self, sensor: str, place: Element, topics: Iterator[str]) -> None:
        """Take note of where a sensor publishes; what tells about the sensor itself may be shared."""
        for topic in dict.fromkeys(topics):
            other = self._known.setdefault(topic, sensor)
            if other is not sensor:
                self._note(f"{place.origin.position}: sensors `{other}` and `{sensor}` both publish on `{topic}`")


def _ignored(element: Element, what: str, meant: str | None) -> str:
    hint = "" if meant is None else f"; did you mean {meant}?"
    return f"{element.origin.position}: {what} is ignored{hint}"


def _hint(meant: str | None) -> str:
    return "" if meant is None else f"; did you mean `{meant}`?"
