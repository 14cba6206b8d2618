"""Parameters written in a plugin that the plugin does not read."""

from collections.abc import Iterator

from urdfkit.description.plugins.lookup import stem, tables_of
from urdfkit.description.plugins.sensor_elements import nearest
from urdfkit.description.plugins.spec import PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.element import Element
from urdfkit.record import record

GENERATIONS = {"ros1": "ROS 1", "ros2": "ROS 2", "gz": "Gazebo (gz sim)"}

READ_TOO = {
    "gazebo_ros_camera": ("P_cx", "P_cy", "P_fx", "P_fy", "Tx", "Ty", "rectification_matrix", "trigger_topic_name"),
    "gazebo_ros_depth_camera": ("reflectanceTopicName", "normalsTopicName", "reduceNormals"),
    "gazebo_ros_p3d": ("xyz_offsets", "rpy_offsets"),
}
"""Stem of a library → parameters it reads that are not in the tables, because they are not simulated."""

HARMLESS = frozenset(("alwaysOn", "always_on", "ros", "plugin", "xacro", "robotParam", "rosDebugLevel"))
"""Common parameters that are never reported: no plugin reads them, or every plugin does."""

_EQUIVALENT = {("diff_drive", "ros1", "torque"): "wheelTorque", ("diff_drive", "ros1", "broadcastTF"): "publishOdomTF"}
"""Parameter of another plugin → its equivalent here."""

_PROMISED = {
    ("diff_drive", "ros2", "odometry_topic"),
    ("diff_drive", "ros2", "command_topic"),
    ("openni_kinect", "ros1", "baseline"),
}
"""Parameters shown in the header comment of a plugin or in Gazebo's tutorials."""


@record
class Unread:
    """A parameter that its plugin does not read in any generation.

    Attributes:
        element: the parameter.
        message: the defect, without the position.
        meant: the most similar parameter that the plugin reads and the description lacks; None if none is similar.
        promised: whether the plugin's documentation shows the parameter, although the plugin does not read it.
    """

    element: Element
    message: str
    meant: str | None
    promised: bool


def tables(plugin: Plugin) -> list[PluginSpec]:
    """Return the tables of every generation that has a plugin of that file name."""
    if plugin.filename is None:
        return []
    found = tables_of(stem("".join(plugin.filename.split())))
    by_class = [spec for spec in found if (plugin.name or "").strip() in spec.class_names]
    return by_class or found


def unread(plugin: Plugin, spec: PluginSpec) -> Iterator[Unread]:
    """Yield the parameters of a plugin that no generation of it reads.

    Args:
        plugin: the plugin.
        spec: the table of the plugin.
    """
    every = {parameter.tag for other in (spec, *tables(plugin)) for parameter in other.parameters}
    also = READ_TOO.get(stem(plugin.filename or ""), ())
    names = tuple(parameter.tag for parameter in spec.parameters)
    for child in plugin.element.children:
        tag = child.tag
        if tag in every or tag in also or tag in HARMLESS or ":" in tag:
            continue
        key = (spec.kind, spec.generation, tag)
        if key in _PROMISED:
            message = f"<{tag}> appears in examples of the plugin, but the plugin does not read it"
            yield Unread(child, message, None, True)
            continue
        meant = _EQUIVALENT.get(key) or nearest(tag, names, cutoff=0.8)
        if meant is not None and plugin.element.find(meant) is not None:
            meant = None
        message = f"<{tag}> is not a parameter of {spec.kind.replace('_', ' ')} of {GENERATIONS[spec.generation]}"
        yield Unread(child, message, meant, False)
