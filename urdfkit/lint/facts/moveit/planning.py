"""Defects of MoveIt's planning pipelines: planners, plugins and adapters.

Sources: moveit_planners/ompl (planning_context_manager.cpp), moveit_ros/planning (request and response adapters),
Noetic to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, documents, not_a_number, number_of, walk
from urdfkit.lint.facts.launch.ros_version import ros_version
from urdfkit.lint.facts.moveit.plugin_names import PLUGINS, wrong_plugins
from urdfkit.lint.facts.moveit.settings import unwrapped
from urdfkit.lint.fix_builders import meant, nearest

_PLANNERS = """
AITstar ABITstar AnytimePathShortening BFMT BITstar BKPIECE BiEST BiTRRT EST FMT KPIECE LBKPIECE LBTRRT LazyPRM
LazyPRMstar LazyRRT PDST PRM PRMstar ProjEST RRT RRTConnect RRTstar SBL SPARS SPARStwo STRIDE TRRT
"""
_PLUGINS = """
default_planner_request_adapters/AddIterativeSplineParameterization default_planner_request_adapters/FixWorkspaceBounds
default_planner_request_adapters/AddRuckigTrajectorySmoothing default_planner_request_adapters/FixStartStateBounds
default_planner_request_adapters/AddTimeOptimalParameterization default_planner_request_adapters/FixStartStateCollision
default_planner_request_adapters/AddTimeParameterization default_planner_request_adapters/FixStartStatePathConstraints
default_planner_request_adapters/ResolveConstraintFrames default_planning_request_adapters/ResolveConstraintFrames
default_planner_request_adapters/SetMaxCartesianEndEffectorSpeed default_planning_request_adapters/CheckStartStateBounds
default_planning_request_adapters/ValidateWorkspaceBounds default_planning_request_adapters/CheckStartStateCollision
default_planning_request_adapters/CheckForStackedConstraints default_planning_response_adapters/ValidateSolution
default_planning_response_adapters/AddTimeOptimalParameterization default_planning_response_adapters/DisplayMotionPath
default_planning_response_adapters/AddRuckigTrajectorySmoothing ompl_interface/OMPLPlanner stomp_moveit/StompPlanner
pilz_industrial_motion_planner/CommandPlanner chomp_interface/CHOMPPlanner
moveit_simple_controller_manager/MoveItSimpleControllerManager moveit_ros_control_interface/Ros2ControlManager
moveit_ros_control_interface/Ros2ControlMultiManager moveit_fake_controller_manager/MoveItFakeControllerManager
occupancy_map_monitor/PointCloudOctomapUpdater occupancy_map_monitor/DepthImageOctomapUpdater
moveit_ros_control_interface::MoveItControllerManager moveit_ros_control_interface::MoveItMultiControllerManager
"""
_KEYS = (
    *("controller_list", "joint_limits", "planner_configs", "planning_plugins", "request_adapters"),
    *("response_adapters", "moveit_simple_controller_manager", "moveit_controller_manager", "trajectory_execution"),
    *(_SCALING_FACTORS := ("default_velocity_scaling_factor", "default_acceleration_scaling_factor")),
)
"""Names at the start of MoveIt's files."""

Defects = Iterator[tuple[Node, str]]


def planning_defects(source: Source, groups: Collection[str]) -> Defects:
    """Yield misspelt planners and plugins, and planners and groups that do not exist.

    Args:
        source: a MoveIt YAML file.
        groups: the names of the groups of the SRDF.
    """
    version = ros_version(source)
    for document in documents(source):
        yield from _plugins(document, version)
        for node in walk(document):
            yield from _pipeline(node)
        for top in unwrapped(document):
            yield from _sensors(top)
            for key, value in top.entries:
                near = nearest(key.text, _KEYS, cutoff=0.9) if key.text not in _KEYS else None
                is_other = key.text.rstrip("s") == near.rstrip("s") and not _has_limits(value) if near else True
                if near is not None and not is_other:
                    yield key, f"unknown parameter `{key.text}` of MoveIt" + Suggestion(near, key.text)
                if key.text in _SCALING_FACTORS:
                    yield from _scaling_factor(key, value)
                if key.text == "planner_configs" or value.kind != "group":
                    continue
                configs = value.find("planner_configs")
                is_of_group = configs is not None and configs.kind != "group"
                if is_of_group and groups and key.text not in groups:
                    yield key, f"group `{key.text}` does not exist in the SRDF" + _hint(key.text, groups)
                if configs is not None and configs.kind == "text" and configs.text:
                    yield configs, f"`planner_configs` of group `{key.text}` is a string; write a list"
                if is_of_group:
                    yield from _planners(key, value, top.find("planner_configs"))


def _pipeline(node: Node) -> Defects:
    """Yield the parameters of a planning pipeline of another release, and adapters without timing of trajectories."""
    default = node.find("default_planner_config")
    plugins = [text for name in ("planning_plugin", "planning_plugins") for text in _texts(node, name)]
    if default is not None and plugins == [_PILZ] and default.text not in (*_PILZ_PLANNERS, ""):
        hint = _hint(default.text, _PILZ_PLANNERS) or f"; write {', '.join(_PILZ_PLANNERS)}"
        yield default, f"unknown planner `{default.text}` of the Pilz pipeline" + hint
    adapters, responses = node.find("request_adapters"), node.find("response_adapters")
    names = [
        word for value in (adapters, responses) if value is not None for text in value.texts() for word in text.split()
    ]
    is_old = any(name.startswith("default_planner_request_adapters/") for name in names)
    is_new = any(name.startswith(("default_planning_request", "default_planning_response")) for name in names)
    if is_old and is_new:
        yield from _of_both_releases([each for each in (adapters, responses) if each is not None])
    if is_old == is_new or "$" in "".join(names):
        return
    wrong, right = ("planning_plugins", "planning_plugin") if is_old else ("planning_plugin", "planning_plugins")
    key = next((key for key, _ in node.entries if key.text == wrong), None)
    if key is not None and node.find(right) is None:
        release = "before Jazzy" if is_old else "since Jazzy"
        yield key, f"`request_adapters` lists adapters of releases {release}, which read `{right}`, not `{wrong}`"
    planners = [text for each in (wrong, right) if (value := node.find(each)) is not None for text in value.texts()]
    name = "request_adapters" if is_old else "response_adapters"
    key = next((each for each, _ in node.entries if each.text == name), None)
    if key is not None and is_untimed(planners, names):
        yield key, f"`{name}` {WITHOUT_TIMES}"


_PILZ = "pilz_industrial_motion_planner/CommandPlanner"
_PILZ_PLANNERS = ("PTP", "LIN", "CIRC")


def _texts(node: Node, name: str) -> list[str]:
    value = node.find(name)
    return value.texts() if value is not None else []


WITHOUT_TIMES = "has no time parameterization; without `AddTimeOptimalParameterization`, trajectories have no times"


def is_untimed(planners: Collection[str], adapters: Collection[str]) -> bool:
    """Return whether a pipeline with OMPL, which gives a trajectory no times, has no adapter that adds them."""
    is_timed = any(re.search(r"/Add\w*(?:Parameterization|Smoothing)", name) for name in adapters)
    return "ompl_interface/OMPLPlanner" in planners and not is_timed and len(adapters) > 2


def _of_both_releases(lists: list[Node]) -> Defects:
    """Yield the adapters of the releases of which a pipeline has fewer adapters."""
    written = [item for value in lists for item in value.items if item.text.startswith("default_plann")]
    old = [item for item in written if item.text.startswith("default_planner_request_adapters/")]
    is_old_rare = 2 * len(old) < len(written)
    release = "before Jazzy" if is_old_rare else "since Jazzy"
    for item in written:
        if (item in old) == is_old_rare and 2 * len(old) != len(written):
            yield item, f"`{item.text}` is an adapter of releases {release}, unlike the other adapters"


_SENSOR_TOPICS = {"PointCloudOctomapUpdater": "point_cloud_topic", "DepthImageOctomapUpdater": "image_topic"}
"""Class of a sensor plugin → the parameter of its topic (moveit_ros_perception)."""


def _sensors(top: Node) -> Defects:
    """Yield the names in ``sensors`` without a section, and sensor plugins without the topic that they read."""
    sensors, names = top.find("sensors"), {key.text for key, _ in top.entries}
    for item in sensors.items if sensors is not None else ():
        if item.text and item.text not in names and any(each.find("sensor_plugin") for _, each in top.entries):
            yield item, f"sensor `{item.text}` has no section" + _hint(item.text, names - {"sensors"})
    listed = sensors.items if sensors is not None else ()
    for node in (*(value for _, value in top.entries), *listed):
        plugin = node.find("sensor_plugin")
        topic = _SENSOR_TOPICS.get(plugin.text.rpartition("/")[2]) if plugin is not None else None
        others = {key.text for key, _ in node.entries} & set(_SENSOR_TOPICS.values())
        sampled, shown = node.find("point_subsample"), node.find("filtered_cloud_topic")
        count, source = number_of(sampled), node.find("point_cloud_topic")
        if plugin is not None and sampled is not None and count is not None and count < 1.0:
            yield sampled, f"`point_subsample` is {count:g}; it must be at least 1"
        is_same = shown is not None and source is not None and shown.text.strip("/") == source.text.strip("/")
        if plugin is not None and shown is not None and shown.text and is_same:
            yield shown, "`filtered_cloud_topic` is the topic of the sensor, so MoveIt reads its own output"
        if plugin is not None and topic is not None and others and topic not in others:
            yield plugin, f"`{plugin.text}` reads `{topic}`, not `{others.pop()}`"


def _has_limits(value: Node) -> bool:
    """Return whether a mapping has limits of joints."""
    return any(re.match(r"(has|max)_", key.text) for _, joint in value.entries for key, _ in joint.entries)


def _scaling_factor(key: Node, value: Node) -> Defects:
    """Yield a factor beyond the range of MoveIt, which limits it to 1 or replaces it."""
    if problem := not_a_number(value):
        yield value, f"`{key.text}` is {problem}"
    elif (factor := number_of(value)) is not None and not 0.0 < factor <= 1.0:
        yield value, f"`{key.text}` is {factor:g}; it must be greater than 0 and at most 1"


def _hint(name: str, names: Iterable[str]) -> str:
    return meant(name, names)[1]


def _plugins(document: Node, version: int) -> Defects:
    seen = set[int]()
    for node in walk(document):
        listed = [each for key, value in node.entries if re.search(PLUGINS, key.text) for each in (value, *value.items)]
        for value in listed if version else ():
            for _, _, message in wrong_plugins(value.text, version):
                seen.add(id(value))
                yield value, message
        values = [value for key, value in node.entries if key.text not in ("description", "name")]
        for value in (each for each in (*values, *node.items) if id(each) not in seen):
            near = meant_plugin(value.text) if value.kind == "text" else None
            if near is not None:
                kind = "planner" if near.startswith("geometric::") else "plugin"
                yield value, f"unknown {kind} `{value.text}`" + Suggestion(near, value.text)


def meant_plugin(text: str) -> str | None:
    """Return the plugin or MoveIt planner that a misspelt one stands for; None if the text may be right."""
    if "/" not in text and "::" not in text:
        return None
    names = {*_PLUGINS.split(), *(f"geometric::{name}" for name in _PLANNERS.split())}
    near = nearest(text, names, cutoff=0.9) if text not in names else None
    return near if near is not None and abs(len(near) - len(text)) <= 1 else None


def _planners(group: Node, settings: Node, defined: Node | None) -> Defects:
    """Yield the planners of a group that the file does not define, and a fraction that is no number."""
    names = [key.text for key, _ in defined.entries] if defined is not None else []
    lists = (settings.find("planner_configs"), settings.find("default_planner_config"))
    for node in [each for value in lists if value is not None for each in (*value.items, value)]:
        if names and node.text and node.text not in names and "::" not in node.text:
            yield node, f"`planner_configs` does not define planner `{node.text}`" + _hint(node.text, names)
    fraction = settings.find("longest_valid_segment_fraction")
    if fraction is not None and (problem := not_a_number(fraction)):
        yield fraction, f"`longest_valid_segment_fraction` of group `{group.text}` is {problem}"
