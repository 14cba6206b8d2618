"""Nav2 plugins: unlisted sections, plugins of Galactic, wrong keys, and parameters that contradict each other.

Sources: ros-navigation/navigation2 (nav2_bringup/params/nav2_params.yaml, nav2_behaviors/plugins.xml,
nav2_behavior_server: behavior_server.cpp, nav2_dwb_controller: kinematic_parameters.cpp, xy_theta_iterator.hpp,
nav2_costmap_2d: costmap_2d_ros.cpp, nav2_behavior_tree: CMakeLists.txt), Galactic to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, number_of, walk
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.navigation.tables import NODES

Defects = Iterator[tuple[Node, str]]

_RECOVERIES = {"Spin": "Spin", "BackUp": "BackUp", "Wait": "Wait"}
_SINCE_HUMBLE = r"nav2_behaviors|velocity_smoother|smoother_server|nav2_amcl::|general_goal_checker|behavior_plugins"
"""Matches parameter files of Humble and later."""

_ALTERNATIVES = ("ObstacleLayer", "VoxelLayer", "SpatioTemporalVoxelLayer", "NonPersistentVoxelLayer")
"""Layers of which a file often has several, and uses one."""

_FRAMES = {"odom": ("odom_frame", "odom_frame_id"), "map": ("map_frame", "global_frame_id")}
_SLOWING = ("decel_lim_x", "decel_lim_y", "decel_lim_theta")


def nav2_defects(source: Source) -> Defects:
    """Yield the defects of the plugins and frames of Nav2 in a ROS 2 parameter file."""
    if PARAMETERS not in source.text:
        return
    groups = {key.last_name: (key, group) for key, group in sections(source)}
    for name, (key, group) in groups.items():
        if name in ("recoveries_server", *NODES):
            yield from _of_galactic(source, key, name, group, "behavior_server" in groups)
        if name in NODES:
            yield from _wrong_key(group)
            yield from _unlisted(name, group)
            yield from _driving(group)
            yield from _single_plugins(group)
            yield from _tree_libraries(group)
        yield from _swapped_frames(group)
    yield from _between_nodes({name: group for name, (_, group) in groups.items()})


def _of_galactic(source: Source, key: Node, name: str, group: Node, has_behaviors: bool) -> Defects:
    """Yield the plugins and the node of Galactic in a file of Humble or later."""
    if name == "recoveries_server":
        if "nav2_behaviors" in source.text and not has_behaviors:
            message = "node `recoveries_server` is from Galactic or earlier; its name since Humble is `behavior_server`"
            yield key, message
        return
    for plugin in (value for node in walk(group) if (value := node.find("plugin")) is not None):
        package, _, kind = plugin.text.replace("::", "/").partition("/")
        if package == "nav2_recoveries" and kind in _RECOVERIES and re.search(_SINCE_HUMBLE, source.text):
            yield plugin, f"plugin `{plugin.text}` is from Galactic or earlier; write `nav2_behaviors::{kind}`"


def _wrong_key(group: Node) -> Defects:
    """Yield ``type`` in the section of a plugin, which is ``plugin`` in Nav2."""
    for node in walk(group):
        for key, value in node.entries:
            is_class = value.kind == "text" and re.fullmatch(r"(?:nav2_\w+|dwb_\w+)(?:::|/)\w+", value.text)
            if key.text in ("type", "plugin_type", "class", "plugin_name") and is_class and node.find("plugin") is None:
                yield key, f"unknown key `{key.text}` of a plugin" + Suggestion("plugin", key.text)


def _unlisted(name: str, group: Node) -> Defects:
    """Yield the sections of behaviors and of layers that the list of their node does not name."""
    lists = {
        key.text: {item.text for item in value.items}
        for key, value in group.entries
        if key.text in ("plugins", "filters", "behavior_plugins") and value.kind == "list"
    }
    wanted = "behavior_plugins" if name == "behavior_server" else "plugins"
    if wanted not in lists or (name != "behavior_server" and not name.endswith("_costmap")):
        return
    named = set().union(*lists.values())
    sections_of = [(key, value, _class(value)) for key, value in group.entries if value.find("plugin") is not None]
    if not named <= {key.text for key, _, _ in sections_of}:
        return  # the list and the sections have other names
    used = {kind for key, _, kind in sections_of if key.text in named}
    for key, _, kind in sections_of:
        is_spare = kind in _ALTERNATIVES and not used.isdisjoint(_ALTERNATIVES)
        is_spare = is_spare or kind.endswith("Filter") or (name == "local_costmap" and kind == "StaticLayer")
        if key.text not in named and kind not in used and not is_spare:
            place = next(each for each, _ in group.entries if each.text == wanted)
            yield place, f"`{wanted}` does not list `{key.text}`, so its section has no effect"


def _class(value: Node) -> str:
    plugin = value.find("plugin")
    return plugin.class_name if plugin is not None else ""


def _driving(group: Node) -> Defects:
    """Yield decelerations with the sign of accelerations, and scales of unlisted critics of DWB."""
    from urdfkit.lint.facts.ros_packages import is_slip

    for node in (each for each in walk(group) if _class(each) == "DWBLocalPlanner"):
        for name in _SLOWING:
            value = node.find(name)
            number = number_of(value)
            if value is not None and number is not None and number > 0.0:
                yield value, f"`{name}` is {number:g}; DWB requires zero or negative values"
        critics = node.find("critics")
        names = {item.text for item in critics.items} if critics is not None else set()
        for key, _ in node.entries:
            first, dot, _ = key.text.partition(".")
            near = next((each for each in sorted(names) if is_slip(first, each)), None)
            if dot and first not in names and near is not None:
                yield key, f"`critics` does not list `{first}`" + Suggestion(near, first)


def _single_plugins(group: Node) -> Defects:
    """Yield the name of a plugin, not in a list, that has no section although another section has its kind."""
    for parameter, kind in _SINGLE.items():
        value = group.find(parameter)
        names = [key.text for key, each in group.entries if re.search(kind, _class(each))]
        if value is not None and re.fullmatch(r"\w+", value.text) and value.text not in names and names:
            near = names[0] if len(names) == 1 else None
            message = f"`{parameter}` is `{value.text}`, which has no section with its `plugin`"
            yield value, message + Suggestion(near, value.text)


_SINGLE = {"progress_checker_plugin": "ProgressChecker$", "waypoint_task_executor_plugin": "AtWaypoint$"}
"""Parameter with the name of one plugin → the end of the class of such a plugin."""


def _tree_libraries(group: Node) -> Defects:
    """Yield the libraries of Nav2 behavior trees that have no such name.

    All libraries of nav2_behavior_tree end in ``_bt_node``, except ``nav2_path_expiring_timer_condition``.
    """
    libraries = group.find("plugin_lib_names")
    for item in libraries.items if libraries is not None else ():
        if re.fullmatch(r"nav2_\w+(?<!_bt_node)(?<!_condition)", item.text):
            right = re.sub(r"(?:_bt)?(?:_node)?$", "_bt_node", item.text, count=1)
            yield item, f"nav2_behavior_tree has no library `{item.text}`" + Suggestion(right, item.text)


def _swapped_frames(group: Node) -> Defects:
    """Yield the frame of the odometry that is called ``map`` while that of the map is called ``odom``."""
    odom, world = ([value for key, value in group.entries if key.text in _FRAMES[name]] for name in ("odom", "map"))
    if odom and world and odom[0].text == "map" and world[0].text == "odom":
        yield odom[0], "the odometry frame is `map` and the map frame is `odom`; swap them"


def _unequal_stamps(groups: dict[str, Node]) -> Defects:
    """Yield the only flag for stamped velocities that differs from those of the other nodes of a file."""
    flags = [flag for group in groups.values() if (flag := group.find("enable_stamped_cmd_vel")) is not None]
    for flag in flags if len(flags) > 2 else ():
        others = {each.text for each in flags if each is not flag}
        if len(others) == 1 and flag.text not in others and "$" not in flag.text:
            yield flag, f"`enable_stamped_cmd_vel` is {flag.text}, but {others.pop()} for the other nodes of this file"


def _between_nodes(groups: dict[str, Node]) -> Defects:
    """Yield a local costmap in another frame than the behaviors."""
    yield from _unequal_stamps(groups)
    docking = groups.get("docking_server")
    kinds = docking.find("dock_plugins") if docking is not None else None
    names = kinds.texts() if kinds is not None else ()
    written = {key.text for key, _ in docking.entries} if docking is not None else set[str]()
    for _, dock in docking.entries if docking is not None and written.issuperset(names) and names else ():
        kind = dock.find("type")
        if kind is not None and dock.find("pose") is not None and kind.text not in names:
            hint = Suggestion(nearest(kind.text, names), kind.text)
            yield kind, f"`dock_plugins` has no `{kind.text}`" + hint
    local, behaviors = groups.get("local_costmap"), groups.get("behavior_server")
    frame = local.find("global_frame") if local is not None else None
    expected = behaviors.find("local_frame") if behaviors is not None else None
    if frame is not None and expected is not None and {frame.text, expected.text} == {"map", "odom"}:
        place = frame if expected.text == "odom" else expected
        message = f"`global_frame` of the local costmap is `{frame.text}`, but `local_frame` of behavior_server is"
        yield place, f"{message} `{expected.text}`; write `odom`"
