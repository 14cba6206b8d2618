"""Types of messages for Cyclone DDS, from rosbags' definitions, named as ROS 2 names them."""

from functools import cache
from pathlib import Path
from typing import Any

from urdfkit.messages import typestore

PLACEHOLDER = "structure_needs_at_least_one_member"
"""Field of messages without fields in ROS 2."""

TYPE_FUNCTIONS = {"11": (14, (8, 9, 10))}
"""Major version of Cyclone DDS → length of ``struct ddsi_sertype_ops``, and its type_id, type_map and type_info."""
LOOKUP_VERSIONS = ("11.0.1",)
"""Versions of Cyclone DDS whose structures were compared with the numbers below."""
LOOKUP_TYPES = (b"DDS::Builtin::TypeLookup_Request", b"DDS::Builtin::TypeLookup_Reply")
"""Names of the types of the type lookup service."""
DOMAIN_WORDS, DATA_FUNCTIONS, TO_SAMPLE, TO_NO_SAMPLE = 1024, 18, 9, 11
"""Words of ``struct ddsi_domaingv`` that are searched; length of ``struct ddsi_serdata_ops``; the places of its
``to_sample`` and of its ``untyped_to_sample``, which does nothing for types without a key."""
NAME_WORD, DOMAIN_WORD, FUNCTIONS_WORD = 4, 5, 1
"""Members of ``struct ddsi_sertype``: its name, domain, and functions of its messages."""
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
    from ctypes import POINTER, c_void_p, cast

    if (found := _type_of(topic)) is None:
        return
    type = cast(found, POINTER(POINTER(c_void_p)))  # the first member of a type is its table of functions
    count, removed = TYPE_FUNCTIONS[_version()]
    functions = (c_void_p * count)(*(type[0][i] for i in range(count)))
    for i in removed:
        functions[i] = None
    _TABLES.append(functions)
    type[0] = cast(functions, POINTER(c_void_p))


def ignore_type_lookups(participant: Any) -> None:
    """Let a participant neither answer requests of the type lookup service nor read their answers.

    Fast DDS 3 (ROS 2 Kilted) requests types when it lists topics. Cyclone DDS also replies to requests to other
    participants, with types that it has misread; Fast DDS then never lists these topics. Cyclone DDS has no option for
    this, so its function that reads such messages is replaced by an empty function.
    """
    from contextlib import suppress
    from ctypes import addressof, c_void_p

    from cyclonedds.topic import Topic

    topic = Topic(participant, "urdfkit", idl_type("std_msgs/msg/String"))
    if (found := _type_of(topic)) is None:
        return
    memory_of_process = Path("/proc/self/mem")  # reports an error for a wrong address, where a pointer would crash
    with suppress(OSError), memory_of_process.open("rb", buffering=0) as memory:

        def words(address: int, count: int) -> tuple[int, ...]:
            memory.seek(address)
            return tuple(memoryview(memory.read(8 * count)).cast("Q"))

        for word in words(words(found, DOMAIN_WORD + 1)[DOMAIN_WORD], DOMAIN_WORDS):
            with suppress(OSError, OverflowError, TypeError, ValueError):
                memory.seek(words(word, NAME_WORD + 1)[NAME_WORD])
                if memory.read(64).split(b"\0")[0] in LOOKUP_TYPES:
                    place = c_void_p.from_address(word + 8 * FUNCTIONS_WORD)
                    functions = (c_void_p * DATA_FUNCTIONS)(*words(place.value or 0, DATA_FUNCTIONS))
                    functions[TO_SAMPLE] = functions[TO_NO_SAMPLE]
                    _TABLES.append(functions)
                    place.value = addressof(functions)


def _version() -> str:
    from importlib.metadata import version

    return version("cyclonedds").split(".")[0]


def _type_of(topic: Any) -> int | None:
    """Return the address of the type of a topic; None if the layout of this version is unknown."""
    from ctypes import POINTER, byref, c_int32, c_void_p

    from cyclonedds.internal import load_cyclonedds

    if _version() not in TYPE_FUNCTIONS:
        return None
    library, found = load_cyclonedds(), c_void_p()
    library.dds_get_entity_sertype.argtypes = [c_int32, POINTER(c_void_p)]
    return found.value if library.dds_get_entity_sertype(topic._ref, byref(found)) == 0 else None


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
