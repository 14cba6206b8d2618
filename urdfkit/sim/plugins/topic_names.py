"""Which topic a plugin means: namespaces, remappings and defaults of the three generations."""

from __future__ import annotations

import re

from urdfkit.bus import absolute
from urdfkit.description.plugins import PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.errors import SimulationError

_TOPIC = re.compile(r"^/[A-Za-z0-9_./:~-]*$")
"""ROS allows less; but names of things in the new Gazebo, of which it makes topics, may hold any of these."""


class Topics:
    """Turns the topic names of one plugin into absolute ones.

    ROS 1: relative names go below ``<robotNamespace>``. ROS 2: below ``<ros><namespace>``, after ``<remapping>`` (and
    the older ``<argument>``); ``~`` is the plugin's node. The new Gazebo has no namespaces.

    Args:
        plugin: the plugin as written.
        spec: its table.
        namespace: where ROS 1 puts the plugin that does not say (gazebo_ros: the model's name for some, the root for
            others).
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
        """Return the absolute topic for a name as the plugin knows it.

        Raises:
            SimulationError: it is none, with its place.
        """
        full = self._below(name)
        found = self._remappings.get(full, full)
        if not _TOPIC.match(found):
            written = (each for each in self._element.walk() if each.text and found.endswith(each.text.strip()))
            raise SimulationError(
                f"`{found}` is no name of a topic: it is made of letters, digits, _ and /",
                position=next(written, self._element).origin.position,
            )
        return found

    def _below(self, name: str) -> str:
        if name.startswith("/"):
            return absolute(name)
        if name == "~" or name.startswith("~/"):
            return absolute(f"{self._namespace}/{self._node}/{name[2:]}")
        return absolute(f"{self._namespace}/{name}")
