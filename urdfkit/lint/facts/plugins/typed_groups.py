"""Sections of plugins, controllers and nodes in YAML files, recognized by class, name or parameters, and their defects.

A number, a truth value or a text of another type, a list of another length, a misspelt name, a parameter one level too
high, and a negative size, rate or weight.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fnmatch import fnmatchcase
from functools import cache, lru_cache

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents_in, nodes, number_of
from urdfkit.lint.facts.parameters.misspelt_names import is_misspelt
from urdfkit.lint.facts.parameters.node_parameters import outside_of_empty_groups, parameters, type_problem
from urdfkit.lint.facts.parameters.schemas import rows_of, schemas
from urdfkit.lint.facts.plugins.plugin_schemas import CLASSES, OF_ROS1

Rows = tuple[tuple[str, str], ...]
Defects = Iterator[tuple[Node, str]]

_LEAST = 4
_SHARE = 0.6
"""Number and share of the parameters of a section without a known name that a node must have."""


@cache
def _tables(is_ros2: bool) -> dict[str, Rows]:
    return {name: tuple(rows) for name, rows in rows_of(CLASSES if is_ros2 else OF_ROS1).items()}


@cache
def _kinds_by_name(is_ros2: bool) -> dict[str, tuple[str, ...]]:
    """Return parameter without dots → the nodes that have it."""
    found: dict[str, tuple[str, ...]] = {}
    for kind, rows in _tables(is_ros2).items():
        for name in {name.partition(".")[0] for name, _ in rows}:
            found[name] = (*found.get(name, ()), kind)
    return found


def names_of_plugins() -> set[str]:
    """Return the parameters in the tables, without the groups in which they are."""
    return {
        name.rpartition(".")[2] for is_ros2 in (True, False) for rows in _tables(is_ros2).values() for name, _ in rows
    }


def typed_groups(source: Source) -> tuple[tuple[str, Node, Rows], ...]:
    """Return kind, group and types of each section of a plugin, controller or node in the tables."""
    return _typed_groups_in(source.text)


@lru_cache(maxsize=100)
def _typed_groups_in(text: str) -> tuple[tuple[str, Node, Rows], ...]:
    is_ros2 = PARAMETERS in text
    found: list[tuple[str, Node, Rows]] = []
    waiting = [("", root, 0) for root in documents_in(text)[0]]
    types: dict[str, str] = {}
    while waiting:
        name, node, depth = waiting.pop(0)
        if depth > 6 or node.kind != "group":
            continue
        kind = _kind(name, node, is_ros2, types)
        if kind:
            found.append((kind, node, _tables(is_ros2)[kind]))
        for key, value in node.entries:
            plugin = value.find("type")
            if plugin is not None and "/" in plugin.text:
                types[key.text] = plugin.class_name
            inner = value.find(PARAMETERS)
            waiting.append((key.last_name, inner if inner is not None else value, depth + 1))
    return tuple(found)


def _kind(name: str, node: Node, is_ros2: bool, types: dict[str, str]) -> str:
    """Return the plugin, controller or node in the tables to which a group belongs; empty without one."""
    tables = _tables(is_ros2)
    plugin = node.find("plugin") or node.find("type")
    named = plugin.class_name if plugin is not None and plugin.kind == "text" else types.get(name, "")
    if named in tables and named[:1].isupper() and (is_ros2 or named.endswith("ROS")):
        return named
    if name in tables or (is_ros2 and name in schemas()):
        return name if name in tables else ""
    names = [key.text.partition(".")[0] for key, _ in node.entries]
    counts: dict[str, int] = {}
    for each in names if len(names) >= _LEAST else ():
        for kind in _kinds_by_name(is_ros2).get(each, ()):
            counts[kind] = counts.get(kind, 0) + (not kind[:1].isupper())
    best = max(counts, key=lambda kind: counts[kind], default="")
    return best if counts.get(best, 0) >= max(_LEAST, _SHARE * len(names)) else ""


_NOT_NEGATIVE = (
    r"(?:.*_)?(?:weight|tolerance|timeout|patience|frequency|rate|samples|iterations|radius|steps|hysteresis|interval"
    r"|threads|queue_size|resolution|granularity|power|dt|ratio|max_range|dist|std|delta|particles|scaling_factor)"
    r"|weight_\w+|acc_lim_\w+|max_vel_\w+|a[xz]_max|v_linear_max|threshold_to_consider|scan_(?:time|height)"
    r"|approach_velocity_scaling_dist|regulated_linear_scaling_\w+|max_\w+_time\w*|odom_alpha\d|min_points|cost_\w+|\w+_penalty"
)
"""Matches parameters that are not negative; -1 stands for a default."""


def typed_defects(source: Source) -> Defects:
    """Yield the parameters of plugins, controllers and nodes in the tables that have a wrong type, name or sign."""
    for kind, group, rows in typed_groups(source):
        yield from outside_of_empty_groups(group, rows)
        valid = {name.rpartition(".")[2] for name, _ in rows}
        written = {name.rpartition(".")[2] for name, _, _ in parameters(group)}
        for name, parameter, value in parameters(group):
            type = next((type for pattern, type in rows if fnmatchcase(name, pattern)), None)
            last, number = name.rpartition(".")[2], number_of(value) if value.kind == "text" else None
            if type is not None and (problem := type_problem(name, value, type)):
                yield (parameter if value.kind == "group" else value), problem
            elif type is not None and number is not None and number < 0.0 and number != -1.0:
                if re.fullmatch(_NOT_NEGATIVE, last):
                    yield value, f"`{parameter.text}` is {value.text}; it must not be negative"
            elif type is None and value.kind != "group" and len(last) > 3 and last not in valid:
                near = next((each for each in sorted(valid - written) if is_misspelt(last, each)), None)
                if near is not None:
                    yield parameter, f"`{kind}` has no parameter `{last}`" + Suggestion(near, last)
    yield from _one_level_too_high(source)


def _one_level_too_high(source: Source) -> Defects:
    """Yield the parameters of a plugin that are written after its section instead of in it."""
    kinds = {id(group): (kind, rows) for kind, group, rows in typed_groups(source) if kind[:1].isupper()}
    of_nodes = _names_of_nodes(PARAMETERS in source.text)
    for node in nodes(source) if kinds else ():
        for at, (section, value) in enumerate(node.entries):
            kind, rows = kinds.get(id(value), ("", ()))
            names = {name for name, _ in rows if "." not in name} - of_nodes
            _, above = kinds.get(id(node), ("", ()))
            names -= {key.text for key, _ in value.entries} | {name for name, _ in above}
            for key, inner in node.entries[at + 1 :] if kind else ():
                if key.text not in names or inner.kind == "group":
                    break
                yield key, f"`{key.text}` is a parameter of `{kind}` and belongs in `{section.text}`; indent it"


@cache
def _names_of_nodes(is_ros2: bool) -> frozenset[str]:
    """Return the parameters of nodes in the tables, without those of plugins, and those of plugins of all kinds."""
    tables = [(kind, rows) for kind, rows in _tables(is_ros2).items() if not kind[:1].isupper()]
    tables += [(kind, tuple(rows)) for kind, rows in schemas().items()] if is_ros2 else []
    return frozenset(name for _, rows in tables for name, _ in rows) | {"enabled", "plugin", "type", "topic"}


def wrong_numbers_of_plugins(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield integers in parameters of the type double, and the reverse: value, parameter, the right text."""
    for _, group, rows in typed_groups(source) if PARAMETERS in source.text else ():
        for name, _, value in parameters(group):
            type = next((type for pattern, type in rows if fnmatchcase(name, pattern)), "")
            if value.is_plain and type == "double" and re.fullmatch(r"[-+]?\d+", value.text):
                yield value, name, f"{value.text}.0"
            elif value.is_plain and type == "int" and re.fullmatch(r"[-+]?\d*\.\d+", value.text):
                yield value, name, f"{float(value.text):.0f}"
