"""MoveIt controllers, compared with the controllers of ros_control that they command.

Sources: moveit_simple_controller_manager (actions by type), ros2_controllers and ros_controllers (actions).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.control.controller_types import TYPES
from urdfkit.description.xml.source import Span
from urdfkit.lint.facts.control.controller_settings import ControllerSettings, settings
from urdfkit.lint.facts.control.launched_nodes import launches, started
from urdfkit.lint.facts.control.yaml_tree import Node, yamls
from urdfkit.lint.facts.moveit.settings import MoveitEntry
from urdfkit.lint.model.model import Model

_SPAWNERS = ("spawner", "spawner.py", "controller_manager")

_ACTIONS = {
    "FollowJointTrajectory": ("JointTrajectoryController",),
    "GripperCommand": ("GripperActionController",),
    "ParallelGripperCommand": ("GripperActionController",),
}
"""Type of a MoveIt controller → classes of controllers with its action."""

_PARALLEL = "ParallelGripperCommand"
"""Type of the action of parallel_gripper_action_controller (moveit2, issue 3017); others offer ``GripperCommand``."""

_NAMES = {"JointTrajectoryController": "follow_joint_trajectory", "GripperActionController": "gripper_cmd"}
"""Class of a controller → name of its action."""


def started_controllers(model: Model) -> dict[str, list[ControllerSettings]]:
    """Return name → settings of the controllers of ros_control in the YAML files around a robot."""
    found: dict[str, list[ControllerSettings]] = {}
    for source in yamls(model):
        for one in settings(source):
            found.setdefault(one.name, []).append(one)
    return found


def contradictions(
    entry: MoveitEntry, controllers: list[ControllerSettings], model: Model
) -> Iterator[tuple[Node, str]]:
    """Yield the type, the action and the joints of a MoveIt controller that no controller with its name has."""
    from urdfkit.lint.fix_builders import nearest

    kind = entry.settings.find("type")
    classes = _ACTIONS.get(kind.text, ()) if kind is not None else ()
    if not classes or not controllers or any(one.kind not in TYPES for one in controllers):
        return
    kinds = dict.fromkeys(one.kind for one in controllers)
    if kind is not None and not any(each.partition("/")[2] in classes for each in kinds):
        yield kind, f"controller `{entry.name.text}` has no action for `{kind.text}`: its type is {next(iter(kinds))}"
        return
    offers = {_PARALLEL if each.startswith("parallel_gripper") else "GripperCommand" for each in kinds}
    if kind is not None and kind.text in (_PARALLEL, "GripperCommand") and kind.text not in offers:
        yield kind, f"controller `{entry.name.text}` has the action {offers.pop()}, not {kind.text}"
        return
    action = entry.settings.find("action_ns")
    offered = {_NAMES.get(each.partition("/")[2], "") for each in kinds}
    name = offered.pop() if len(offered) == 1 else ""
    is_written = action is not None and action.text and "$" not in action.text
    if action is not None and name and is_written and nearest(action.text.strip("/"), (name,), cutoff=0.85) is None:
        yield action, f"controller `{entry.name.text}` has no action `{action.text}`; its action is `{name}`"
    names = {name for one in controllers for name in _joints(one)}
    joints = entry.settings.find("joints")
    is_complete = names <= model.robot.joint_by_name.keys()  # a joint that no robot has is reported where it is listed
    is_unique = all(len(set(each)) == len(each) for one in controllers for each in _listed(one))  # reported there
    for node in joints.items if joints is not None and names and is_complete and is_unique else ():
        if node.text in model.robot.joint_by_name and node.text not in names:
            yield node, f"controller `{entry.name.text}` does not control joint `{node.text}` and rejects trajectories"


def partial_lists(entry: MoveitEntry, controllers: list[ControllerSettings]) -> Iterator[tuple[Node, str, list[str]]]:
    """Yield the key of the joints of a MoveIt controller that lack some of those of a controller of trajectories.

    With it, yield a message and the lacking joints.

    Such a controller rejects goals without all of its joints unless ``allow_partial_joints_goal`` is true.
    """
    joints = entry.settings.find("joints")
    key = next((key for key, value in entry.settings.entries if value is joints), None)
    if len(controllers) != 1 or joints is None or key is None or not joints.items:
        return
    [one] = controllers
    is_partial = one.group.find("allow_partial_joints_goal")
    allowed = is_partial is not None and is_partial.text.lower() == "true"
    names, listed = _listed(one), [node.text for node in joints.items]
    if allowed or not one.kind.endswith("/JointTrajectoryController") or len(names) != 1 or len(set(names[0])) < 2:
        return
    lacking = [name for name in names[0] if name not in listed]
    if lacking and set(listed) < set(names[0]):
        which = ", ".join(f"`{name}`" for name in lacking[:3]) + (", …" if len(lacking) > 3 else "")
        yield key, f"`joints` lacks {which} of controller `{entry.name.text}`, which rejects such trajectories", lacking


def meant_controller(
    entry: MoveitEntry, controllers: dict[str, list[ControllerSettings]], taken: set[str]
) -> str | None:
    """Return the one controller with the joints of a MoveIt controller; None if none or several have them.

    Args:
        entry: a MoveIt controller.
        controllers: name → settings of the controllers of ros_control.
        taken: names of the MoveIt controllers.
    """
    joints = entry.settings.find("joints")
    wanted = set(joints.texts()) if joints is not None else set()
    every = [one for each in controllers.values() for one in each]
    if not wanted or any(one.kind not in TYPES and wanted & _joints(one) for one in every):
        return None
    kind = entry.settings.find("type")
    classes = _ACTIONS.get(kind.text, ()) if kind is not None else ()
    same = {
        name
        for name, each in controllers.items()
        for one in each
        if one.kind.partition("/")[2] in classes and wanted == _joints(one)
    }
    return same.pop() if len(same) == 1 and same.isdisjoint(taken) else None


def unspawned(
    names: set[str], controllers: dict[str, list[ControllerSettings]], model: Model
) -> Iterator[tuple[Span, str, str]]:
    """Yield the last spawned controller, a message and the name, for each MoveIt controller that no launch file starts.

    Nothing is yielded if some arguments of a spawner are computed. A controller whose joints a started controller has
    too is an alternative to that one.

    Args:
        names: names of the MoveIt controllers.
        controllers: name → settings of the controllers of ros_control.
        model: the linted model.
    """
    files = list(launches(model))
    spawners = [(file, node) for file in files for node in started(file) if node.package == "controller_manager"]
    spawners = [(file, node) for file, node in spawners if node.program in _SPAWNERS]
    words = [(file, word) for file, node in spawners for word in node.arguments]
    running = {word.name for _, word in words if word is not None}.intersection(controllers)
    if any(word is None for _, word in words) or not names & running:
        return
    moved = {joint for name in running for one in controllers[name] for joint in _joints(one)}
    file, last = [(file, word) for file, word in words if word is not None and word.name in running][-1]
    for name in sorted(names & controllers.keys() - running):
        joints = {joint for one in controllers[name] for joint in _joints(one)}
        is_named = any(re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", each.text) for each in files)
        if joints and not joints & moved and not is_named:
            message = f"no launch file spawns controller `{name}`, which MoveIt uses"
            yield file.span(last.start, last.end), message, name


def _joints(one: ControllerSettings) -> set[str]:
    return {name for each in _listed(one) for name in each}


def _listed(one: ControllerSettings) -> list[list[str]]:
    return [list(node.texts()) for key in ("joints", "joint") if (node := one.group.find(key)) is not None]
