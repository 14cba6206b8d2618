"""Inputs of the filters of robot_localization: names and covariances, axes that drift, and rates that are too low.

Sources: robot_localization (src/ros_filter.cpp, Noetic to Rolling), costmap_2d (costmap_2d_ros.cpp) of Noetic,
nav2_costmap_2d, nav2_controller, nav2_behaviors and nav2_collision_monitor of Jazzy.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, number_of, walk, yamls_of_robot
from urdfkit.lint.facts.gazebo.base_motion import moves_sideways
from urdfkit.lint.facts.navigation.filters import AXES, FALSE, Defects, Filter
from urdfkit.lint.facts.navigation.sections import COSTMAPS, costmaps_of_ros1, sections
from urdfkit.lint.model.model import Model

_INPUT = r"((?:odom|imu|pose|twist)\d+)(?:_(\w+))?"
_OF_INPUTS = (
    *("config", "differential", "relative", "queue_size", "remove_gravitational_acceleration", "nodelay"),
    *("pose_rejection_threshold", "twist_rejection_threshold", "linear_acceleration_rejection_threshold"),
)


def filter_defects(group: Node, controllers: frozenset[str]) -> Iterator[tuple[Node, str]]:
    """Yield a world frame that is not one of the frames of robot_localization, and misspelt inputs."""
    from urdfkit.lint.facts.ros_packages import is_slip

    world, *frames = (group.find(name) for name in ("world_frame", "map_frame", "odom_frame"))
    names = [frame.text for frame in frames if frame is not None]
    is_literal = world is not None and world.text and len(names) == 2 and "$" not in "".join((world.text, *names))
    if world is not None and is_literal and world.text not in names:
        hint = Suggestion(nearest(world.text, names), world.text) or f"; write `{names[0]}` or `{names[1]}`"
        yield world, f"`world_frame` is `{world.text}`, which is neither `map_frame` nor `odom_frame`" + hint
    frequency = group.find("frequency")
    rate = number_of(frequency) if frequency is not None else None
    if frequency is not None and rate is not None and rate <= 0.0:
        yield frequency, f"`frequency` is {rate:g}; it must be positive"
    inputs = {key.text for key, _ in group.entries}
    for key, value in group.entries:
        at = re.fullmatch(_INPUT, key.text)
        if at is None:
            unnumbered = re.fullmatch(r"(odom|imu|pose|twist)(?:_(\w+))?", key.text)
            if unnumbered is not None and unnumbered[2] in (None, *_OF_INPUTS):
                first = next((f"{unnumbered[1]}{i}" for i in range(9) if f"{unnumbered[1]}{i}" in inputs), None)
                right = key.text.replace(unnumbered[1], first or f"{unnumbered[1]}0", 1)
                yield key, f"unknown parameter `{key.text}` of robot_localization" + Suggestion(right, key.text)
            continue
        if at[2] == "config" and value.items and all(each.text == "false" for each in value.items):
            yield value, f"`{key.text}` is false for every value, so the filter does not use `{at[1]}`"
        differential = group.find(f"{at[1]}_differential")
        is_doubled = at[2] == "relative" and differential is not None and differential.text.lower() == "true"
        if is_doubled and value.text.lower() == "true":
            yield value, f"`{key.text}` has no effect, because `{at[1]}_differential` is true"
        if at[2] == "config" and at[1] not in inputs:
            others = [each for each in sorted(inputs) if re.fullmatch(r"(?:odom|imu|pose|twist)\d+", each)]
            free = [each for each in others if f"{each}_config" not in inputs]
            hint = Suggestion(f"{free[0]}_config", at[1]) if len(free) == 1 else ""
            yield key, f"`{key.text}` has no effect, because the topic `{at[1]}` is not set" + hint
        if at[2] is not None and at[2] not in _OF_INPUTS:
            near = next((each for each in _OF_INPUTS if is_slip(at[2], each) or at[2].startswith(f"{each}u")), None)
            near = near or ("remove_gravitational_acceleration" if at[2].startswith("remove_") else None)
            if near is not None:
                yield (
                    key,
                    f"unknown parameter `{key.text}` of robot_localization" + Suggestion(f"{at[1]}_{near}", key.text),
                )
        elif at[2] is None and value.kind == "text":
            first, separator, rest = value.text.strip("/").partition("/")
            near = next((each for each in sorted(controllers) if is_slip(first, each)), None)
            if separator and first not in controllers and near is not None:
                message = f"no controller `{first}` publishes `{value.text}`" + Suggestion(f"{near}/{rest}", value.text)
                yield value, message


_COVARIANCES = ("process_noise_covariance", "initial_estimate_covariance")
_WIDTH = 15


def wrong_covariances(group: Node) -> Iterator[tuple[Node, str]]:
    """Yield the covariances of a filter that are not a full matrix, at the only odd row.

    Only for ROS 1, which reads no diagonals (ros_filter.cpp, Noetic); the parameters of ROS 2 nodes have a schema.
    """
    for key, value in group.entries:
        count = len(value.items)
        if key.text in _COVARIANCES and count and count != _WIDTH * _WIDTH:
            rows = Counter(item.line for item in value.items)
            odd = [line for line, length in rows.items() if length != _WIDTH]
            place = next((item for item in value.items if [item.line] == odd), key)
            yield place, f"`{key.text}` has {count} values; it must have {_WIDTH * _WIDTH}"


_READERS = (
    *(*COSTMAPS, "controller_server", "behavior_server", "recoveries_server"),
    *("collision_monitor", "collision_detector"),
)
"""Nodes whose ``transform_tolerance`` is the accepted age of transforms; AMCL post-dates its own transform by it."""


def estimate_defects(model: Model, every: list[Filter]) -> Defects:
    """Yield the inputs and rates of filters that make their estimates useless: file, place, message."""
    sideways = moves_sideways(model) if every else None
    tolerances = list(_tolerances(model)) if every else []
    for each in every:
        yield from _unmeasured(each, sideways)
        yield from _without_place(each)
        yield from _slower_than_transforms(each, tolerances)


def _unmeasured(each: Filter, sideways: bool | None) -> Defects:
    """Yield the input of a local filter that lacks an axis of which no input has the place or the velocity.

    The filter reports the same at run time (ros_filter.cpp, "unbounded error growth"). The lateral velocity of a base
    that cannot move sideways is left out, since it is zero.

    Args:
        each: the filter.
        sideways: whether the base moves sideways; None for robots without a drive on wheels.
    """
    inputs = list(each.inputs())
    written = [key for key, _ in each.group.entries if re.fullmatch(r"(?:odom|imu|pose|twist)\d+", key.text)]
    if not each.is_local or sideways is None or not inputs or len(inputs) < len(written):
        return
    is_planar = each.text("two_d_mode") not in ("", *FALSE)
    axes = ("x", "yaw", *(("y",) if sideways else ()), *(() if is_planar else ("z",)))
    for axis in axes:
        places = [AXES.index(axis), AXES.index(f"v{axis}")]
        if any(values[at] not in FALSE for _, _, _, values in inputs for at in places):
            continue
        flag = each.group.find("two_d_mode")
        if axis == "z":
            node = flag or inputs[0][2]
            message = "no input fuses z or vz, so z drifts without bound; set `two_d_mode` to true"
        else:
            name, node = next(
                ((name, config.items[places[1]]) for name, _, config, _ in inputs if name.startswith("odom")),
                (inputs[0][0], inputs[0][2].items[places[1]]),
            )
            why = ", but the base can move sideways" if axis == "y" else f"; {axis} drifts without bound"
            message = f"`{name}_config` does not fuse v{axis}{why}"
        yield each.source, node, message


def _without_place(each: Filter) -> Defects:
    """Yield the frame of a filter in the map frame whose inputs measure neither x nor y."""
    inputs, frame = list(each.inputs()), each.group.find("world_frame")
    written = [key for key, _ in each.group.entries if re.fullmatch(r"(?:odom|imu|pose|twist)\d+", key.text)]
    has_place = any(value not in FALSE for _, _, _, values in inputs for value in values[:2])
    is_complete = bool(inputs) and len(inputs) == len(written) and each.publishes
    if each.is_global and is_complete and not has_place and frame is not None:
        message = "`world_frame` is the map frame, but no input measures x and y; write the odometry frame"
        yield each.source, frame, message


def _slower_than_transforms(each: Filter, tolerances: list[tuple[Source, float]]) -> Defects:
    """Yield the rate of a filter whose transforms are older than navigation accepts.

    Args:
        each: the filter.
        tolerances: the ages that costmaps, controller and behavior servers and collision monitors accept.
    """
    frequency = each.group.find("frequency")
    rate = number_of(frequency)
    if frequency is None or not rate or rate <= 0.0 or not each.publishes:
        return
    age = 1.0 / rate - (number_of(each.group.find("transform_time_offset")) or 0.0)
    for source, limit in tolerances:
        if limit < age - 1e-6:
            file = source.file.rpartition("/")[2]
            message = f"`frequency` is {rate:g} Hz, but `transform_tolerance` in {file} is {limit:g} s"
            yield each.source, frequency, f"{message}: transforms are older than that"
            return


def _tolerances(model: Model) -> Iterator[tuple[Source, float]]:
    """Yield the accepted ages of transforms in the parameters of navigation, and their files."""
    for source in yamls_of_robot(model):
        if "transform_tolerance" not in source.text:
            continue
        groups = (
            [node for key, group in sections(source) if key.last_name in _READERS for node in walk(group)]
            if PARAMETERS in source.text
            else costmaps_of_ros1(source)
        )
        for group in groups:
            limit = number_of(group.find("transform_tolerance"))
            if limit is not None and limit > 0.0:
                yield source, limit
