"""K971 parameter-value-invalid."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, span_of, walk, yamls
from urdfkit.lint.rule import Findings, Model, RobotRule

_MISSPELT = r"[Tt](?:ure|reu|ru|rie|ruee|tue|reue)|[Ff](?:asle|lase|ales|als|alsee|lse|ase)"
_SENSOR_CONFIG = r"(?:odom|imu|pose|twist)\d+_config"


class ParameterValueInvalid(RobotRule):
    """A parameter in YAML has an impossible value, is missing, or is written twice.

    ## What it does
    Checks the YAML files of the robot's package and of packages that depend on it for:

    - keys that occur twice in a group, minima above their maxima, and misspelt ``true`` and ``false``
    - for the parameters of well-known nodes and plugins, wrong types, names and levels; lists of lists in ROS 2
    - in robot_localization, a wrong world frame and sensor configurations without 15 values
    - in Nav2, plugins that are listed without a section, and limits that the nodes reject
    - in maps, a missing image, an unknown mode, impossible numbers and a resolution that contradicts the origin

    In the parameters of controllers, also checks for:

    - rates, wheel sizes, limits and tolerances that are negative, zero or not a number
    - numbers and Boolean values in quotes, and names that are not in a list
    - joints that are listed twice or lack gains, and controllers without a type or a required parameter
    - an update rate that is higher than the rate of Gazebo's physics
    - lists of joint positions that lack a value, and positions that exceed the limits of a joint because they are in
      degrees or millimetres
    - positions of a single joint, and ``initial_positions`` of MoveIt, beyond the limits
    - lists of joints whose order differs from that in the comment on their values
    - minimum velocities above zero, and parameters with the indentation of a controller name

    ## Why is this bad?
    The controller does not start, or ignores the value. If a key occurs twice, only the last value applies.

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
    -    update_rate: -100
    +    update_rate: 100
         arm_controller:
           type: joint_trajectory_controller/JointTrajectoryController
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K971"
    name = "parameter-value-invalid"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each impossible value and each repeated key."""
        from urdfkit.description.control.parameter_defects import invalid_parameters
        from urdfkit.lint.facts.control.controller_settings import misspelt_sections, sections_without_parameters
        from urdfkit.lint.facts.control.loaded_controllers import loaded_controllers
        from urdfkit.lint.facts.navigation.sections import nodes_without_parameters, outside_parameters
        from urdfkit.lint.facts.plugins.typed_groups import typed_defects

        unread = {
            source.file
            for source in yamls(model)
            if sections_without_parameters(source) or ("controller" in source.text and any(misspelt_sections(source)))
        }
        places = set()
        for finding in self._in_yaml(model, unread):
            places.add((finding.span.file, finding.span.line))
            yield finding
        for source in yamls(model):
            levels = (*outside_parameters(source), *nodes_without_parameters(source))
            for node, message in (*levels, *typed_defects(source)):
                if (source.file, node.line) not in places:
                    places.add((source.file, node.line))
                    yield self.at_span(span_of(source, node), message, kind="plugin")
        for _, settings, ros in loaded_controllers(model):
            for error in invalid_parameters(settings, ros):
                place = error.position
                if place is not None and (place.file, place.line) not in places and place.file not in unread:
                    yield self.at(model, place, error.message, kind="incomplete")

    def _in_yaml(self, model: Model, unread: set[str]) -> Findings:
        from urdfkit.lint.facts.control.controller_joints import controllers
        from urdfkit.lint.facts.control.controller_needs import unmet_needs
        from urdfkit.lint.facts.control.controller_settings import settings
        from urdfkit.lint.facts.control.parameter_values import (
            contradictions,
            incomplete_controllers,
            repeated_joints,
            value_defects,
        )
        from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
        from urdfkit.lint.facts.gazebo.update_rates import rates_above_physics
        from urdfkit.lint.facts.moveit.settings import moveit_yamls
        from urdfkit.lint.facts.navigation.collision_monitors import monitor_defects, mux_defects
        from urdfkit.lint.facts.navigation.defects import navigation_defects
        from urdfkit.lint.facts.navigation.frames import frames_with_slash
        from urdfkit.lint.facts.navigation.maps import map_defects
        from urdfkit.lint.facts.navigation.nav2_plugins import nav2_defects
        from urdfkit.lint.facts.navigation.odometry_transforms import published_twice
        from urdfkit.lint.facts.navigation.sections import costmaps_not_nested
        from urdfkit.lint.facts.parameters.joint_lists import list_defects, positions_beyond_limits
        from urdfkit.lint.facts.parameters.node_parameters import node_defects, node_defects_of_ros1
        from urdfkit.lint.facts.parameters.ranges import out_of_order

        of_moveit = {source.file for source, _ in moveit_yamls(model)}
        is_typed_at_start = any(re.search(r"controller.type", file.text) for file in model.related_files.values())
        names = frozenset(name for source in yamls(model) for name in controllers(source))
        of_workspace = (*published_twice(model), *node_defects_of_ros1(model), *positions_beyond_limits(model))
        of_workspace += tuple(rates_above_physics(model))
        for source, place, message in of_workspace:
            yield self.at_span(span_of(source, place), message)
        for source in yamls(model):
            is_of_controllers, seen = bool(controllers(source)), set[tuple[int, int]]()
            ordered = () if is_of_controllers else out_of_order(source)
            found = (*navigation_defects(source, names), *map_defects(source), *ordered, *nav2_defects(source))
            found += (*monitor_defects(source), *mux_defects(source), *frames_with_slash(source))
            for place, message in (*found, *_new(node_defects(source), found)):
                yield self.at_span(span_of(source, place), message)
            positions = list_defects(source, model.robot) if not is_of_controllers else ()
            for place, message in (*costmaps_not_nested(source), *positions):
                yield self.at_span(span_of(source, place), message)
            for node in nodes(source):
                if (node.line, node.column) in seen:  # an alias
                    continue
                seen.add((node.line, node.column))
                in_controllers = value_defects(node, PARAMETERS in source.text) if is_of_controllers else ()
                for place, message in _repeated_keys(node):
                    yield self.at_span(span_of(source, place), message, kind="key")
                for place, message in (*_in_any(node, source.file in of_moveit), *in_controllers):
                    yield self.at_span(span_of(source, place), message, names=(place.text,))
                for place, message, lacking in repeated_joints(node) if is_of_controllers else ():
                    kind = "twice" if lacking else ""
                    yield self.at_span(span_of(source, place), message, names=lacking, kind=kind)
            if is_of_controllers:
                incomplete = () if source.file in unread else incomplete_controllers(source, is_typed_at_start)
                # In ROS 1 the type, next to the parameters that it needs.
                of_ros1 = settings(source) if PARAMETERS not in source.text else ()
                types = {one.name: one.group.find("type") for one in of_ros1}
                for place, message in incomplete:
                    span = span_of(source, types.get(place.text) or place)
                    yield self.at_span(span, message, names=(place.text,), kind="incomplete")
                for place, message in (*contradictions(source, model.robot), *unmet_needs(source, model)):
                    yield self.at_span(span_of(source, place), message)


def _new(defects: Iterator[tuple[Node, str]], found: tuple[tuple[Node, str], ...]) -> Iterator[tuple[Node, str]]:
    """Yield the defects at lines without another one, and not at misspelt truth values."""
    lines = {place.line for place, _ in found}
    yield from (
        (place, message)
        for place, message in defects
        if place.line not in lines and not (place.is_plain and re.fullmatch(_MISSPELT, place.text))
    )


def _repeated_keys(node: Node) -> Iterator[tuple[Node, str]]:
    first: dict[str, Node] = {}
    for key, value in node.entries:
        before = first.setdefault(key.text, key)
        # rcl merges the parameters of a ROS 2 node that is named twice.
        if before is not key and key.text != "<<" and not _has_parameters(value):
            yield key, f"duplicate key `{key.text}`; the first is on line {before.line}; only the last value applies"


def _in_any(node: Node, is_of_moveit: bool) -> Iterator[tuple[Node, str]]:
    for key, value in node.entries:
        is_limit = is_of_moveit and re.fullmatch(r"has_\w+_limits", key.text)  # moveit-setting-invalid reports these
        if value.is_plain and re.fullmatch(_MISSPELT, value.text) and not is_limit:
            yield (
                value,
                f"`{value.text}` is a string" + Suggestion("true" if value.text[0] in "tT" else "false", value.text),
            )
        joints = node.find("joints") if key.text == "positions" and value.kind == "list" else None
        is_flat = (
            joints is not None and joints.kind == "list" and value.items and all(each.text for each in value.items)
        )
        if joints is not None and is_flat and len(joints.items) != len(value.items):
            yield key, f"`positions` has {len(value.items)} values, but `joints` has {len(joints.items)} names"
        if re.fullmatch(_SENSOR_CONFIG, key.text) and value.kind == "list" and len(value.items) != 15:
            message = f"`{key.text}` has {len(value.items)} values; robot_localization requires 15"
            yield _odd_row(value) or _last_row(value) or key, message


def _odd_row(value: Node) -> Node | None:
    """Return the first value of the only line of a list that has not three of them; None without such a line."""
    from collections import Counter

    lengths = Counter(item.line for item in value.items)
    odd = [line for line, count in lengths.items() if count != 3]
    return next(item for item in value.items if item.line == odd[0]) if len(odd) == 1 < len(lengths) else None


def _last_row(value: Node) -> Node | None:
    """Return the first value of the last line of a list with several lines."""
    lines = [item.line for item in value.items]
    return next((item for item in value.items if item.line == lines[-1] != lines[0]), None)


def _has_parameters(node: Node) -> bool:
    return any(inner.find("ros__parameters") is not None for inner in walk(node))
