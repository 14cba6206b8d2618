"""Notes on a robot's ``<gazebo>`` blocks: unknown names with the nearest match, and sensors that share a topic."""

from collections.abc import Callable, Iterator

from urdfkit.description.plugins import PluginSpec
from urdfkit.description.plugins.gazebo_materials import unknown_materials
from urdfkit.description.plugins.sensor_elements import unknown_elements
from urdfkit.description.plugins.unread_parameters import unread
from urdfkit.description.urdf.robot import Plugin, Robot
from urdfkit.description.xml.element import Element
from urdfkit.sim.plugins.base import Sensor


def misspelt(robot: Robot) -> Iterator[str]:
    """Yield a note for each unknown material, and for each unknown element of a sensor."""
    for element, name, meant in unknown_materials(robot):
        hint = "" if meant is None else f"; did you mean `{meant}`?"
        yield f"{element.origin.position}: no material `{name}`; the link keeps its plain colour{hint}"
    for block in robot.gazebo:
        for sensor in block.sensors:
            for each in unknown_elements(sensor.element):
                yield _ignored(each.element, f"unknown element <{each.element.tag}> in <{each.inside}>", each.meant)


def not_read(plugin: Plugin, spec: PluginSpec) -> Iterator[str]:
    """Yield a note for each parameter that a plugin does not read."""
    for each in unread(plugin, spec):
        if not each.promised:
            yield _ignored(each.element, f"unknown parameter <{each.element.tag}> of `{plugin.filename}`", each.meant)


class SharedTopics:
    """Reports sensors that publish on the same topic. Only CameraInfo topics may be shared.

    Args:
        note: reports a note to the user.
    """

    def __init__(self, note: Callable[[str], None]) -> None:
        self._note = note
        self._sensors: dict[str, Sensor] = {}

    def add(self, sensor: Sensor) -> None:
        """Add the topics of a sensor; report each topic on which another sensor publishes."""
        for topic in dict.fromkeys(topic.name for topic in sensor.topics if not topic.type.endswith("/CameraInfo")):
            other = self._sensors.setdefault(topic, sensor)
            if other is not sensor:
                names = [each.name or each.plugin.name or "" for each in (other, sensor)]
                place = sensor.plugin.element.origin.position
                self._note(f"{place}: sensors `{names[0]}` and `{names[1]}` both publish on `{topic}`")


def _ignored(element: Element, what: str, meant: str | None) -> str:
    hint = "" if meant is None else f"; did you mean <{meant}>?"
    return f"{element.origin.position}: {what} is ignored{hint}"
