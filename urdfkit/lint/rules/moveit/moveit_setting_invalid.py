"""M109 moveit-setting-invalid."""

from __future__ import annotations

from urdfkit.defect_message import DefectMessage, Suggestion
from urdfkit.lint.facts.control.yaml_tree import not_a_number, number_of, span_of
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.facts.control.yaml_tree import Node
    from urdfkit.lint.facts.moveit.settings import MoveitEntry


class MoveitSettingInvalid(RobotRule):
    """A solver, planner, joint limit or MoveIt controller has a misspelt name or an impossible value.

    ## What it does
    Checks the YAML files of packages with an SRDF of the robot for:

    - misspelt parameters, solvers, planners, plugins, actions and controller types
    - values of the wrong type, and groups and controllers without a required parameter
    - limits that are negative, zero while ``has_…_limits`` is true, or far beyond those of the robot
    - ``has_…_limits`` that is not a boolean, is true without a limit, or is false for a single joint with a limit
    - solver timeouts that are not positive, and default scaling factors above 1
    - Cartesian limits that are missing or have the wrong sign
    - solvers for kinematic chains in groups with several branches, and arms of three or four joints whose solver has no
      ``position_only_ik``
    - joints of a group that no controller moves, and projections with joints of another group

    ## Why is this bad?
    MoveIt ignores misspelt parameters. With a limit of zero, time parameterisation of trajectories fails. A trajectory
    for a joint without a controller is not executed. In ROS 2, move_group stops if ``has_velocity_limits``,
    ``has_acceleration_limits`` or ``has_jerk_limits`` is not a boolean; in ROS 1, it ignores the value.

    ## Example
    ```diff
     joint_limits:
       elbow:
         has_velocity_limits: true
    -    max_velocity: -1.5
    +    max_velocity: 1.5
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "M109"
    name = "moveit-setting-invalid"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invalid parameter."""
        from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
        from urdfkit.lint.facts.launch.ros_version import ros_version
        from urdfkit.lint.facts.moveit.cartesian_limits import cartesian_limit_defects
        from urdfkit.lint.facts.moveit.entry_defects import incomplete_entries, uncontrolled_joints, unused_limits
        from urdfkit.lint.facts.moveit.group_joints import orientation_out_of_reach, projection_defects, without_chain
        from urdfkit.lint.facts.moveit.planning import planning_defects
        from urdfkit.lint.facts.moveit.settings import entries, moveit_yamls
        from urdfkit.lint.facts.moveit.srdf import groups

        texts = {name: source.text for name, source in model.related_files.items()}
        for source, root in moveit_yamls(model):
            is_ros2 = "moveit_simple_controller_manager:" in source.text or PARAMETERS in source.text
            has_manager = any(
                "moveit_controller_manager" in text for name, text in texts.items() if name != source.file
            )
            defects = [
                *(defect for entry in entries(source) for defect in _defects(entry, model)),
                *planning_defects(source, groups(root)),
                *incomplete_entries(source, is_ros2, has_manager),
                *cartesian_limit_defects(source),
                *unused_limits(source),
                *(without_chain(source, root, model.robot) if not model.is_incomplete else ()),
                *(orientation_out_of_reach(source, root, model.robot) if not model.is_incomplete else ()),
                *(uncontrolled_joints(source, root, model.robot) if not model.is_incomplete else ()),
            ]
            for node, message in defects:
                yield self.at_span(span_of(source, node), message, names=(node.text,))
            others = [text for name, text in texts.items() if name != source.file]
            for node, message, names in projection_defects(source, root, model.robot, others):
                kind = "foreign" if names else ""
                yield self.at_span(span_of(source, node), message, kind=kind, names=names or (node.text,))
            stops = ros_version(source) == 2
            for key, node, message in (flag for entry in entries(source) for flag in _not_boolean(entry)):
                severity = "error" if stops and key in _READ_BY_MOVEIT2 else self.severity
                yield self.at_span(span_of(source, node), message, severity=severity)


def _defects(entry: MoveitEntry, model: Model) -> Iterator[tuple[Node, str]]:
    from urdfkit.lint.facts.moveit.entry_defects import controller_defects, limit_defects

    if entry.kind == "group":
        yield from _group(entry)
    elif entry.kind == "joint":
        yield from _joint(entry)
        yield from limit_defects(entry, model.robot.joint_by_name.get(entry.name.text))
    else:
        yield from _controller(entry)
        yield from controller_defects(entry)


def _misspelt(entry: MoveitEntry, names: tuple[str, ...]) -> Iterator[tuple[Node, str]]:
    """Yield the misspelt parameters with their messages."""
    written = {key.text for key, _ in entry.settings.entries}
    for key, _ in entry.settings.entries:
        near = nearest(key.text, [name for name in names if name not in written], cutoff=0.85)
        if key.text not in names and near is not None:
            message = f"unknown parameter `{key.text}` of {entry.kind} `{entry.name.text}`" + Suggestion(near, key.text)
            yield key, message


def _group(entry: MoveitEntry) -> Iterator[tuple[Node, str]]:
    from urdfkit.lint.facts.moveit.settings import SOLVER_KEYS, SOLVERS

    yield from _misspelt(entry, SOLVER_KEYS)
    solver = entry.settings.find("kinematics_solver")
    near = nearest(solver.text, SOLVERS, cutoff=0.85) if solver is not None else None
    if solver is not None and near is not None and solver.text not in SOLVERS:
        yield solver, f"unknown kinematics solver `{solver.text}`" + Suggestion(near, solver.text)
    only_position = entry.settings.find("position_only_ik")
    if only_position is not None and only_position.kind == "text" and not only_position.is_plain:
        text = f'"{only_position.text}", a quoted string'
        yield only_position, f"`position_only_ik` of group `{entry.name.text}` is {text}; write true or false"
    for name in ("kinematics_solver_timeout", "kinematics_solver_search_resolution"):
        node = entry.settings.find(name)
        value = number_of(node)
        if node is not None and (problem := not_a_number(node)):
            yield node, f"`{name}` of group `{entry.name.text}` is {problem}"
        elif node is not None and value is not None and value <= 0.0:
            yield node, f"`{name}` of group `{entry.name.text}` is {value:g}; it must be positive"


_TRUTHS = ("true", "false", "yes", "no", "on", "off", "y", "n")
"""What yaml-cpp reads as a boolean."""

_READ_BY_MOVEIT2 = ("has_velocity_limits", "has_acceleration_limits", "has_jerk_limits")
"""Parameters of the robot model loader, which does not catch the exception of rclcpp for a wrong type."""


_SIGNED = ("position", "deceleration")
"""Quantities whose limit may be negative."""


def _not_boolean(entry: MoveitEntry) -> Iterator[tuple[str, Node, str]]:
    """Yield name, value and message of each ``has_…_limits`` that is neither true nor false."""
    for key, node in entry.settings.entries if entry.kind == "joint" else ():
        is_flag = key.text.startswith("has_") and key.text.endswith("_limits")
        if is_flag and node.kind == "text" and node.text and node.text.lower() not in _TRUTHS and "$" not in node.text:
            yield key.text, node, f"`{key.text}` of joint `{entry.name.text}` is `{node.text}`; write true or false"


def _joint(entry: MoveitEntry) -> Iterator[tuple[Node, str]]:
    from urdfkit.lint.facts.moveit.settings import LIMIT_KEYS

    settings, joint = entry.settings, entry.name.text
    found = list(_misspelt(entry, LIMIT_KEYS))
    suggestions = [DefectMessage.of(message).suggestion for _, message in found]
    meant = {each.meant for each in suggestions if each is not None}
    yield from found
    for key, node in settings.entries:
        quantity, _, kind = key.text.removeprefix("has_").rpartition("_")
        is_flag = key.text.startswith("has_") and kind == "limits"
        if is_flag and node.text.lower() in ("true", "yes", "on"):
            limit = settings.find(f"max_{quantity}")
            value = number_of(limit)
            if limit is None and key.text in LIMIT_KEYS and f"max_{quantity}" not in meant:
                yield key, f"`{key.text}` of joint `{joint}` is true, but `max_{quantity}` is missing"
            elif quantity == "position" and settings.find("min_position") is None:
                yield key, f"`{key.text}` of joint `{joint}` is true, but `min_position` is missing"
            elif limit is not None and value is not None and value >= 0.0 and quantity == "deceleration":
                yield (
                    limit,
                    f"`max_{quantity}` of joint `{joint}` is {value:g}; the Pilz planner requires a negative value",
                )
            elif limit is not None and value is not None and value <= 0.0 and quantity not in _SIGNED:
                yield limit, f"`max_{quantity}` of joint `{joint}` is {value:g}; it must be positive"
        elif key.text.startswith("max_") and settings.find(f"has_{key.text[4:]}_limits") is None:
            value = number_of(node)
            if value is not None and value < 0.0 and key.text[4:] not in _SIGNED and key.text in LIMIT_KEYS:
                yield node, f"`{key.text}` of joint `{joint}` is {value:g}; it must be positive"
    lower, upper = settings.find("min_position"), settings.find("max_position")
    values = number_of(lower), number_of(upper)
    if lower is not None and values[0] is not None and values[1] is not None and values[0] >= values[1]:
        yield lower, f"`min_position` of joint `{joint}` is {values[0]:g}, not less than `max_position` {values[1]:g}"


def _controller(entry: MoveitEntry) -> Iterator[tuple[Node, str]]:
    from urdfkit.lint.facts.moveit.settings import CONTROLLER_KEYS, CONTROLLER_TYPES, OTHER_CONTROLLER_TYPES

    yield from _misspelt(entry, CONTROLLER_KEYS)
    kind = entry.settings.find("type")
    if kind is not None and kind.text not in (*CONTROLLER_TYPES, *OTHER_CONTROLLER_TYPES):
        near = nearest(kind.text, CONTROLLER_TYPES, cutoff=0.75)
        if near is not None:
            yield kind, f"unknown type `{kind.text}` of controller `{entry.name.text}`" + Suggestion(near, kind.text)
