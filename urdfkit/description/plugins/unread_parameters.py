"""What is written into a plugin and not read by it."""

from __future__ import annotations

from urdfkit.description.plugins.lookup import ALL_SPECS, stem
from urdfkit.description.plugins.sensor_elements import nearest
from urdfkit.description.plugins.spec import PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.element import Element
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

GENERATIONS = {"ros1": "ROS 1", "ros2": "ROS 2", "gz": "the new Gazebo"}

READ_TOO = {
    "gazebo_ros_camera": ("P_cx", "P_cy", "P_fx", "P_fy", "Tx", "Ty", "rectification_matrix", "trigger_topic_name"),
    "gazebo_ros_depth_camera": ("reflectanceTopicName", "normalsTopicName", "reduceNormals"),
    "gazebo_ros_p3d": ("xyz_offsets", "rpy_offsets"),
}
"""Stem of a library → what it reads besides what our tables of parameters have: nothing here simulates it."""

HARMLESS = frozenset(("alwaysOn", "always_on", "ros", "plugin", "xacro", "robotParam", "rosDebugLevel"))
"""What is written into plugins by habit and read by none, or by all."""

_KNOWN = {("diff_drive", "ros1", "torque"): "wheelTorque", ("diff_drive", "ros1", "broadcastTF"): "publishOdomTF"}
"""What is copied from another plugin, and what means it here."""

_PROMISED = {
    ("diff_drive", "ros2", "odometry_topic"),
    ("diff_drive", "ros2", "command_topic"),
    ("openni_kinect", "ros1", "baseline"),
}
"""What the comment at the top of a plugin's header, or Gazebo's own tutorial, shows."""


@record
class Unread:
    """A parameter that its plugin does not read, in no generation.

    Attributes:
        element: which.
        message: what is wrong, without the place.
        meant: the nearest one that is read and not written; None where there is none.
        promised: whether examples of the plugin show it.
    """

    element: Element
    message: str
    meant: str | None
    promised: bool


def tables(plugin: Plugin) -> list[PluginSpec]:
    """Return the tables of every generation that has a plugin of that file name."""
    if plugin.filename is None:
        return []
    name = stem("".join(plugin.filename.split()))
    found = [spec for spec in ALL_SPECS if name in spec.filenames]
    by_class = [spec for spec in found if (plugin.name or "").strip() in spec.class_names]
    return by_class or found


def unread(plugin: Plugin, spec: PluginSpec) -> Iterator[Unread]:
    """Yield what is written into a plugin and read in no generation of it.

    Args:
        plugin: as written.
        spec: the table it is read by.
    """
    every = {parameter.tag for other in (spec, *tables(plugin)) for parameter in other.parameters}
    also = READ_TOO.get(stem(plugin.filename or ""), ())
    known = tuple(parameter.tag for parameter in spec.parameters)
    for child in plugin.element.children:
        tag = child.tag
        if tag in every or tag in also or tag in HARMLESS or ":" in tag:
            continue
        key = (spec.kind, spec.generation, tag)
        if key in _PROMISED:
            yield Unread(child, f"<{tag}> is shown in examples of the plugin, but not read", None, True)
            continue
        meant = _KNOWN.get(key) or nearest(tag, known, likeness=0.8)
        if meant is not None and plugin.element.find(meant) is not None:
            meant = None
        message = f"<{tag}> is not a parameter of {spec.kind.replace('_', ' ')} of {GENERATIONS[spec.generation]}"
        yield Unread(child, message, meant, False)
