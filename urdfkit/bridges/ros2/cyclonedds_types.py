"""Types of messages for Cyclone DDS, from rosbags' definitions, named as ROS 2 names them."""

from __future__ import annotations

from functools import cache
from typing import Any

from urdfkit.messages import typestore

PLACEHOLDER = "structure_needs_at_least_one_member"
"""Field of messages without fields in ROS 2."""

TYPE_FUNCTIONS = {"11": (14, (8, 9, 10))}
"""Major version of Cyclone DDS → length of ``struct ddsi_sertype_ops``, and its type_id, type_map and type_info."""
_TABLES: list[Any] = []
"""Tables that Cyclone DDS may use until the process ends."""


@cache
def idl_type(name: str) -> Any:
    """Return the class of a message for Cyclone DDS.

    Args:
        name: e.g. ``geometry_msgs/msg/Twist``, which is ``geometry_msgs::msg::dds_::Twist_`` in DDS.
    """
    from cyclonedds.idl import make_idl_struct, types

    package, kind, message = name.split("/")
    fields = {field: _field(layout) for field, layout in typestore().fielddefs[name][1]}
    return make_idl_struct(message, f"{package}.{kind}.dds_.{message}_", fields or {PLACEHOLDER: types.uint8})


def hide_type_information(topic: Any) -> None:
    """Let readers and writers of a topic match those of ROS by the names of types.

    Cyclone DDS compares type information if both sides send it, and cannot read that of Fast DDS 3 (ROS 2 Kilted).
    rmw_cyclonedds sends none, but the Python wheel always does: three functions of its type are removed here, which
    Cyclone DDS permits for types without type information.
    """
    from ctypes import POINTER, byref, c_int32, c_void_p, cast
    from importlib.metadata import version

    from cyclonedds.internal import load_cyclonedds

    if version("cyclonedds").split(".")[0] not in TYPE_FUNCTIONS:
        return
    library, found = load_cyclonedds(), c_void_p()
    library.dds_get_entity_sertype.argtypes = [c_int32, POINTER(c_void_p)]
    if library.dds_get_entity_sertype(topic._ref, byref(found)) != 0:
        return
    type = cast(found, POINTER(POINTER(c_void_p)))  # the first member of a type is its table of functions
    count, removed = TYPE_FUNCTIONS[version("cyclonedds").split(".")[0]]
    functions = (c_void_p * count)(*(type[0][i] for i in range(count)))
    for i in removed:
        functions[i] = None
    _TABLES.append(functions)
    type[0] = cast(functions, POINTER(c_void_p))


def _field(layout: Any) -> Any:
    """Return the type of a field, by rosbags' description of it: (node type, details)."""
    from cyclonedds.idl import types

    node, details = int(layout[0]), layout[1]
    if node == 1:
        base = details[0]
        if base in ("string", "wstring"):
            return str
        return bool if base == "bool" else getattr(types, {"octet": "byte", "char": "uint8"}.get(base, base))
    if node == 2:
        return idl_type(details)
    inner, length = details
    return types.array[_field(inner), length] if node == 3 else types.sequence[_field(inner)]
