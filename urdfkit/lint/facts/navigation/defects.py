"""Defects of the parameters of Nav2 and robot_localization.

Sources: ros-navigation/navigation2 (costmap_2d_ros.cpp, obstacle_layer.cpp, velocity_smoother.cpp, node_utils.hpp),
robot_localization (ros_filter.cpp), Humble to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents, not_a_number, number_of, walk
from urdfkit.lint.facts.navigation.filter_inputs import filter_defects, wrong_covariances
from urdfkit.lint.facts.navigation.sections import costmaps_of_ros1, sections
from urdfkit.lint.facts.navigation.tables import (
    CHOICES,
    CRITICS,
    DEFAULT_LISTS,
    DEFAULTS,
    DOUBLES,
    FILTER_POSITIVE,
    FRAMES,
    INTEGERS,
    MAY_BE_ZERO,
    MOTION_MODELS,
    MPPI_MODELS,
    MUX,
    NODES,
    PLANNERS_POSITIVE,
    POSITIVE,
    SIMILAR,
    SLAM_DOUBLES,
    SLAM_MODES,
    SLAM_POSITIVE,
    SWITCHES,
    VELOCITY_LIMITS,
)
from urdfkit.lint.facts.ros_packages import is_slip

Defects = Iterator[tuple[Node, str]]

_LISTS = ("plugins", "filters", "navigators")
_INTEGER = r"[-+]?\d+"
_DOUBLE = r"[-+]?\d*\.\d*"


def navigation_defects(source: Source, controllers: frozenset[str]) -> Defects:
    """Yield the defects of the parameters of Nav2 and robot_localization.

    Args:
        source: a YAML file.
        controllers: the names of the controllers of the robot, in which topics of sensors start.
    """
    if PARAMETERS not in source.text:
        for root in documents(source) if "base_link_frame" in source.text else ():  # a ROS 1 file
            for group in (root, *(value for _, value in root.entries)):
                if all(group.find(f"{name}_frame") is not None for name in ("world", "odom", "base_link")):
                    yield from filter_defects(group, controllers)
                    yield from wrong_covariances(group)
        for node in (value for root in documents(source) for _, value in root.entries):
            yield from _values(node, PLANNERS_POSITIVE) if node.find("vx_samples") is not None else ()
        for node in documents(source) if "base_local_planner" in source.text else ():
            yield from _values(node, frozenset(("controller_frequency",)))
        for node in costmaps_of_ros1(source):
            yield from choice_defects(node)
            for each in walk(node):
                yield from _plugins(each)
                yield from _values(each)
        return
    for key, group in sections(source):
        name = key.last_name
        if name in (*NODES, "slam_toolbox"):
            yield from choice_defects(group)
            for node in walk(group):
                yield from _switches(node)
                yield from _similar(node)
            model_type = group.find("robot_model_type")
            since_humble = any(each in source.text for each in ("behavior_server", "nav2_behaviors", "nav2_amcl::"))
            if model_type is not None and since_humble and model_type.text in MOTION_MODELS:
                right = MOTION_MODELS[model_type.text]
                yield model_type, f"`robot_model_type` `{model_type.text}` is from Galactic or earlier; write `{right}`"
        if name in NODES:
            for node in walk(group):
                yield from _plugins(node)
                yield from _values(node)
                yield from _contradictions(node)
            if name == "velocity_smoother":
                yield from _velocity_limits(group)
                yield from _stopped(group)
        elif name == "slam_toolbox":
            mode = group.find("mode")
            if mode is not None and mode.text and "$" not in mode.text and mode.text not in SLAM_MODES:
                hint = Suggestion(nearest(mode.text, SLAM_MODES), mode.text) or "; write `mapping` or `localization`"
                yield mode, f"unknown `mode` `{mode.text}` of slam_toolbox" + hint
            yield from _values(group, SLAM_POSITIVE)
        elif name == "twist_mux":
            yield from _mux(group)
        elif group.find("world_frame") is not None and group.find("odom_frame") is not None:
            yield from filter_defects(group, controllers)
            yield from _switches(group)
            yield from _values(group, FILTER_POSITIVE)


def _switches(node: Node) -> Defects:
    """Yield the values of truth values that are neither true nor false."""
    for key, value in node.entries:
        if key.text not in SWITCHES or value.kind != "text" or not value.text or "$" in value.text:
            continue
        if not value.is_plain and value.text.lower() in ("true", "false"):
            yield value, f'`{key.text}` is "{value.text}", a quoted string; write {value.text.lower()}'
        elif not re.fullmatch(_TRUTH, value.text, re.IGNORECASE) and not re.fullmatch(_SLIP_OF_TRUTH, value.text):
            yield value, f"`{key.text}` is `{value.text}`, which is neither true nor false"


def _similar(node: Node) -> Defects:
    """Yield the misspelt values of parameters whose further values plugins define."""
    for key, value in node.entries:
        is_word = value.kind == "text" and re.fullmatch(r"\w+", value.text)
        if key.text == "motion_model" and is_word and value.text not in MPPI_MODELS:
            near = nearest(value.text, MPPI_MODELS) or next((e for e in MPPI_MODELS if value.text.startswith(e)), None)
            hint = Suggestion(near, value.text) or f"; write one of {', '.join(MPPI_MODELS)}"
            yield value, f"unknown `{key.text}` `{value.text}` of the MPPI controller" + hint
        choices = SIMILAR.get(key.text, ())
        if not choices or value.kind != "text" or value.text in choices:
            continue
        near = next((each for each in choices if is_slip(value.text, each)), None)
        if near is not None:
            yield value, f"unknown `{key.text}` `{value.text}`" + Suggestion(near, value.text)


def _mux(group: Node) -> Defects:
    """Yield the defects of the inputs of twist_mux."""
    for part in ("topics", "locks"):
        inputs = group.find(part)
        for name, entry in inputs.entries if inputs is not None else ():
            written = {key.text for key, _ in entry.entries}
            for key, value in entry.entries:
                near = next((each for each in MUX if each not in written and is_slip(key.text, each)), None)
                if key.text not in MUX and near is not None:
                    written.add(near)
                    yield key, f"unknown parameter `{key.text}` of twist_mux" + Suggestion(near, key.text)
                number = number_of(value)
                if key.text == "priority" and number is not None and not 0.0 <= number <= 255.0:
                    yield value, f"`priority` is {number:g}; twist_mux requires 0 to 255"
                elif key.text == "timeout" and number is not None and number < 0.0:
                    yield value, f"`timeout` is {number:g}; it must not be negative"
            lacking = [each for each in MUX[:3] if each not in written] if entry.kind == "group" else []
            if lacking:
                yield name, f"input `{name.text}` of twist_mux lacks `{lacking[0]}`"


_TRUTH = r"true|false|yes|no|on|off|y|n"
_SLIP_OF_TRUTH = r"[Tt](?:ure|reu|ru|rie|ruee|tue|reue)|[Ff](?:asle|lase|ales|als|alsee|lse|ase)"
"""Matches the misspelt truth values that parameter-value-invalid reports in each YAML file."""


def wrong_numbers(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield integers in parameters of the type double, and the reverse: value, parameter, the right text."""
    for key, group in sections(source) if PARAMETERS in source.text else ():
        name = key.last_name
        is_filter = group.find("world_frame") is not None
        if name == "controller_manager":
            doubles, integers = frozenset[str](), frozenset(("update_rate",))
        elif name in NODES:
            doubles, integers = DOUBLES, INTEGERS
        elif name == "slam_toolbox":
            doubles, integers = SLAM_DOUBLES, frozenset(("throttle_scans", "scan_buffer_size"))
        elif is_filter:
            doubles, integers = frozenset(("frequency", "sensor_timeout")), frozenset()
        else:
            continue
        for parameter, value in (entry for node in walk(group) for entry in node.entries):
            if not value.is_plain:
                continue
            if parameter.text in doubles and re.fullmatch(_INTEGER, value.text):
                yield value, parameter.text, f"{value.text}.0"
            elif parameter.text in integers and re.fullmatch(_DOUBLE, value.text) and value.text.strip("+-."):
                yield value, parameter.text, f"{float(value.text):.0f}"


def _plugins(node: Node) -> Defects:
    """Yield plugins and observation sources that are listed without a section."""
    defined = {key.text: (key, value) for key, value in node.entries if value.kind == "group"}
    for key, value in node.entries:
        if key.text == "observation_sources" and "," in value.text:
            yield value, "`observation_sources` contains commas; separate the names with spaces"
            continue
        if key.text == "observation_sources" and value.kind == "text":
            listed = [(value, word) for word in value.text.split()]
            others = [name for name, (_, each) in defined.items() if each.find("topic") is not None]
        elif key.text in _LISTS or key.text.endswith("_plugins"):
            listed = [(item, item.text) for item in value.items if item.text]
            others = [name for name, (_, each) in defined.items() if each.find("plugin") is not None]
        else:
            continue
        names = {word for _, word in listed}
        unlisted = [name for name in others if name not in names]
        undefined = [word for word in names if word not in defined]
        # Servers with this key, those since Humble, have types for the longest of the lists of behaviors only.
        is_default = names in DEFAULT_LISTS and (key.text != "behavior_plugins" or len(names) > 4)
        for item, word in listed:
            has_type = key.text == "observation_sources" or is_default
            if word in defined and not has_type and "plugin" not in _keys(defined[word][1]):
                misspelt = [each for each, _ in defined[word][1].entries if nearest(each.text, ["plugin"], cutoff=0.8)]
                hint = Suggestion("plugin", misspelt[0].text) if misspelt else ""
                place = misspelt[0] if misspelt else defined[word][0]
                yield place, f"`{key.text}` lists `{word}`, whose section has no `plugin`" + hint
            if word in defined or any(each.text.startswith(f"{word}.") for each, _ in node.entries):
                continue
            near = nearest(word, unlisted, cutoff=0.6) or (
                unlisted[0] if len(undefined) == len(unlisted) == 1 else None
            )
            is_needed = word not in DEFAULTS or (not is_default and len(others) > 1)
            if word in DEFAULTS and near is not None:
                if is_slip(near.lower(), word.lower()):
                    yield defined[near][0], f"section `{near}` is not in `{key.text}`" + Suggestion(word, near)
                else:
                    yield item, f"`{key.text}` lists `{word}`, which has no section" + Suggestion(near, word)
            elif near is not None or (is_needed and key.text != "observation_sources" and others):
                what = "topic" if key.text == "observation_sources" else "plugin"
                yield (
                    item,
                    f"`{key.text}` lists `{word}`, which has no section with its `{what}`" + Suggestion(near, word),
                )


def _contradictions(node: Node) -> Defects:
    """Yield an inflation that ends inside of the robot, and misspelt critics."""
    radius = number_of(node.find("robot_radius"))
    for _, inner in node.entries if radius is not None and node.find("footprint") is None else ():
        inflated = inner.find("inflation_radius")
        reach = number_of(inflated) if inflated is not None else None
        if inflated is not None and reach is not None and radius is not None and 0.0 < reach < radius:
            yield inflated, f"`inflation_radius` is {reach:g} m, less than `robot_radius`, {radius:g} m"
    critics = node.find("critics")
    for item in critics.items if critics is not None else ():
        near = next((each for each in sorted(CRITICS) if is_slip(item.text, each)), None)
        if item.text not in CRITICS and near is not None:
            yield item, f"unknown critic `{item.text}`" + Suggestion(near, item.text)


def _keys(node: Node) -> set[str]:
    return {key.text for key, _ in node.entries}


def _footprint(value: Node) -> str | None:
    """Return the fault of a footprint; None if it is a list of at least three points."""
    text = value.text.strip()
    if value.kind == "text" and text and "$" not in text:
        pair = rf"\[\s*{_NUMBER}\s*,\s*{_NUMBER}\s*\]"
        if text.count("[") != text.count("]"):
            return f"`footprint` has {text.count('[')} `[` and {text.count(']')} `]`"
        if not re.fullmatch(rf"\[\s*{pair}(?:\s*,\s*{pair})*\s*\]", text):
            return "`footprint` is not a list of points: write [[x1, y1], [x2, y2], …]"
        count = len(re.findall(pair, text))
    elif value.kind == "list" and value.items:
        count = len(value.items)
        wrong = next((item for item in value.items if item.kind == "list" and len(item.items) != 2), None)
        if wrong is not None:
            return f"a point of `footprint` has {len(wrong.items)} coordinates; write x and y"
    else:
        return None
    return f"`footprint` has {count} points; a polygon needs at least 3" if 0 < count < 3 else None


_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


def choice_defects(group: Node) -> Defects:
    """Yield unknown values of parameters with few values, misspelt frames, and a minimum above its maximum."""
    for key, value in group.entries:
        choices = CHOICES.get(key.text, ())
        if choices and value.kind == "text" and value.text and "$" not in value.text and value.text not in choices:
            hint = Suggestion(nearest(value.text, choices), value.text) or f"; write one of {', '.join(choices)}"
            yield value, f"unknown `{key.text}` `{value.text}`" + hint
        near = next((one for one in ("odom", "map") if is_slip(value.text, one)), None)
        if key.text in FRAMES and near is not None and value.text not in ("odom", "map"):
            yield value, f"unknown frame `{value.text}`" + Suggestion(near, value.text)
    least, most = group.find("min_particles"), group.find("max_particles")
    if least is not None and most is not None:
        low, high = number_of(least), number_of(most)
        if low is not None and high is not None and low > high:
            yield least, f"`min_particles` is {low:g}, more than `max_particles`, {high:g}"


def _values(node: Node, positive: frozenset[str] = POSITIVE) -> Defects:
    for key, value in node.entries:
        name = key.text
        if name == "footprint" and (defect := _footprint(value)) is not None:
            yield value, defect
        if (
            name == "data_type"
            and node.find("topic") is not None
            and value.text not in ("LaserScan", "PointCloud2")
            and "$" not in value.text
        ):
            near = nearest(value.text, ("LaserScan", "PointCloud2"))
            hint = Suggestion(near, value.text) or "; write `LaserScan` or `PointCloud2`"
            yield value, f"unknown `data_type` `{value.text}` of an observation source" + hint
        if name not in positive or value.kind != "text" or not value.text or "$" in value.text:
            continue
        if problem := not_a_number(value):
            yield value, f"`{name}` is {problem}"
        elif (number := number_of(value)) is not None and (number < 0.0 or (number == 0.0 and name not in MAY_BE_ZERO)):
            yield value, f"`{name}` is {number:g}; it must be positive"


def _stopped(group: Node) -> Defects:
    """Yield a dead band that contains every speed of its direction, and a timeout shorter than the period."""
    bands, limits = group.find("deadband_velocity"), group.find("max_velocity")
    pairs = zip(bands.items, limits.items, strict=False) if bands is not None and limits is not None else ()
    for band, limit in pairs:
        width, most = number_of(band), number_of(limit)
        if width is not None and most is not None and 0.0 < most <= width:
            yield (
                band,
                f"`deadband_velocity` contains {width:g}, not below `max_velocity`, {most:g}: the robot never moves",
            )
            break
    for name in ("max_accel", "max_decel"):
        rates = group.find(name)
        is_whole = rates is not None and limits is not None and len(rates.items) == len(limits.items)
        pairs = zip(rates.items, limits.items, strict=True) if rates and limits and is_whole else ()
        for rate_of, limit in pairs:
            if number_of(rate_of) == 0.0 and (number_of(limit) or 0.0) > 0.0:
                yield rate_of, f"`{name}` has 0 where `max_velocity` is {limit.text}, so this velocity never changes"
    rate, timeout = number_of(group.find("smoothing_frequency")), group.find("velocity_timeout")
    time = number_of(timeout)
    if timeout is not None and rate and time is not None and 0.0 < time < 1.0 / rate:
        yield timeout, f"`velocity_timeout` is {time:g} s, shorter than the period, {1.0 / rate:g} s"


def _velocity_limits(group: Node) -> Defects:
    feedback = group.find("feedback")
    choices = ("OPEN_LOOP", "CLOSED_LOOP")
    if feedback is not None and feedback.text and feedback.text not in choices and "$" not in feedback.text:
        hint = Suggestion(nearest(feedback.text, choices), feedback.text) or "; write `OPEN_LOOP` or `CLOSED_LOOP`"
        yield feedback, f"unknown `feedback` `{feedback.text}` of velocity_smoother" + hint
    for name, sign in VELOCITY_LIMITS.items():
        value = group.find(name)
        if value is None or value.kind != "list":
            continue
        if len(value.items) not in (3, 6):
            yield value, f"`{name}` has {len(value.items)} values; velocity_smoother requires 3 (x, y, rotation) or 6"
        for item in value.items:
            number = number_of(item) if item.is_plain else None
            if number is not None and number * sign > 0.0:
                wanted = "negative" if sign > 0 else "positive"
                yield item, f"`{name}` has {number:g}; velocity_smoother requires zero or {wanted} values"
                break
