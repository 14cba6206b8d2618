"""Inverted conditions of launch files: drivers of hardware in a simulation, and actions without their argument.

Drivers must not start in a simulation only, and Gazebo not without one only. An action that an argument names must not
start if the argument is false only.
"""

import re
from collections.abc import Iterator

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.launch.actions import actions_of
from urdfkit.lint.facts.launch.receivers import actions_at, receiver
from urdfkit.lint.facts.launch.records import Call
from urdfkit.lint.facts.nodes.conditional_starts import ConditionalAction, Start, conditional_actions, starts
from urdfkit.lint.facts.nodes.simulation_time import GAZEBO
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes
from urdfkit.lint.facts.topics.node_topics import CAMERAS, topics_of
from urdfkit.lint.model.model import Model

_SIMULATED = r"(?:use_|is_|in_|run_)?(?:sim|simulate|simulation|simulated|gazebo|gz|ignition)(?:_mode|_time)?"
_CONDITION = r"(?:If|Unless)Condition\b|\b(?:if|unless)(?=\s*=)"
_ROBOT, _WORLD = "a driver of the hardware", "Gazebo"

_OPTIONAL = frozenset(("bringup", "enable", "enabled", "launch", "load", "open", "run", "show", "start", "use", "with"))
_NEGATIVE = frozenset(("disable", "headless", "no", "skip", "without"))
_ALSO = {
    "gui": ("gzclient", "rqt"),
    "headless": ("gui", "gzclient", "rqt", "rviz"),
    "joy": ("joystick",),
    "joystick": ("joy",),
    "localization": ("amcl",),
    "nav": ("navigation",),
    "navigation": ("nav",),
}
"""Word of an argument → other words of the programs that it stands for."""

_OTHERS = frozenset(
    (
        *("default", "dummy", "empty", "fake", "headless", "keyboard", "localization", "mock"),
        *("no", "sim", "simulated", "static", "without"),
    )
)
"""Words of programs that an argument can replace: ``use_camera`` and ``fake_camera``."""


def inverted_conditions(model: Model) -> Iterator[tuple[Source, tuple[int, int], str]]:
    """Yield launch file, place and message of each action whose condition is inverted."""
    seen = set[tuple[str, int]]()
    for source, place, message in (*_in_simulation(model), *_by_name(model), *_both_sliders(model)):
        if (source.file, place[0]) not in seen:
            seen.add((source.file, place[0]))
            yield source, place, message


def _by_name(model: Model) -> Iterator[tuple[Source, tuple[int, int], str]]:
    """Yield the actions that an argument names and that start if it is false only, or the reverse."""
    for file, source in model.related_files.items():
        conditional = list(conditional_actions(source)) if file.endswith(LAUNCH) else []
        for each in conditional:
            subject, is_started = _named_by(each)
            others = [other for other in conditional if other.argument == each.argument and other.value != each.value]
            if subject and each.value != is_started and not any(_named_by(other)[0] for other in others):
                word = "true" if each.value else "false"
                message = f"this starts `{subject}` if `{each.argument}` is {word}; the condition is inverted"
                yield source, _condition(source, each.place), message


_SLIDERS = {"joint_state_publisher_gui": True, "joint_state_publisher": False}
"""Program → whether it has a user interface; a robot needs one of them."""

_SEPARATED = r"namespace|\bns\s*=|joint_states|source_list"
"""Matches launch files whose publishers of joint states can have separate topics."""


def _both_sliders(model: Model) -> Iterator[tuple[Source, tuple[int, int], str]]:
    """Yield the second publisher of joint states that starts under the condition of the first one."""
    for file, source in model.related_files.items():
        is_one_robot = file.endswith(LAUNCH) and not re.search(_SEPARATED, source.text)
        found = list(conditional_actions(source)) if is_one_robot and "joint_state_pub" in source.text else []
        own = [(each, each.subjects[0][1]) for each in found if len(each.subjects) == 1]
        own = [(each, program) for each, program in own if program in _SLIDERS and "gui" in each.argument.lower()]
        if len(own) == 2 and own[0][1] != own[1][1] and len({(each.argument, each.value) for each, _ in own}) == 1:
            has_interface = not own[0][0].value  # `gui` must start the publisher with the sliders
            wrong = next((each for each, program in own if _SLIDERS[program] is has_interface), own[1][0])
            word = "true" if wrong.value else "false"
            message = f"both publishers of joint states start if `{wrong.argument}` is {word}; invert this condition"
            yield source, _condition(source, wrong.place), message


def _named_by(action: ConditionalAction) -> tuple[str, bool]:
    """Return the started program or file that the argument of an action names, and the value that must start it."""
    words = set(action.argument.lower().split("_"))
    meant = words - _OPTIONAL - _NEGATIVE
    is_started = not words & _NEGATIVE
    for package, program in action.subjects:
        tokens = {token.rstrip("0123456789") for token in re.split(r"[^a-z0-9]+", f"{package} {program}".lower())}
        needed = meant or words & {"headless"}
        if needed and all(tokens & {word, *_ALSO.get(word, ())} for word in needed) and not tokens & _OTHERS:
            return program.rpartition("/")[2] or package, is_started
    return "", is_started


def _in_simulation(model: Model) -> Iterator[tuple[Source, tuple[int, int], str]]:
    """Yield the drivers that start in a simulation only, and Gazebo that starts without one only."""
    by_file: dict[str, list[LaunchedNode]] = {}
    for node in launched_nodes(model):
        by_file.setdefault(node.source.file, []).append(node)
    for file, source in model.related_files.items():
        for start in starts(source)[0] if file.endswith(LAUNCH) else ():
            for name, value in start.conditions.items():
                what = _started(start, by_file, model) if re.fullmatch(_SIMULATED, name) else ""
                if what == (_ROBOT if value else _WORLD):
                    word = "true" if value else "false"
                    message = f"this starts {what} if `{name}` is {word}; the condition is inverted"
                    is_own = re.search(_CONDITION, source.text[slice(*start.place)]) is not None
                    yield source, _condition(source, start.place if is_own else start.group or start.place), message
        for action in conditional_actions(source) if file.endswith(LAUNCH) else ():
            if re.fullmatch(_SIMULATED, action.argument):
                parts = [
                    Start(action.place, {}, *each, "." in each[1] and "/" in each[1], "", {})
                    for each in action.subjects
                ]
                kinds = {_started(part, by_file, model) for part in parts}
                if kinds == {_ROBOT if action.value else _WORLD}:
                    word = "true" if action.value else "false"
                    message = f"this starts {kinds.pop()} if `{action.argument}` is {word}; the condition is inverted"
                    yield source, _condition(source, action.place), message


def _condition(source: Source, place: tuple[int, int]) -> tuple[int, int]:
    """Return the place of the condition of an action."""
    at = re.search(_CONDITION, source.text[slice(*place)])
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
