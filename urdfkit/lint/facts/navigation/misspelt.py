"""Misspelt nodes, plugins, topics and parameters of Nav2 and of move_base."""

from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents, walk
from urdfkit.lint.facts.navigation.sections import COSTMAPS, costmaps_of_ros1, sections
from urdfkit.lint.facts.navigation.tables import COSTMAP_ROS1, DOUBLES, INTEGERS, NODES, OTHERS, PLUGINS, SWITCHES
from urdfkit.lint.facts.ros_packages import is_slip

_TOPICS = ("scan", "odom", "cmd_vel", "joint_states", "local_costmap", "global_costmap", "costmap_raw")

_WITH_COLONS = (
    *("dwb_core", "nav2_controller", "nav2_costmap_2d", "nav2_graceful_controller", "nav2_mppi_controller"),
    *("nav2_regulated_pure_pursuit_controller", "nav2_rotation_shim_controller", "nav2_smoother"),
)
"""Packages whose plugins have `::` in their names in each release; others had `/` up to Iron."""

_VALID = DOUBLES | INTEGERS | OTHERS | SWITCHES


@lru_cache(maxsize=400)
def misspelt_navigation(source: Source) -> tuple[tuple[Node, str, str], ...]:
    """Return the misspelt nodes, plugins, topics and parameters of Nav2 or move_base: YAML node, kind, right name."""
    return tuple(_misspelt_in_ros2(source) if PARAMETERS in source.text else _misspelt_in_ros1(source))


def _misspelt_in_ros2(source: Source) -> Iterator[tuple[Node, str, str]]:
    named = [(key, group, key.last_name) for key, group in sections(source)]
    written = {name for _, _, name in named}
    for outer, value in (entry for root in documents(source) for entry in root.entries):
        if outer.text in COSTMAPS and not {outer.text, PARAMETERS} & {key.text for key, _ in value.entries}:
            yield from ((key, "node", outer.text) for key, inner in value.entries if inner.find(PARAMETERS) is not None)
    for key, group, name in named:
        if name not in NODES:
            near = next((each for each in sorted(NODES - written) if is_slip(name, each)), None)
            if near is not None:
                yield key, "node", near
            continue
        for node in walk(group) if name != "amcl" else ():  # `node_parameters` has the parameters of amcl
            names = {each.text for each, _ in node.entries}
            for parameter, value in node.entries:
                if parameter.text == "plugin" and value.kind == "text":
                    written_type = value.text.replace("/", "::")
                    near = _meant_plugin(written_type)
                    package = value.text.partition("/")[0]
                    if written_type in PLUGINS and package in _WITH_COLONS and package != value.text:
                        yield value, "plugin", written_type
                    elif near is not None:
                        yield value, "plugin", near.replace("::", "/" if "/" in value.text else "::")
                    continue
                topic = value.text.rpartition("/")[2]
                if topic not in _TOPICS and (parameter.text == "topic" or parameter.text.endswith("_topic")):
                    near = next((each for each in _TOPICS if is_slip(topic, each)), None)
                    if near is not None:
                        yield value, "topic", value.text.removesuffix(topic) + near
                if value.kind == "group" or parameter.text in _VALID or len(parameter.text) < 6:
                    continue
                near = next((each for each in _nearest_parameters(parameter.text) if each not in names), None)
                if near is not None and len(near) >= 6:
                    yield parameter, "parameter", near


@lru_cache(maxsize=4000)
def _nearest_parameters(name: str) -> tuple[str, ...]:
    """Return the Nav2 parameters that a name differs from by a slip, sorted."""
    return tuple(each for each in sorted(_VALID) if is_slip(name, each))


def _misspelt_in_ros1(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield the misspelt parameters and namespaces of costmaps in a ROS 1 YAML file."""
    costmaps = list(costmaps_of_ros1(source))
    for node in costmaps:
        names = {key.text for key, _ in node.entries}
        for key, _ in node.entries:
            near = next((each for each in sorted(COSTMAP_ROS1 - names) if is_slip(key.text, each)), None)
            if key.text not in COSTMAP_ROS1 and len(key.text) >= 6 and near is not None and len(near) >= 6:
                yield key, "parameter", near
    for key, value in (entry for root in documents(source) for entry in root.entries):
        near = next((each for each in COSTMAPS if is_slip(key.text, each)), None)
        if key.text not in COSTMAPS and near is not None and any(value is each for each in costmaps):
            yield key, "namespace", near


def _meant_plugin(name: str) -> str | None:
    """Return the Nav2 plugin that a misspelt class stands for, or one with its class in another Nav2 package."""
    package, _, kind = name.rpartition("::")
    if name in PLUGINS:
        return None
    same = min((each for each in PLUGINS if each.endswith(f"::{kind}")), default=None)
    if same is not None and package.startswith("nav2_") and nearest(package, [same.rpartition("::")[0]], cutoff=0.8):
        return same
    inside = [each.rpartition("::")[2] for each in PLUGINS if each.startswith(f"{package}::")]
    longer = [each for each in inside if kind and (each.startswith(kind) or each.endswith(kind))]
    close = longer[0] if len(longer) == 1 else nearest(kind, inside, cutoff=0.8)
    if close is not None:
        return f"{package}::{close}"
    near = nearest(name, PLUGINS, cutoff=0.93)
    meant = near.rpartition("::")[2] if near is not None else ""
    return near if meant and (is_slip(kind, meant) or is_slip(kind.lower(), meant.lower())) else None
