"""Plugins of navigation: sections of planners that move_base does not load, separators, topics of costmaps.

Sources: move_base (move_base.cpp, Noetic), navigation2 (behavior_server.cpp, and parameter_handler.cpp of
nav2_regulated_pure_pursuit_controller), docs.nav2.org
(migration/Iron.rst, "Standardization of Plugin Naming", pull request 4220).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of, walk, yamls
from urdfkit.lint.facts.gazebo.steered_axles import tight_turns
from urdfkit.lint.facts.navigation.plugin_parameters import foreign_parameters, repeated_plugins, short_model_steps
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.parameters.other_names import renamed_in
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Source, Node, str]]

_LOADED = {
    "base_local_planner": (
        *("TrajectoryPlannerROS", "DWAPlannerROS", "TebLocalPlannerROS", "EBandPlannerROS", "PurePlannerROS"),
        *("MPCPlannerROS", "DWBLocalPlanner"),
    ),
    "base_global_planner": ("GlobalPlanner", "NavfnROS", "CarrotPlanner", "SBPLLatticePlanner"),
}
"""Parameter of move_base → classes of planners, which read the section with their name."""

_PACKAGES = {
    "base_local_planner": ("TrajectoryPlannerROS",),
    "dwa_local_planner": ("DWAPlannerROS",),
    "teb_local_planner": ("TebLocalPlannerROS",),
    "eband_local_planner": ("EBandPlannerROS",),
    "global_planner": ("GlobalPlanner",),
    "navfn": ("NavfnROS",),
    "carrot_planner": ("CarrotPlanner",),
    "costmap_2d": ("StaticLayer", "ObstacleLayer", "VoxelLayer", "InflationLayer", "NonPersistentVoxelLayer"),
    "clear_costmap_recovery": ("ClearCostmapRecovery",),
    "rotate_recovery": ("RotateRecovery",),
    "move_slow_and_clear": ("MoveSlowAndClear",),
}
"""ROS 1 package → the classes of its plugins."""

_LISTED_PACKAGES = r"(?:costmap_2d|clear_costmap_recovery|rotate_recovery|move_slow_and_clear)(?:/|::)"
"""Matches the classes of plugins that lists of layers and of recovery behaviors contain."""

_OTHER_NAMES = {
    "DWAPlannerROS": {
        **{"vtheta_samples": "vth_samples", "acc_lim_th": "acc_lim_theta", "max_trans_vel": "max_vel_trans"},
        **{"min_trans_vel": "min_vel_trans", "max_rot_vel": "max_vel_theta", "min_rot_vel": "min_vel_theta"},
        **{"rot_stopped_vel": "theta_stopped_vel", "trans_stopped_velocity": "trans_stopped_vel"},
    },
    "TrajectoryPlannerROS": {"vth_samples": "vtheta_samples", "acc_lim_th": "acc_lim_theta"},
}
"""Section of a planner → parameters of other planners and releases, and what they are called there."""

_SINCE_JAZZY = (
    *("nav2_navfn_planner", "nav2_smac_planner", "nav2_theta_star_planner", "nav2_behaviors", "nav2_bt_navigator"),
)
"""Packages whose plugins have `/` in their names up to Iron and `::` since Jazzy."""

_TOPICS = {"costmap_topic": "costmap_raw", "footprint_topic": "published_footprint"}
_PUBLISHED = ("costmap", "costmap_updates", "footprint", "costmap_raw", "published_footprint", "voxel_grid")
_SERVERS = ("behavior_server", "recoveries_server", "smoother_server")


def plugin_defects(model: Model) -> Defects:
    """Yield the sections and names of plugins and the topics of costmaps that no node reads: file, place, message."""
    files = list(yamls(model))
    yield from _unread_sections(files)
    planners = {
        at[1] for source in files for at in re.finditer(r"base_local_planner\s*:\s*[\"']?\w+/(\w+)", source.text)
    }
    turns = {id(node) for _, node, _ in tight_turns(model)}
    for source in files:
        if PARAMETERS not in source.text:
            yield from _in_ros1(source, planners)
        if PARAMETERS in source.text:
            yield from foreign_parameters(source)
            yield from repeated_plugins(source)
            yield from short_model_steps(source)
            yield from _mixed(source)
            yield from _costmap_topics(source)
            yield from ((source, *each) for each in _backwards(source, turns))


def _backwards(source: Source, turns: set[int]) -> Iterator[tuple[Node, str]]:
    """Yield ``allow_reversing`` of a regulated pure pursuit controller that rotates, which switches it off.

    Args:
        source: a ROS 2 parameter file.
        turns: the identities of the parameters that make a robot with steering rotate, which turn-too-tight reports.
    """
    for node in (each for _, group in sections(source) for each in walk(group)):
        plugin, backwards, rotates = (node.find(name) for name in ("plugin", *_EXCLUSIVE))
        if plugin is None or plugin.class_name != "RegulatedPurePursuitController" or backwards is None:
            continue
        if rotates is not None and id(rotates) not in turns and {backwards.text, rotates.text} <= {"true", "True"}:
            yield backwards, f"`{_EXCLUSIVE[0]}` and `{_EXCLUSIVE[1]}` are both true; the controller never reverses"


_EXCLUSIVE = ("allow_reversing", "use_rotate_to_heading")


def _unread_sections(files: list[Source]) -> Defects:
    """Yield the planner that move_base loads in ROS 1 if the parameters are those of another planner."""
    loaded: dict[tuple[Path | None, str], dict[str, tuple[Source, Node]]] = {}
    written: dict[Path | None, list[tuple[Source, Node]]] = {}
    for source in files:
        package = package_of(Path(source.file))
        for node in nodes(source):
            for key, value in node.entries:
                if key.text in _LOADED and value.kind == "text":
                    loaded.setdefault((package, key.text), {})[value.text.rpartition("/")[2]] = (source, value)
                elif value.kind == "group":
                    written.setdefault(package, []).append((source, key))
    for (package, parameter), kinds in loaded.items():
        kind = next(iter(kinds))
        yield from _misnamed_sections(kind, written.get(package, [])) if len(kinds) == 1 else ()
        sections_of = [(source, key) for source, key in written.get(package, []) if key.text in _LOADED[parameter]]
        if len(kinds) > 1 or kind not in _LOADED[parameter] or len({key.text for _, key in sections_of}) != 1:
            continue
        _, key = sections_of[0]
        if key.text != kind:
            yield *kinds[kind], f"`{parameter}` loads `{kind}`, which does not read the section `{key.text}`"


def _misnamed_sections(kind: str, written: list[tuple[Source, Node]]) -> Defects:
    """Yield the only section with nearly the name of a planner that has no section, in which its parameters are."""
    classes = {name for names in _LOADED.values() for name in names}
    named = {key.text: (source, key) for source, key in written if key.text not in classes}
    near = nearest(kind, named, cutoff=0.85) if kind not in {key.text for _, key in written} else None
    if near is not None and near.isidentifier():
        yield *named[near], f"no planner reads the section `{near}`" + Suggestion(kind, near)


def _in_ros1(source: Source, loaded: set[str]) -> Defects:
    """Yield the unknown classes of planners and layers, and the parameters of other planners, in a ROS 1 file."""
    for node in nodes(source):
        for key, value in node.entries:
            names = _OTHER_NAMES.get(key.text, {})
            if key.text == "TebLocalPlannerROS":
                yield from ((source, *defect) for defect in _of_elastic_band(value))
            if key.text not in loaded and not loaded.isdisjoint(_OTHER_NAMES):
                names = {}  # a section that is not read
            yield from ((source, *defect) for defect in renamed_in(key.text, value, names))
            is_class = key.text in (*_LOADED, "type") and value.kind == "text"
            if is_class and value.text.startswith("nav2_") and re.search("costmap_2d|planner", value.text):
                yield source, value, f"plugin `{value.text}` belongs to Nav2, which ROS 1 does not have"
            elif key.text == "type" and (at := re.fullmatch(r"costmap_2d/(\w+)", value.text)):
                yield source, value, f"unknown plugin `{value.text}`" + Suggestion(f"costmap_2d::{at[1]}", value.text)
            elif f"base_{key.text}" in _LOADED and re.fullmatch(r"\w+/\w+", value.text):
                right = f"base_{key.text}"
                if value.text.partition("/")[0] in _PACKAGES and node.find(right) is None:
                    yield source, key, f"move_base has no parameter `{key.text}`" + Suggestion(right, key.text)
            elif key.text in _LOADED or (key.text == "type" and re.match(_LISTED_PACKAGES, value.text)):
                package, _, kind = value.text.replace("::", "/").partition("/")
                classes = _PACKAGES.get(package, ())
                if kind in classes and "::" in value.text and package != "costmap_2d":
                    right = f"{package}/{kind}"
                    yield source, value, f"unknown plugin `{value.text}`" + Suggestion(right, value.text)
                if classes and kind not in classes and "/" not in kind:
                    near = nearest(kind, classes, cutoff=0.5) or classes[0]
                    yield source, value, f"`{package}` has no plugin `{kind}`" + Suggestion(near, kind)


_FOOTPRINTS = {"circular": "radius", "two_circles": "front_radius", "line": "line_start", "polygon": "vertices"}
"""Type of ``footprint_model`` of teb_local_planner → its parameter (teb_local_planner_ros.cpp, Noetic)."""


def _of_elastic_band(group: Node) -> Iterator[tuple[Node, str]]:
    """Yield a footprint of another type than its parameters, and an inflation that ends where obstacles begin."""
    shape = group.find("footprint_model")
    kind = shape.find("type") if shape is not None else None
    near = nearest(kind.text, ("point", *_FOOTPRINTS)) if kind is not None and kind.text else None
    if kind is not None and near is not None and near != kind.text:
        yield kind, f"unknown `type` `{kind.text}` of the footprint" + Suggestion(near, kind.text)
    if shape is not None and kind is not None and kind.text in _FOOTPRINTS:
        needed = _FOOTPRINTS[kind.text]
        others = [name for name, each in _FOOTPRINTS.items() if shape.find(each) is not None]
        if shape.find(needed) is None and others:
            message = f"`{kind.text}` footprint has no `{needed}`; these are the parameters of"
            yield kind, f"{message} a footprint of the type `{others[0]}`"
    least, inflated = group.find("min_obstacle_dist"), group.find("inflation_dist")
    gap, reach = number_of(least), number_of(inflated)
    if least is not None and gap is not None and reach is not None and 0.0 < reach <= gap:
        yield least, f"`min_obstacle_dist` is {gap:g} m, so `inflation_dist`, {reach:g} m, has no effect"


def _mixed(source: Source) -> Defects:
    """Yield the Nav2 plugins with the separator of another release than most plugins of the file."""
    found: dict[str, list[Node]] = {"/": [], "::": []}
    for node in (each for _, group in sections(source) for each in walk(group)):
        plugin = node.find("plugin")
        for separator, plugins in found.items():
            if plugin is not None and plugin.text.partition(separator)[0] in _SINCE_JAZZY and separator in plugin.text:
                plugins.append(plugin)
    few, many = sorted(found, key=lambda each: len(found[each]))
    for plugin in found[few] if len(found[few]) < len(found[many]) else ():
        right = plugin.text.replace(few, many)
        release = "since Jazzy" if many == "::" else "up to Iron"
        message = f"`{plugin.text}` and the other plugins are from different releases; {release}, write `{right}`"
        yield source, plugin, message


def _costmap_topics(source: Source) -> Defects:
    """Yield topics of servers that do not end in the name of a topic that the servers can read."""
    for key, group in sections(source):
        if key.last_name not in _SERVERS:
            continue
        for parameter, value in group.entries:
            wanted = next((topic for end, topic in _TOPICS.items() if parameter.text.endswith(end)), None)
            space, _, last = value.text.rpartition("/")
            if wanted is None or not value.text or "$" in value.text or not space.endswith("_costmap"):
                continue
            if last in _PUBLISHED and last != wanted:
                yield source, value, f"`{parameter.text}` is `{value.text}`; this server reads `{space}/{wanted}`"
