"""Drivers of hardware that start in a simulation only, and Gazebo that starts without one only."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.launch.actions import actions_of
from urdfkit.lint.facts.launch.receivers import actions_at, receiver
from urdfkit.lint.facts.launch.records import Call
from urdfkit.lint.facts.nodes.conditional_starts import Start, starts
from urdfkit.lint.facts.nodes.simulation_time import GAZEBO
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes
from urdfkit.lint.facts.topics.node_topics import CAMERAS, topics_of
from urdfkit.lint.model.model import Model

_SIMULATED = r"(?:use_|is_|in_|run_)?(?:sim|simulation|simulated|gazebo|gz|ignition)(?:_mode|_time)?"
_ROBOT, _WORLD = "a driver of the hardware", "Gazebo"


def inverted_conditions(model: Model) -> Iterator[tuple[Source, tuple[int, int], str]]:
    """Yield launch file, place and message of each node or include whose condition is inverted."""
    by_file: dict[str, list[LaunchedNode]] = {}
    for node in launched_nodes(model):
        by_file.setdefault(node.source.file, []).append(node)
    for file, source in model.related_files.items():
        for start in starts(source)[0] if file.endswith(LAUNCH) else ():
            for name, value in start.conditions.items():
                what = _started(start, by_file, model) if re.fullmatch(_SIMULATED, name) else ""
                if what == (_ROBOT if value else _WORLD):
                    word = "true" if value else "false"
                    yield (
                        source,
                        _condition(source, start.place),
                        f"this starts {what} if `{name}` is {word}; the condition is inverted",
                    )


def _condition(source: Source, place: tuple[int, int]) -> tuple[int, int]:
    """Return the place of the condition of an action."""
    at = re.search(r"(?:If|Unless)Condition\b|\b(?:if|unless)(?=\s*=)", source.text[slice(*place)])
    return (place[0] + at.start(), place[0] + at.end()) if at is not None else place


def _started(start: Start, by_file: dict[str, list[LaunchedNode]], model: Model) -> str:
    """Return whether a start begins drivers or Gazebo; empty for others, and for both."""
    if not start.is_include:
        return _kind(start.package, start.program)
    if start.package in GAZEBO:
        return _WORLD
    path = receiver(Call(start.package, start.program, *start.place, ()), model)
    actions = actions_at(path, model) if path is not None else None
    if actions is None:
        return ""
    kinds = {_kind(node.package, node.program) for node in by_file.get(actions.source.file, ())} - {""}
    kinds |= {_WORLD for call in actions_of(actions.source).includes if call.package in GAZEBO}
    return kinds.pop() if len(kinds) == 1 else ""


def _kind(package: str, program: str) -> str:
    if package in GAZEBO:
        return _WORLD
    topics = topics_of(package, program)
    is_driver = package in CAMERAS or (topics is not None and not topics.read and package != "robot_localization")
    return _ROBOT if is_driver or program == "ros2_control_node" else ""
