"""Resolution of a plugin's topic names: namespaces, remappings and defaults of the three generations."""

from urdfkit.bus import absolute
from urdfkit.description.plugins import PluginSpec
from urdfkit.description.plugins.parameter_values import TOPIC
from urdfkit.description.urdf.robot import Plugin
from urdfkit.errors import SimulationError


class Topics:
    """Resolves the topic names of one plugin to absolute names.

    ROS 1: relative names go below ``<robotNamespace>``. ROS 2: below ``<ros><namespace>``, after ``<remapping>`` (and
    the older ``<argument>``); ``~`` is the plugin's node. gz sim has no namespaces.

    Args:
        plugin: the plugin as written.
        spec: its table of parameters.
        namespace: namespace in ROS 1 without ``<robotNamespace>`` (gazebo_ros: the model's name for some plugins, the
            root namespace for others).
    """

    def __init__(self, plugin: Plugin, spec: PluginSpec, *, namespace: str = "") -> None:
        self._remappings: dict[str, str] = {}
        self._namespace = ""
        self._node = plugin.name or ""
        self._element = plugin.element
        if spec.generation == "ros1":
            written = plugin.element.find("robotNamespace")
            self._namespace = (written.text if written is not None else "") or namespace
        elif spec.generation == "ros2" and (ros := plugin.element.find("ros")) is not None:
            written = ros.find("namespace")
            self._namespace = written.text if written is not None else ""
            for rule in (*ros.find_all("remapping"), *ros.find_all("argument")):
                old, arrow, new = rule.text.partition(":=")
                if arrow:
                    self._remappings[self._below(old.strip())] = self._below(new.strip())

    def resolve(self, name: str) -> str:
        """Return the absolute topic of a name in the plugin.

        Raises:
            SimulationError: the result is not a valid topic name, with its position.
        """
        full = self._below(name)
        found = self._remappings.get(full, full)
        if not TOPIC.fullmatch(found):
            texts = ((each.text.rpartition(":=")[2].strip(), each) for each in self._element.walk())
            written = (each for text, each in texts if text in found and not TOPIC.fullmatch(text))
            message = f"`{found}` is not a valid topic name: use letters, digits, _ and /"
            raise SimulationError(message, position=next(written, self._element).origin.position, code="Z830")
        return found

    def _below(self, name: str) -> str:
        if name.startswith("/"):
            return absolute(name)
        if name == "~" or name.startswith("~/"):
            return absolute(f"{self._namespace}/{self._node}/{name[2:]}")
        return absolute(f"{self._namespace}/{name}")
