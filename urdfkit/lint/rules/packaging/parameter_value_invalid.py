"""K971 parameter-value-invalid."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.facts.control.yaml_tree import Node

_POSITIVE = frozenset(
    (
        *("update_rate", "publish_rate", "state_publish_rate", "action_monitor_rate", "wheelbase"),
        *("wheels_per_side", "front_wheel_track", "rear_wheel_track", "traction_wheels_radius"),
        *("traction_track_width", "steering_track_width", "wheel_separation_multiplier", "wheel_radius_multiplier"),
    )
)
_NOT_NEGATIVE = frozenset(
    (
        *("goal_time", "stopped_velocity_tolerance", "cmd_vel_timeout", "cmd_timeout", "max_velocity", "trajectory"),
        *("max_acceleration", "max_jerk", "max_deceleration", "velocity_rolling_window_size", "goal", "max_effort"),
        *("wheel_separation", "wheel_radius"),  # in ros_controllers, zero stands for the value in the URDF
    )
)
"""Parameters of controllers with their range (ros_controllers, ros2_controllers: *_parameters.yaml)."""

_MISSPELT = r"[Tt](?:ure|reu|ru|rie|ruee|tue|reue)|[Ff](?:asle|lase|ales|als|alsee|lse|ase)"
_SENSOR_CONFIG = r"(?:odom|imu|pose|twist)\d+_config"


class ParameterValueInvalid(RobotRule):
    """A parameter in YAML has an impossible value, or is written twice.

    ## What it does
    Checks YAML files of the robot's package and of packages that depend on it: keys that occur twice in a group,
    misspelt ``true`` and ``false``, sensor configurations of robot_localization without 15 values. In the parameters of
    controllers it also checks rates, wheel sizes, limits and tolerances that are negative, zero or not a number,
    minima above maxima, and joints that are listed twice.

    ## Why is this bad?
    The controller does not start, or the value is ignored: of a key that occurs twice, only the last value applies.

    ## Example
    ```yaml
    controller_manager:
      ros__parameters:
        update_rate: -100
        arm_controller:
          type: joint_trajectory_controller/JointTrajectoryController
    ```

    ## Use instead
    ```yaml
    controller_manager:
      ros__parameters:
        update_rate: 100
        arm_controller:
          type: joint_trajectory_controller/JointTrajectoryController
    ```
    """

    code = "K971"
    name = "parameter-value-invalid"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each impossible value and each repeated key."""
        from urdfkit.lint.facts.control.controller_joints import controllers
        from urdfkit.lint.facts.control.yaml_tree import documents, span_of, walk, yamls

        for source in yamls(model):
            is_of_controllers, seen = bool(controllers(source)), set[tuple[int, int]]()
            for node in (node for root in documents(source)[0] for node in walk(root)):
                if (node.line, node.column) in seen:  # an alias
                    continue
                seen.add((node.line, node.column))
                for place, message in (*_in_any(node), *(_in_controllers(node) if is_of_controllers else ())):
                    yield Finding(self.code, self.name, self.severity, message, span_of(source, place))


def _in_any(node: Node) -> Iterator[tuple[Node, str]]:
    first: dict[str, Node] = {}
    for key, value in node.entries:
        before = first.setdefault(key.text, key)
        # rcl merges the parameters of a ROS 2 node that is named twice.
        if before is not key and key.text != "<<" and not _has_parameters(value):
            yield key, f"duplicate key `{key.text}`; the first is in line {before.line}; only the last value applies"
        if value.is_plain and re.fullmatch(_MISSPELT, value.text):
            yield value, f"`{value.text}` is a text; did you mean `{'true' if value.text[0] in 'tT' else 'false'}`?"
        if re.fullmatch(_SENSOR_CONFIG, key.text) and value.kind == "list" and len(value.items) != 15:
            yield key, f"`{key.text}` has {len(value.items)} values; robot_localization requires 15"


def _in_controllers(node: Node) -> Iterator[tuple[Node, str]]:
    numbers = {key.text: value for key, value in node.entries if value.kind == "text" and "$" not in value.text}
    for name, value in numbers.items():
        if name not in _POSITIVE and name not in _NOT_NEGATIVE:
            continue
        number = _number(value)
        if number is None:
            yield value, f"`{name}` is `{value.text}`, which is not a number"
        elif number < 0.0 or (number == 0.0 and name in _POSITIVE):
            yield value, f"`{name}` is {number:g}; it must {'be positive' if name in _POSITIVE else 'not be negative'}"
    if {"p", "i", "d"} <= numbers.keys():
        for name in "pid":
            if (gain := _number(numbers[name])) is not None and gain < 0.0:
                yield numbers[name], f"gain `{name}` is {gain:g}; it must not be negative"
    for name, value in numbers.items():
        lower, upper = _number(value), _number(numbers.get(f"max_{name[4:]}")) if name.startswith("min_") else None
        if lower is not None and upper is not None and lower > upper >= 0.0:
            yield value, f"`{name}` {lower:g} is greater than `max_{name[4:]}` {upper:g}"
    for key, value in node.entries:
        listed: set[str] = set()
        for item in value.items if key.text in ("joints", "left_wheel_names", "right_wheel_names") else ():
            if item.text and item.text in listed:
                yield item, f"`{item.text}` occurs twice in `{key.text}`"
            listed.add(item.text)


def _has_parameters(node: Node) -> bool:
    from urdfkit.lint.facts.control.yaml_tree import walk

    return any(inner.find("ros__parameters") is not None for inner in walk(node))


def _number(node: Node | None) -> float | None:
    try:
        return float(node.text) if node is not None else None
    except ValueError:
        return None
