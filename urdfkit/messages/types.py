"""The ROS message types in use, from rosbags' typestore (ROS 2 definitions), and short constructors.

rosbags and numpy are imported on first use, not with this module. Twists are linear first; quaternions x, y, z, w.
"""

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

TWIST = "geometry_msgs/msg/Twist"
ODOMETRY = "nav_msgs/msg/Odometry"
JOINT_STATE = "sensor_msgs/msg/JointState"
TF = "tf2_msgs/msg/TFMessage"
CLOCK = "rosgraph_msgs/msg/Clock"
BOOL = "std_msgs/msg/Bool"
FLOAT = "std_msgs/msg/Float64"
FLOATS = "std_msgs/msg/Float64MultiArray"
TWIST_STAMPED = "geometry_msgs/msg/TwistStamped"
TRAJECTORY = "trajectory_msgs/msg/JointTrajectory"
JOINT_CONTROLLER_STATE = "control_msgs/msg/JointControllerState"
TRAJECTORY_STATE = "control_msgs/msg/JointTrajectoryControllerState"


def require_message_types() -> None:
    """Check that rosbags is installed, without importing it, which takes a tenth of a second.

    Raises:
        MissingDependencyError: it is not.

    Examples:
        >>> from urdfkit.messages import require_message_types
        >>> require_message_types()  # no error: rosbags is installed
    """
    from importlib.util import find_spec

    from urdfkit.errors import MissingDependencyError

    if find_spec("rosbags") is None:
        raise MissingDependencyError("messages need rosbags: pip install 'urdfkit[sim]'")


_MODULE = "rosbags.usertypes"
"""Module in which pickle finds the classes of registered types."""


@cache
def message_type(name: str) -> Any:
    """Return the class of a message type such as ``geometry_msgs/msg/Twist``.

    Raises:
        UsageError: no such type, with the nearest one.
        MissingDependencyError: rosbags is not installed.
    """
    from urdfkit.errors import MissingDependencyError, UsageError, did_you_mean

    types = _types()
    if types is None:
        raise MissingDependencyError("messages need rosbags: pip install 'urdfkit[sim]'")
    full = full_type_name(name)
    if full not in types:
        raise UsageError(f"no message type `{name}`{did_you_mean(full, types)}")
    return types[full]


@cache
def _store() -> Any:
    """Return rosbags' typestore with the messages it lacks; None without rosbags."""
    from urdfkit.messages.control import CONTROL_MESSAGES
    from urdfkit.messages.sensors import SENSOR_MESSAGES
    from urdfkit.messages.services import SERVICE_MESSAGES
    from urdfkit.messages.simulation import WORLD_MESSAGES
    from urdfkit.messages.simulation_interfaces import SIMULATION_INTERFACES
    from urdfkit.messages.vision import VISION_MESSAGES

    try:
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    except ImportError:
        return None
    definitions_by_name = (
        CONTROL_MESSAGES | WORLD_MESSAGES | SENSOR_MESSAGES | VISION_MESSAGES | SERVICE_MESSAGES | SIMULATION_INTERFACES
    )
    store = get_typestore(Stores.ROS2_HUMBLE)
    definitions: dict[str, Any] = {}
    for name, text in definitions_by_name.items():
        (definitions[name],) = get_types_from_msg(text, name).values()  # whose own key has /msg/ in it for services too
    store.register(definitions)
    return store


@cache
def _types() -> dict[str, Any] | None:
    store = _store()
    return None if store is None else dict(store.types)


def typestore() -> Any:
    """Return rosbags' typestore, with the messages that it lacks.

    Raises:
        MissingDependencyError: rosbags is not installed.

    Examples:
        >>> from urdfkit.messages import typestore
        >>> "control_msgs/msg/JointControllerState" in typestore().types
        True
    """
    from urdfkit.errors import MissingDependencyError

    if (found := _store()) is None:
        raise MissingDependencyError("messages need rosbags: pip install 'urdfkit[sim]'")
    return found


def register_types(name: str, text: str) -> dict[str, Any]:
    """Add the types of a definition that were unknown; return type → layout of all that it contains.

    Args:
        name: of the type that the text defines, e.g. ``lab_msgs/msg/Arm``.
        text: definition in the notation of ``.msg`` files, with those of its fields as publishers send it.

    Raises:
        UsageError: the text is no definition.

    Examples:
        >>> from urdfkit.messages import from_fields, register_types
        >>> sorted(register_types("lab_msgs/msg/Grip", "float64 force"))
        ['lab_msgs/msg/Grip']
        >>> from_fields("lab_msgs/msg/Grip", {"force": 2.5}).force
        2.5
    """
    from rosbags.typesys import TypesysError, get_types_from_msg

    from urdfkit.errors import UsageError

    try:
        found: dict[str, Any] = get_types_from_msg(text, name)
        register_layouts(found)
    except TypesysError as error:
        raise UsageError(f"the definition of {name} cannot be read: {str(error).splitlines()[0]}") from error
    return found


def register_in(store: Any, layouts: Mapping[str, Any]) -> None:
    """Add types to a typestore; pickle still finds the earlier classes, whose module rosbags replaces.

    Examples:
        >>> import rosbags.typesys
        >>> from urdfkit.messages import register_in, typestore
        >>> store = rosbags.typesys.get_typestore(rosbags.typesys.Stores.EMPTY)
        >>> register_in(store, {"lab_msgs/msg/Lamp": typestore().fielddefs["std_msgs/msg/Bool"]})
        >>> "lab_msgs/msg/Lamp" in store.types
        True
    """
    import sys

    before = sys.modules.get(_MODULE)
    store.register(dict(layouts))
    if before is not None:
        for name, value in vars(sys.modules[_MODULE]).items():
            vars(before).setdefault(name, value)
        sys.modules[_MODULE] = before


def register_layouts(layouts: Mapping[str, Any]) -> None:
    """Add the unknown ones of types, by rosbags' descriptions of their fields.

    Examples:
        >>> from urdfkit.messages import from_fields, register_layouts, typestore
        >>> register_layouts({"lab_msgs/msg/Switch": typestore().fielddefs["std_msgs/msg/Bool"]})
        >>> from_fields("lab_msgs/msg/Switch", {"data": True}).data
        True
    """
    store = typestore()
    if new := {name: layout for name, layout in layouts.items() if name not in store.fielddefs}:
        register_in(store, new)
        for cached in (message_type, _types, _layouts):
            cached.cache_clear()


def full_type_name(name: str, kind: str = "msg") -> str:
    """Turn ``geometry_msgs/Twist`` into ``geometry_msgs/msg/Twist``; keep full names. Services have kind ``srv``.

    Examples:
        >>> from urdfkit.messages import full_type_name
        >>> full_type_name("geometry_msgs/Twist"), full_type_name("std_srvs/Empty", "srv")
        ('geometry_msgs/msg/Twist', 'std_srvs/srv/Empty')
    """
    parts = name.split("/")
    return f"{parts[0]}/{kind}/{parts[1]}" if len(parts) == 2 else name


def stamp(t: float) -> Any:
    """Return a ``builtin_interfaces/msg/Time`` of simulated time `t` [s], rounded to the nanosecond.

    Examples:
        >>> from urdfkit.messages import stamp
        >>> stamp(2.25).sec
        2
    """
    nanoseconds = round(t * 1e9)
    return message_type("builtin_interfaces/msg/Time")(nanoseconds // 1_000_000_000, nanoseconds % 1_000_000_000)


def header(t: float, frame_id: str) -> Any:
    """Return a ``std_msgs/msg/Header``.

    Examples:
        >>> from urdfkit.messages import header
        >>> header(1.5, "odom").stamp.nanosec
        500000000
    """
    return message_type("std_msgs/msg/Header")(stamp(t), frame_id)


def vector(xyz: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/Vector3``.

    Examples:
        >>> from urdfkit.messages import vector
        >>> vector((1.0, 2.0, 3.0)).z
        3.0
    """
    return message_type("geometry_msgs/msg/Vector3")(float(xyz[0]), float(xyz[1]), float(xyz[2]))


def twist(linear: Sequence[float], angular: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/Twist`` [m/s, rad/s].

    Examples:
        >>> from urdfkit.messages import twist
        >>> twist((0.5, 0.0, 0.0), (0.0, 0.0, 1.0)).angular.z
        1.0
    """
    return message_type(TWIST)(vector(linear), vector(angular))


def transform(t: float, frame: str, child: str, position: Sequence[float], quaternion: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/TransformStamped``: where `child` is in `frame` [m; x y z w].

    Examples:
        >>> from urdfkit.messages import transform
        >>> transform(0.0, "odom", "base_link", (1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)).transform.translation.x
        1.0
    """
    rotation = message_type("geometry_msgs/msg/Quaternion")(*(float(part) for part in quaternion))
    placement = message_type("geometry_msgs/msg/Transform")(vector(position), rotation)
    return message_type("geometry_msgs/msg/TransformStamped")(header(t, frame), child, placement)


def from_fields(type: str, fields: Any) -> Any:
    """Return a message with these fields, the others zero or empty, as ``rostopic pub`` fills them in.

    Args:
        type: its type.
        fields: field → value, nested like the message; None for no fields. A message may also be the list of its
            fields, a time or duration a number of seconds; ROS 1's ``secs``, ``nsecs`` and ``seq`` are accepted too.

    Raises:
        UsageError: no such type or field, or a value of the wrong kind.

    Examples:
        >>> from urdfkit.messages import from_fields
        >>> from_fields("geometry_msgs/msg/Twist", {"linear": {"x": 0.5}}).linear.x
        0.5
    """
    from urdfkit.errors import UsageError, did_you_mean

    full = full_type_name(type)
    kind = message_type(full)
    layout = dict(_layouts()[full][1])
    if full in _MOMENTS:
        fields = _moment(full, fields)
    elif full == "std_msgs/msg/Header" and isinstance(fields, dict):
        fields = {name: value for name, value in fields.items() if name != "seq"}
    if isinstance(fields, list) and len(fields) == len(layout):
        fields = dict(zip(layout, fields, strict=True))
    if fields is not None and not isinstance(fields, dict):
        raise UsageError(f"`{fields}` is not a {full}: write its fields, {', '.join(layout)}")
    for name in fields or {}:
        if name not in layout:
            raise UsageError(
                f"no field `{name}` in {full}{did_you_mean(str(name), layout)} (it has {', '.join(layout)})"
            )
    supplied = fields or {}
    return kind(**{name: _value(full, name, description, supplied.get(name)) for name, description in layout.items()})


_MOMENTS = ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration")


def _moment(type: str, fields: Any) -> Any:
    """Return the fields of a time or duration that may be seconds, or be written as in ROS 1.

    Raises:
        UsageError: a field is set twice, is not a number, or is out of range.
    """
    import math

    from urdfkit.errors import UsageError

    named = {"secs": "sec", "nsecs": "nanosec"}
    if isinstance(fields, dict):
        if len({named.get(name, name) for name in fields}) < len(fields):
            raise UsageError(f"`{fields}` sets the same field twice: {type} has sec and nanosec")
        fields = {named.get(name, name): value for name, value in fields.items()}
        if not isinstance(fields.get("sec"), float):
            return fields
    seconds = fields.get("sec") if isinstance(fields, dict) else fields
    if isinstance(seconds, bool) or not isinstance(seconds, int | float):
        return fields
    if not (-(2**31) if type.endswith("Duration") else 0) <= seconds < 2**31:
        raise UsageError(f"`{seconds}` is out of range for {type}: seconds, at most {2**31 - 1}")
    whole = math.floor(seconds)
    rest = round((seconds - whole) * 1e9)
    more = fields if isinstance(fields, dict) else {}
    if rest and "nanosec" in more:
        raise UsageError(f"`{fields}` sets the fraction of a second twice: {type} has sec, an integer, and nanosec")
    return {**more, "sec": whole + rest // 10**9, **({"nanosec": rest % 10**9} if rest else {})}


@cache
def _layouts() -> dict[str, Any]:
    return dict(_store().fielddefs)


@cache
def _range(base: str) -> tuple[float, float]:
    """Return the least and the greatest number of a base type."""
    import numpy as np

    if "int" not in base:
        return -np.inf, np.inf
    return int(np.iinfo(base).min), int(np.iinfo(base).max)


def _value(type: str, name: str, description: Any, value: Any) -> Any:
    """Return the value of one field, by rosbags' description of it: (node type, details).

    Raises:
        UsageError: a value of the wrong kind.
    """
    import numpy as np

    from urdfkit.errors import UsageError

    node, details = int(description[0]), description[1]
    if node == 2:
        return from_fields(details, value)
    if node == 1:
        base = details[0]
        try:
            if base == "string":
                text = "" if value is None else str(value)
                text.encode()  # raises for half of a pair of surrogates, which JSON can express
                return text
            value = 0 if value is None else value
            if base == "bool":
                return bool((False, True).index(value))  # raises for other values, such as the text "false"
            is_whole = not base.startswith("float")
            number = int(value) if is_whole else float(value)
            if is_whole and isinstance(value, float) and number != value:
                raise ValueError("an integer has no fraction")
            least, most = _range(base)
            if number < least or number > most:
                raise UsageError(f"field `{name}` of {type} is {value}; it must be {base}, {least} to {most}")
            return number
        except UnicodeEncodeError:
            raise UsageError(f"field `{name}` of {type} is {value!a}, which is not Unicode") from None
        except (TypeError, ValueError, OverflowError):
            raise UsageError(f"field `{name}` of {type} is `{value}`; it must be {base}") from None
    inner, length = details
    if isinstance(value, np.ndarray) and int(inner[0]) == 1 and str(value.dtype) == inner[1][0]:
        if node == 4 or len(value) == length:
            return value  # without a copy
        value = value.tolist()
    items = [None] * length if value is None else value
    if not isinstance(items, list) or (node == 3 and len(items) != length):
        raise UsageError(
            f"field `{name}` of {type} is `{value}`; it must be a list{f' of {length}' if node == 3 else ''}"
        )
    made = [_value(type, name, inner, item) for item in items]
    base = inner[1][0] if int(inner[0]) == 1 else "string"
    return made if base == "string" else np.array(made, dtype=base)
