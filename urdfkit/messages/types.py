"""The ROS message types in use, from rosbags' typestore (ROS 2 definitions).

rosbags is imported on first use, not with this module.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

from urdfkit.errors import MissingDependencyError, UsageError

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
    from urdfkit.errors import did_you_mean

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


@cache
def type_layouts() -> dict[str, Any]:
    """Return the layout of each type: its constants and its fields, by rosbags' descriptions."""
    return dict(_store().fielddefs)


def typestore() -> Any:
    """Return rosbags' typestore, with the messages that it lacks.

    Raises:
        MissingDependencyError: rosbags is not installed.

    Examples:
        >>> from urdfkit.messages import typestore
        >>> "control_msgs/msg/JointControllerState" in typestore().types
        True
    """
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
        for cached in (message_type, _types, type_layouts):
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
