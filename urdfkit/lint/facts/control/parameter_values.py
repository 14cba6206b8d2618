"""Values of parameters of controllers that their nodes refuse: types, ranges, missing types and parameters.

Sources: ros2_controllers, *_parameters.yaml (Humble to Rolling), ros_controllers (Noetic).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.control.parameter_defects import SIGNS, SIGNS_OF_MINIMA, sign_defect
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import ControllerSettings, settings
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, declared
from urdfkit.lint.facts.control.yaml_tree import Node, documents, not_a_number, number_of, walk

_POSITIVE = frozenset(
    (
        *("update_rate", "publish_rate", "state_publish_rate", "action_monitor_rate", "wheelbase"),
        *(
            "velocity_rolling_window_size",
            "wheels_per_side",
            "front_wheel_track",
            "rear_wheel_track",
            "traction_wheels_radius",
        ),
        *("traction_track_width", "steering_track_width", "wheel_separation_multiplier", "wheel_radius_multiplier"),
    )
)
_POSITIVE_IN_ROS2 = frozenset(("wheel_separation", "wheel_radius"))
"""Zero stands for the value in the URDF in ros_controllers."""

_NOT_NEGATIVE = frozenset(
    (
        *("goal_time", "stopped_velocity_tolerance", "cmd_vel_timeout", "cmd_timeout", "max_velocity", "trajectory"),
        *("max_acceleration", "max_jerk", "velocity_rolling_window_size", "goal", "max_effort"),
        *("wheel_separation", "wheel_radius", "goal_tolerance", "stall_timeout", "stall_velocity_threshold"),
    )
)
_OF_ANY_SIGN = frozenset(("min_velocity", "min_acceleration", "min_jerk"))
_LISTS_TOO = frozenset(
    (
        *("min_velocity", "min_acceleration", "min_jerk", "max_velocity", "max_acceleration", "max_jerk"),
        *("goal", "trajectory"),
    )
)
"""Numbers in controllers that are lists in other nodes."""

_TRUTHS = frozenset(
    (
        *("allow_partial_joints_goal", "open_loop", "open_loop_control", "enable_odom_tf", "position_feedback"),
        *("use_stamped_vel", "publish_limited_velocity", "allow_stalling", "use_sim_time", "angle_wraparound"),
        *("allow_nonzero_velocity_at_trajectory_end", "allow_integration_in_goal_trajectories", "use_local_topics"),
        *(f"has_{name}_limits" for name in ("velocity", "acceleration", "jerk", "position", "deceleration")),
    )
)
_QUOTED = {"true": "true", "yes": "true", "on": "true", "false": "false", "no": "false", "off": "false"}
_LISTS = frozenset(("joints", "command_interfaces", "state_interfaces", "left_wheel_names", "right_wheel_names"))

_TRAJECTORIES = {
    f"{kind}_controllers/JointTrajectoryController": ("joints", "gains") for kind in ("velocity", "effort")
}
_REQUIRED = {
    **_TRAJECTORIES,
    "position_controllers/JointTrajectoryController": ("joints",),
    "joint_trajectory_controller/JointTrajectoryController": ("joints", "command_interfaces", "state_interfaces"),
    "forward_command_controller/ForwardCommandController": ("joints", "interface_name"),
    "parallel_gripper_action_controller/GripperActionController": ("joint",),
    **{f"{kind}_controllers/GripperActionController": ("joint",) for kind in ("position", "effort")},
    **{
        f"{kind}_controllers/JointGroup{kind.title()}Controller": ("joints",)
        for kind in ("position", "velocity", "effort")
    },
    **{
        f"{kind}_controllers/Joint{name}Controller": ("joint",)
        for kind in ("position", "velocity", "effort")
        for name in ("Position", "Velocity", "Effort")
    },
}
"""Controller type → parameters without a default."""

_INTERPOLATIONS = ("splines", "none")
"""Values of ``interpolation_method`` (joint_trajectory_controller, interpolation_methods.hpp)."""

_INTERFACES = frozenset(("command_interfaces", "state_interfaces"))
_FLOORS = {"min_velocity": "the robot cannot stop", "min_acceleration": "the robot cannot slow down"}
"""Lower limit → the effect of a positive value (diff_drive_controller, speed_limiter.cpp)."""

_WHEELS = (("left_wheel_names", "right_wheel_names"), ("left_wheel", "right_wheel"))
CORNER = "_wheel_command_joint_name"
"""End of the parameters of ``mecanum_drive_controller`` (Jazzy to Rolling) that name the joint of one wheel."""

Defects = Iterator[tuple[Node, str]]


def value_defects(node: Node, is_ros2: bool) -> Defects:
    """Yield the values of one mapping, in a file with controllers, that have the wrong type or range."""
    values = {key.text: value for key, value in node.entries if "$" not in value.text}
    for name, value in values.items():
        yield from _of_number(name, value, is_ros2)
        truth = _QUOTED.get(value.text.lower()) if name in _TRUTHS and value.kind == "text" else None
        if truth is not None and not value.is_plain:
            yield value, f'`{name}` is "{value.text}", a quoted string; write {truth}'
        elif name in _TRUTHS and value.kind == "text" and value.is_plain and value.text in ("0", "1"):
            yield value, f"`{name}` is {value.text}; write {'true' if value.text == '1' else 'false'}"
        if name in _LISTS and value.kind == "text" and value.text:
            kind = values["type"].text if "type" in values else ""
            is_single = name == "joints" and re.search(r"/Joint(Position|Velocity|Effort)Controller$", kind)
            yield value, f"`{kind}` reads `joint`, not `joints`" if is_single else f"`{name}` is a string; write a list"
        for inner in value.entries if name == "velocity_ff" else ():
            if problem := not_a_number(inner[1]):
                yield inner[1], f"`{inner[0].text}` in `velocity_ff` is {problem}"
    if {"p", "i", "d"} <= values.keys():
        for name in "pid":
            gain = number_of(values[name])
            if problem := not_a_number(values[name]):
                yield values[name], f"gain `{name}` is {problem}"
            elif gain is not None and gain < 0.0:
                yield values[name], f"gain `{name}` is {gain:g}; it must not be negative"
    for name, value in values.items():
        prefix, _, last = name.rpartition(".")
        if not last.startswith("min_"):
            continue
        above = f"{prefix}.max_{last[4:]}" if prefix else f"max_{last[4:]}"
        lower, upper = number_of(value), number_of(values.get(above))
        has_limits = (f"{prefix}." if prefix else "") + f"has_{last[4:]}_limits" in values
        if has_limits and last in _FLOORS and lower is not None and upper is not None and 0.0 < lower <= upper:
            yield value, f"`{name}` is {lower:g}, so {_FLOORS[last]}; write a value of zero or below"
        if lower is not None and upper is not None and lower > upper and upper >= 0.0:
            yield value, f"`{name}` {lower:g} is greater than `{above}` {upper:g}"
    if is_ros2:
        yield from _signs(node)
    for name in ("pose_covariance_diagonal", "twist_covariance_diagonal"):
        covariances = values.get(name)
        if covariances is not None and covariances.kind == "list" and len(covariances.items) != 6:
            yield covariances, f"`{name}` has {len(covariances.items)} values; it requires 6"
        for item in covariances.items if covariances is not None else ():
            if (number_of(item) or 0.0) < 0.0:
                yield item, f"`{name}` has {item.text}; a variance must not be negative"
    method = values.get("interpolation_method")
    if method is not None and method.text and method.text not in _INTERPOLATIONS and "joints" in values:
        yield method, f"unknown `interpolation_method` `{method.text}`; write `splines` or `none`"
    for left, right in _WHEELS:
        names = values[left].texts() if left in values and right in values else []
        counts = [len(values[side].items) for side in (left, right)] if names else [0, 0]
        per_side, each_side = values.get("wheels_per_side"), number_of(values.get("wheels_per_side"))
        if counts[0] != counts[1] and min(counts) > 0:
            few, many = (left, right) if counts[0] < counts[1] else (right, left)
            yield values[few], f"`{few}` has {min(counts)} wheels, but `{many}` has {max(counts)}"
        elif per_side is not None and each_side is not None and counts[0] and each_side != counts[0]:
            yield per_side, f"`wheels_per_side` is {each_side:g}, but `{left}` has {counts[0]} wheels"
        opposite = [values[right], *values[right].items] if names else []
        for item in opposite:
            if item.text and item.text in names:
                yield item, f"wheel `{item.text}` is in `{left}` and in `{right}`"
    corners = [name for name, value in values.items() if name.endswith(CORNER) and value.text]
    for joint in {values[name].text: None for name in corners}:
        named = [name for name in corners if values[name].text == joint]
        wrong = next((name for name in named[::-1] if name.removesuffix(CORNER) not in joint), named[-1])
        others = " and of ".join(f"`{name}`" for name in named if name != wrong)
        if others:
            yield values[wrong], f"`{joint}` is the joint of `{wrong}` and of {others}"


def repeated_joints(node: Node) -> Iterator[tuple[Node, str, tuple[str, ...]]]:
    """Yield the joints that a list of one mapping has twice, and the name that the list lacks in their place."""
    for key, value in node.entries:
        listed: set[str] = set()
        for item in value.items if key.text in ("joints", "left_wheel_names", "right_wheel_names") else ():
            if item.text and item.text in listed:
                lacking = next(filter(None, (_without_entry(value, node.find(name)) for name in _OF_JOINTS)), "")
                hint = f"; `{lacking}` is missing" if lacking else ""
                yield item, f"`{item.text}` occurs twice in `{key.text}`" + hint, (lacking,) if lacking else ()
            listed.add(item.text)


_OF_JOINTS = ("constraints", "gains")
"""Parameters of controllers with a group for each joint."""


def _without_entry(joints: Node, group: Node | None) -> str:
    """Return the only name with tolerances or gains that a list of joints lacks; empty if there is no such name."""
    named = [key.text for key, value in group.entries if value.kind == "group"] if group is not None else []
    lacking = [name for name in named if name not in joints.texts()]
    return lacking[0] if len(lacking) == 1 else ""


def _of_number(name: str, value: Node, is_ros2: bool) -> Defects:
    last = name.rpartition(".")[2]
    if last not in _POSITIVE | _NOT_NEGATIVE | _OF_ANY_SIGN:
        return
    if value.kind != "text" and (value.kind == "group" or last in _LISTS_TOO):
        return
    if problem := not_a_number(value):
        yield value, f"`{name}` is {problem}"
        return
    number = number_of(value) if last not in _OF_ANY_SIGN else None
    is_positive = last in _POSITIVE or (is_ros2 and last in _POSITIVE_IN_ROS2)
    if number is not None and (number < 0.0 or (number == 0.0 and is_positive)):
        yield value, f"`{name}` is {number:g}; it must {'be positive' if is_positive else 'not be negative'}"


def _signs(node: Node) -> Defects:
    """Yield the limits of the linear and angular velocity, with dots or nested, that diff_drive_controller refuses."""
    for axis in ("linear.x", "angular.z"):
        limits = _below(node, axis)
        signs = SIGNS | (SIGNS_OF_MINIMA if not SIGNS.keys().isdisjoint(limits) else {})
        for name, value in limits.items():
            number = number_of(value)
            defect = sign_defect(f"{axis}.{name}", number, signs.get(name, 0)) if number is not None else None
            if defect is not None:
                yield value, defect


def _below(node: Node, path: str) -> dict[str, Node]:
    """Return the values below a path of names that are nested or joined by dots: name → value."""
    found = {}
    for key, value in node.entries:
        if key.text.startswith(f"{path}."):
            found[key.text.removeprefix(f"{path}.")] = value
        elif key.text == path:
            found |= {inner.text: each for inner, each in value.entries}
        elif path.startswith(f"{key.text}."):
            found |= _below(value, path.removeprefix(f"{key.text}."))
    return found


def incomplete_controllers(source: Source, is_typed_at_start: bool) -> Defects:
    """Yield controllers without a type or a required parameter, and parameters at the level of controllers.

    Args:
        source: a YAML file of controllers.
        is_typed_at_start: whether a launch file passes types of controllers to the spawner.
    """
    names: dict[int, list[Node]] = {}
    for root in documents(source):
        for node in walk(root):
            for key, value in node.entries:
                inner = value.find(PARAMETERS)
                names.setdefault(id(inner if inner is not None else value), []).append(key)
            if not is_typed_at_start:
                yield from _untyped(root, node)
            yield from _misplaced(root, node)
    for one in settings(source):
        yield from _at_other_level(one)
        yield from _without_gains(one)
        yield from _without_axis(one)
    for one in _with_parameters(source):
        written = {key.text for key, _ in one.group.entries}
        name = next(iter(names.get(id(one.group), ())), None)
        for parameter in _REQUIRED.get(one.kind, ()) if "<<" not in written else ():
            # Without both interfaces, another file or the spawner sets them.
            is_elsewhere = parameter in _INTERFACES and not written & _INTERFACES
            if name is not None and parameter not in written and not is_elsewhere and not _is_near(parameter, one):
                yield name, f"controller `{one.name}` has no `{parameter}`"


def _without_axis(one: ControllerSettings) -> Defects:
    """Yield the limits of axes along which a differential drive does not move."""
    for name, axis in (("linear", "x"), ("angular", "z")) if one.kind.startswith("diff_drive_controller/") else ():
        for key, value in one.group.entries:
            others = {*"xyz"} - {axis}
            for inner in (inner for inner, _ in value.entries if key.text == name and inner.text in others):
                yield inner, f"controller `{one.name}` does not read `{inner.text}` of `{name}`; write `{axis}`"
            first, _, inner_name = key.text.partition(".")
            if first == name and inner_name[:1] in others and inner_name[1:2] in ("", "."):
                yield key, f"controller `{one.name}` does not read `{key.text}`; write `{name}.{axis}{inner_name[1:]}`"


def _without_gains(one: ControllerSettings) -> Defects:
    """Yield the ``gains`` of a trajectory controller that lack some of its joints but not all of them."""
    gains, joints = one.group.find("gains"), one.group.find("joints")
    key = next((key for key, value in one.group.entries if value is gains), None)
    if key is None or gains is None or joints is None or not one.kind.endswith("/JointTrajectoryController"):
        return
    written = {each.text.partition(".")[0] for each, _ in gains.entries}
    lacking = [each.text for each in joints.items if each.text not in written]
    names = ", ".join(f"`{name}`" for name in lacking)
    is_partial = 0 < len(lacking) < len(joints.items) and len(lacking) + len(written) == len(joints.items)
    if is_partial and "<<" not in written:
        yield key, f"`gains` of controller `{one.name}` lacks joint {names}"


def _at_other_level(one: ControllerSettings) -> Defects:
    """Yield tolerances outside of ``constraints``, and parameters inside of the values of joints."""
    if not one.kind.endswith("/JointTrajectoryController"):
        return
    for key, value in one.group.entries:
        if key.text in ("goal_time", "stopped_velocity_tolerance"):
            yield key, f"`{key.text}` of controller `{one.name}` belongs below `constraints`; indent it"
        for inner, _ in value.entries if key.text in ("gains", "velocity_ff", "constraints") else ():
            if inner.text in _OF_CONTROLLERS:
                yield inner, f"`{inner.text}` of controller `{one.name}` is in `{key.text}`; indent it less"


def _with_parameters(source: Source) -> Iterator[ControllerSettings]:
    """Yield the settings of the controllers whose parameters the file has."""
    if PARAMETERS not in source.text:
        yield from settings(source)
        return
    for one in declared(source):
        if one.settings is not None:
            yield ControllerSettings(one.name, one.kind.text, one.settings)


def _is_near(parameter: str, one: ControllerSettings) -> bool:
    """Return whether a parameter is missing because it is misspelt, or written as `command_joints` or with dots."""
    from urdfkit.lint.fix_builders import nearest

    written = [key.text for key, _ in one.group.entries]
    if any(name.startswith(f"{parameter}.") for name in written):
        return True
    return nearest(parameter, written, cutoff=0.8) is not None


def _has_type(node: Node | None) -> bool:
    kind = node.find("type") if node is not None else None
    return kind is not None and re.fullmatch(r"[\w-]+(/|::)[\w-]+", kind.text) is not None


def _untyped(root: Node, node: Node) -> Defects:
    """Yield the controllers without a type next to controllers with a type."""
    typed = [key for key, value in node.entries if _has_type(value)]
    if not typed:
        return
    sections = {key.text: value.find(PARAMETERS) for key, value in root.entries if value.find(PARAMETERS) is not None}
    is_manager = any(value is node for value in sections.values())
    for key, value in node.entries:
        section = sections.get(key.text)
        if value.find("type") is not None or not re.search(r"_(controller|broadcaster)$", key.text):
            continue
        is_empty = value.kind == "group" or (value.is_plain and not value.text)
        parameters = {inner.text for inner, _ in value.entries}
        near = any(re.fullmatch(r"t\w{2,4}e?", name) for name in parameters - {"tf"})
        if is_manager:
            has_type = section is not None and section.find("type") is not None
            if is_empty and not has_type and not near and (section is not None or not parameters):
                yield key, f"controller `{key.text}` has no `type`"
        elif parameters & {"joints", "joint", "publish_rate", "gains", "constraints", "left_wheel"} and not near:
            yield key, f"controller `{key.text}` has no `type`"


_OF_CONTROLLERS = frozenset(
    (
        *("constraints", "gains", "velocity_ff", "publish_rate", "action_monitor_rate"),
        *("command_interfaces", "state_interfaces", "allow_partial_joints_goal", "left_wheel_names", "goal_tolerance"),
        *("right_wheel_names", "wheel_separation", "wheel_radius", "allow_stalling", "open_loop_control"),
    )
)


def _misplaced(root: Node, node: Node) -> Defects:
    """Yield parameters of a controller next to controllers, and ``ros__parameters`` without a node."""
    has_sections = any(value.find(PARAMETERS) is not None for _, value in root.entries)
    is_of_types = any(_has_type(value) for _, value in node.entries)
    for key, _ in node.entries:
        if key.text in _OF_CONTROLLERS and (is_of_types or (node is root and has_sections)):
            yield key, f"`{key.text}` is at the level of the controllers, not in a controller; indent it"
        elif key.text == PARAMETERS and node is root and has_sections:
            yield key, f"`{PARAMETERS}` does not belong to a node; indent it below the name of a node"


def contradictions(source: Source, robot: Robot) -> Defects:
    """Yield tolerances of grippers that are larger than the range of their joint."""
    for one in settings(source):
        joint, tolerance = one.group.find("joint"), one.group.find("goal_tolerance")
        moved = robot.joint_by_name.get(joint.text) if joint is not None else None
        value = number_of(tolerance)
        if moved is None or moved.limit is None or tolerance is None or value is None or moved.type == "continuous":
            continue
        stroke = (moved.limit.upper or 0.0) - (moved.limit.lower or 0.0)
        if 0.0 < stroke <= value:
            unit = "m" if moved.type == "prismatic" else "rad"
            message = f"`goal_tolerance` is {value:g} {unit}, but joint `{moved.name}` moves only {stroke:g} {unit}"
            yield tolerance, message
