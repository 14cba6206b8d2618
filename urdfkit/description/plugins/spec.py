"""PluginSpec: the one table of a plugin's names and XML parameters."""

from __future__ import annotations

from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Literal

    Generation = Literal["ros1", "ros2", "gz"]
    """ROS 1 with Gazebo Classic, ROS 2 with Gazebo Classic, and the new Gazebo."""

    Names = Literal["joint", "link", "frame", "topic"]


@record
class Parameter:
    """One XML child a plugin reads.

    Attributes:
        meaning: what the simulator calls it, the same across generations, e.g. ``wheel_separation``.
        tag: how this generation spells it.
        default: the value when it is left out, as text; None where it has to be written.
        unit: SI unit in brackets, or empty.
        names: what the value refers to, if to anything.
        repeats: may be given more than once.
        separator: splits one value into several, e.g. ``,``; empty where the text is one value.
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
        kind: what it is for the simulator, e.g. ``diff_drive``.
        generation: whose spelling this is.
        filenames: library stems it answers to (without directory, ``lib`` and ``.so``).
        class_names: C++ classes its ``name`` may be (new Gazebo only).
        parameters: every XML child it reads.
        source: where this was read from.
    """

    kind: str
    generation: Generation
    filenames: tuple[str, ...]
    class_names: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    source: str

    def parameter(self, tag: str) -> Parameter | None:
        """Return the parameter spelled `tag`."""
        return next((p for p in self.parameters if p.tag == tag), None)

    def by_meaning(self, meaning: str) -> Parameter | None:
        """Return the parameter that means `meaning`."""
        return next((p for p in self.parameters if p.meaning == meaning), None)
