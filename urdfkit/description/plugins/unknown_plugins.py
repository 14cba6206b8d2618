"""Messages about plugins and sensors that are not simulated, with the most similar simulated one."""

import re
from collections.abc import Iterable

from urdfkit import errors
from urdfkit.defect_message import Suggestion
from urdfkit.description.plugins.lookup import ALL_SPECS, stem
from urdfkit.description.plugins.sensors.table import INSTEAD, SENSOR_TYPES
from urdfkit.description.urdf.robot import Plugin, SensorTag

_GAZEBO = re.compile(r"^(gazebo_ros_|gazebo_|gz-sim-|ignition-gazebo-|gz_|hector_gazebo_)")
"""Prefixes of Gazebo plugin libraries."""
_END = re.compile(r"(-system|_plugin)$")


def unknown(plugin: Plugin, sensor: str | None = None, others: Iterable[str] = ()) -> str:
    """Return the message about a plugin that is not simulated, without its position.

    Args:
        plugin: the plugin.
        sensor: name of the ``<sensor>`` that contains the plugin; None for other plugins.
        others: stems of supported libraries that are not in the tables.
    """
    left_out = "" if sensor is None else f"; sensor `{sensor or 'sensor'}` is ignored"
    if plugin.filename is None or not plugin.filename.strip():
        which = f" `{plugin.name}`" if plugin.name else ""
        return f"plugin{which} has no filename and is ignored{left_out}"
    name = stem(plugin.filename)
    if near := nearest(name, others):
        return f"no plugin `{plugin.filename}`{left_out}" + Suggestion(plugin.filename.replace(name, near))
    if _GAZEBO.search(name):
        return f"plugin `{plugin.filename}` is not simulated yet{left_out}"
    return f"unknown plugin `{plugin.filename}`: urdfkit does not simulate it{left_out}"


def unsupported(sensor: SensorTag, *, simulated: bool) -> str:
    """Return the message about a sensor that is not simulated, with the nearest type; empty for a valid type.

    Args:
        sensor: the sensor.
        simulated: whether its plugin, or a sensor of its type without plugins, is simulated.
    """
    kind = (sensor.type or "").strip()
    left_out = f"sensor `{sensor.name or 'sensor'}` is ignored"
    if not kind:
        return f"a sensor has no type; {left_out}"
    if kind in SENSOR_TYPES and simulated:
        return ""
    if kind in INSTEAD:
        return f"sensors of type `{kind}` are not simulated: {INSTEAD[kind]}; {left_out}"
    if kind not in SENSOR_TYPES:
        return f"unknown sensor type `{kind}`; {left_out}" + errors.did_you_mean(kind, SENSOR_TYPES)
    return f"sensors of type `{kind}` are not simulated yet; {left_out}"


def nearest(name: str, others: Iterable[str] = ()) -> str:
    """Return the library stem most similar to a name; empty if none is similar.

    Args:
        name: name of a library without directory, ``lib`` and ``.so``.
        others: stems of supported libraries that are not in the tables.
    """
    candidates = [other for spec in ALL_SPECS for other in spec.filenames] + list(others)
    # Parts common to most names do not make names similar.
    near = errors.nearest(_essence(name), map(_essence, candidates), cutoff=0.7)
    if near is None:
        return ""
    meant = [other for other in candidates if _essence(other) == near]
    return next(iter(errors.similar(name, meant, cutoff=0.0)), "")


def _essence(name: str) -> str:
    return _END.sub("", _GAZEBO.sub("", name))
