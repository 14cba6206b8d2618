"""PluginSpec: table of the names and XML parameters of a plugin."""

from __future__ import annotations

from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Literal

    Generation = Literal["ros1", "ros2", "gz"]
    """ROS 1 with Gazebo Classic, ROS 2 with Gazebo Classic, and gz sim."""

    Names = Literal["joint", "link", "frame", "topic"]


@record
class Parameter:
    """One XML child that a plugin reads.

    Attributes:
        meaning: name in the simulator, the same in all generations, e.g. ``wheel_separation``.
        tag: XML tag in this generation.
        default: default value as text; None for a required parameter.
        unit: SI unit in brackets, or empty.
        names: kind of the entity named by the value; None if the value is not a name.
        repeats: whether the parameter may occur several times.
        separator: separator of several values in one text, e.g. ``,``; empty if the text is one value.
    """

    meaning: str
    tag: str
    default: str | None = None
    unit: str = ""
    names: Names | None = None
    repeats: bool = False
    separator: str = ""


@record
class PluginSpec:
    """One plugin in one generation.

    Attributes:
        kind: kind of the plugin in the simulator, e.g. ``diff_drive``.
        generation: generation of Gazebo and ROS.
        filenames: stems of the plugin's libraries (without directory, ``lib`` and ``.so``).
        class_names: C++ classes that its ``name`` may contain (gz sim only).
        parameters: all XML children that the plugin reads.
        source: source file of the plugin that defines these parameters.
    """

    kind: str
    generation: Generation
    filenames: tuple[str, ...]
    class_names: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    source: str

    def parameter(self, tag: str) -> Parameter | None:
        """Return the parameter with this tag."""
        return next((p for p in self.parameters if p.tag == tag), None)

    def by_meaning(self, meaning: str) -> Parameter | None:
        """Return the parameter with this meaning."""
        return next((p for p in self.parameters if p.meaning == meaning), None)
