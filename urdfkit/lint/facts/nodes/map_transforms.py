"""Nodes that publish the transform from the map to the odometry, and the launch arguments that start them together."""

import re
from collections.abc import Iterator
from itertools import combinations

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.launch.receivers import actions_at, receiver
from urdfkit.lint.facts.launch.records import Call
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.conditional_starts import Start, starts
from urdfkit.lint.facts.nodes.started import launched_nodes, parameter_files
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_NODES = {
    ("amcl", "amcl"),
    ("cartographer_ros", "cartographer_node"),
    ("gmapping", "slam_gmapping"),
    ("nav2_amcl", "amcl"),
    ("slam_toolbox", "async_slam_toolbox_node"),
    ("slam_toolbox", "localization_slam_toolbox_node"),
    ("slam_toolbox", "sync_slam_toolbox_node"),
}
"""Package and executable of nodes that publish the transform from the map to the odometry."""

_FILES = {
    ("nav2_bringup", "localization_launch.py"): "amcl",
    ("nav2_bringup", "slam_launch.py"): "slam_toolbox",
    ("slam_toolbox", "localization_launch.py"): "slam_toolbox",
    ("slam_toolbox", "online_async_launch.py"): "slam_toolbox",
    ("slam_toolbox", "online_sync_launch.py"): "slam_toolbox",
}
_OFF = ("tf_broadcast", "publish_tf", "transform_publish_period", "pub_map_odom_transform")
"""Parameters that can switch the transform off."""

_MAX_DEPTH = 4
_MAX_READINGS = 200


@record(eq=False)
class TransformSource:
    """A node that publishes the transform.

    Attributes:
        label: its name.
        conditions: the arguments that start it.
        place: the action in the first file that starts it.
        group: the group with a condition around this action.
    """

    label: str
    conditions: dict[str, bool]
    place: tuple[int, int]
    group: tuple[int, int] | None = None


_MAPPING, _LOCALIZATION = r"slam|mapping", r"amcl|locali[sz]ation"
_CONDITION = r"(?:If|Unless)Condition\b|\b(?:if|unless)(?=\s*=)"


def _inverted(first: TransformSource, second: TransformSource) -> TransformSource | None:
    """Return the source that an argument with the name of the other kind starts, such as amcl if ``slam`` is true."""
    for name, value in first.conditions.items() if first.conditions == second.conditions else ():
        kinds = [kind for kind in (_MAPPING, _LOCALIZATION) if re.search(kind, name)]
        unmeant = {_MAPPING: _LOCALIZATION, _LOCALIZATION: _MAPPING}
        wrong = (unmeant[kinds[0]] if value else kinds[0]) if len(kinds) == 1 else "$^"
        found = [each for each in (first, second) if re.search(wrong, each.label)]
        if len(found) == 1:
            return found[0]
    return None


def published_together(model: Model) -> Iterator[tuple[Source, tuple[int, int], tuple[str, str], str]]:
    """Yield the later action of each two that start publishers of the transform under the same arguments.

    Yields:
        The launch file, the start and end of the later action, the names of both publishers, and the message.
    """
    publishers = _Publishers(model, _map_filters(model))
    for name, source in model.related_files.items():
        if not name.endswith(LAUNCH):
            continue
        seen: set[tuple[int, int]] = set()
        actions, _ = starts(source)
        names = {argument for start in actions for argument in start.conditions}
        names |= {value[1:] for start in actions for value in start.passed.values() if value[:1] == "$"}
        found = publishers.in_file(source, {each: f"${each}" for each in names})
        for first, second in combinations(sorted(found, key=lambda each: each.place), 2):
            common = first.conditions.keys() & second.conditions.keys()
            is_nested = len(common) == min(len(first.conditions), len(second.conditions))
            is_possible = all(first.conditions[each] == second.conditions[each] for each in common)
            if first.place != second.place and is_nested and is_possible and second.place not in seen:
                seen.add(second.place)
                wrong = _inverted(first, second)
                around = wrong.group or wrong.place if wrong is not None else second.place
                at = re.search(_CONDITION, source.text[slice(*around)]) if wrong is not None else None
                if at is not None:
                    around = around[0] + at.start(), around[0] + at.end()
                conditions = {**first.conditions, **second.conditions}
                when = " and ".join(f"`{each}` is {str(value).lower()}" for each, value in conditions.items())
                labels = f"`{first.label}` and `{second.label}`"
                message = f"{labels} both publish the transform from the map frame to the odometry frame"
                both = first.label, second.label
                yield source, around, both, f"{message} if {when}" if when else message


class _Publishers:
    """Publishers of the transform in the launch files of a model, at any depth of includes.

    A file that is included again with the same values is read once, and after `_MAX_READINGS` files none is read:
    files that include each other many times would otherwise be read for minutes.
    """

    def __init__(self, model: Model, filters: set[tuple[str, str]]) -> None:
        self._model, self._filters = model, filters
        self._read_files: dict[tuple[str, int, frozenset[tuple[str, str]]], list[TransformSource]] = {}

    def in_file(self, source: Source, values: dict[str, str], depth: int = 0) -> list[TransformSource]:
        """Return the publishers that a file starts, itself or by its includes.

        Args:
            source: the launch file.
            values: the value of each argument: text, or ``$`` and the name of an argument of the first file.
            depth: how many includes lead to the file.
        """
        key = source.file, depth, frozenset(values.items())
        if key not in self._read_files and len(self._read_files) < _MAX_READINGS:
            self._read_files[key] = []
            self._read_files[key] = list(self._publishers_of(source, values, depth))
        return self._read_files.get(key, [])

    def _publishers_of(self, source: Source, values: dict[str, str], depth: int) -> Iterator[TransformSource]:
        for start in starts(source)[0]:
            conditions = _translated(start.conditions, values)
            if conditions is None:
                continue
            label = _label(start, source, self._filters)
            if label:
                yield TransformSource(label, conditions, start.place, start.group)
            elif start.is_include and depth < _MAX_DEPTH:
                for each in self._included(start, values, depth):
                    if all(conditions.get(name, value) == value for name, value in each.conditions.items()):
                        yield TransformSource(each.label, {**conditions, **each.conditions}, start.place, start.group)

    def _included(self, start: Start, values: dict[str, str], depth: int) -> list[TransformSource]:
        path = receiver(Call(start.package, start.program, *start.place, ()), self._model)
        inner = actions_at(path, self._model) if path is not None else None
        if inner is None:
            return []
        shared = {} if inner.is_ros1 else values
        inner_values = {name: shared.get(name, default) for name, default in starts(inner.source)[1].items()}
        for name, value in start.passed.items():
            inner_values[name] = values.get(value[1:], "") if value[:1] == "$" else value
        found = self.in_file(inner.source, inner_values, depth + 1)
        return list({(each.label, *each.conditions.items()): each for each in found}.values())


def _translated(conditions: dict[str, bool], values: dict[str, str]) -> dict[str, bool] | None:
    """Return the conditions in terms of the arguments of the first file; None if they never hold or are unknown."""
    found: dict[str, bool] = {}
    for name, wanted in conditions.items():
        value = values.get(name, "")
        if value[:1] == "$":
            found[value[1:]] = wanted
        elif value != str(wanted).lower():
            return None
    return found


def _label(start: Start, source: Source, filters: set[tuple[str, str]]) -> str:
    if start.is_include:
        return _FILES.get((start.package, start.program.rpartition("/")[2]), "")
    if (start.package, start.program) in _NODES and not any(word in source.text for word in _OFF):
        return start.name or start.program
    return start.name if start.name and (source.file, start.name) in filters else ""


def _map_filters(model: Model) -> set[tuple[str, str]]:
    """Return launch file and name of each filter of robot_localization that publishes the transform."""
    files, found = parameter_files(model), set[tuple[str, str]]()
    for node in launched_nodes(model):
        name = node.name.name if node.name is not None else ""
        for file in node.files if node.package == "robot_localization" and name else ():
            for key, group in sections(files[file]) if file in files else ():
                world, odom, publishes = (group.find(each) for each in ("world_frame", "odom_frame", "publish_tf"))
                is_on = publishes is None or publishes.text.lower() == "true"
                if key.text.strip("/") == name and world is not None and odom is not None and is_on:
                    found |= {(node.source.file, name)} if world.text != odom.text else set()
    return found
