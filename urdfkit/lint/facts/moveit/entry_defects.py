"""Defects of the entries of MoveIt's YAML files: groups, controllers and joint limits.

Source: moveit_plugins/moveit_simple_controller_manager, Noetic to Rolling.
"""

import math
from collections.abc import Iterable, Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, documents, not_a_number, number_of
from urdfkit.lint.facts.moveit.settings import CONTROLLER_TYPES, MoveitEntry, entries, unwrapped
from urdfkit.lint.fix_builders import nearest

_MANAGERS = ("moveit_simple_controller_manager", "moveit_ros_control_interface")
_ACTIONS = ("follow_joint_trajectory", "gripper_cmd", "gripper_action")
_DEGREES = 180.0 / math.pi
Defects = Iterator[tuple[Node, str]]


def incomplete_entries(source: Source, is_ros2: bool, has_manager: bool) -> Defects:
    """Yield groups without a solver and controllers without a required parameter.

    Args:
        source: a MoveIt YAML file.
        is_ros2: whether MoveIt 2 reads it.
        has_manager: whether another file names the controller manager of MoveIt.
    """
    for entry in entries(source):
        name, found = entry.name.text, {key.text for key, _ in entry.settings.entries}
        if entry.kind == "group" and "kinematics_solver" not in found and "<<" not in found:
            if _is_misspelt("kinematics_solver", found):
                continue
            yield entry.name, f"group `{name}` has no `kinematics_solver`"
        elif entry.kind == "controller" and "<<" not in found:
            kind = entry.settings.find("type")
            if "joints" not in found and not _is_misspelt("joints", found):
                yield entry.name, f"controller `{name}` has no `joints`"
            if "action_ns" in found if kind is None else kind.text in CONTROLLER_TYPES:
                for parameter in ("type", *(() if "ns" in found else ("action_ns",))):
                    if parameter not in found and not _is_misspelt(parameter, found):
                        yield entry.name, f"controller `{name}` has no `{parameter}`"
    for document in documents(source):
        for top in unwrapped(document):
            lists = top.find("controller_list")
            for item in lists.items if lists is not None else ():
                if item.find("name") is None and item.find("joints") is not None:
                    yield item, "controller of `controller_list` has no `name`"
            for key, value in top.entries:
                if key.text != "moveit_simple_controller_manager":
                    continue
                names = [each.text for each, _ in value.entries]
                if "controller_names" not in names and not _is_misspelt("controller_names", names):
                    yield key, "`moveit_simple_controller_manager` has no `controller_names`; MoveIt uses no controller"
                written = [each.text for each, _ in top.entries]
                if (
                    is_ros2
                    and not has_manager
                    and not {"moveit_controller_manager", "moveit_manage_controllers"} & {*written}
                    and not _is_misspelt("moveit_controller_manager", written)
                ):
                    yield key, "no file sets `moveit_controller_manager`; MoveIt uses no controller"


def _is_misspelt(name: str, found: Iterable[str]) -> bool:
    return (
        nearest(name, [each for each in found if each not in _MANAGERS], cutoff=0.75 if len(name) < 8 else 0.85)
        is not None
    )


_BEYOND = {"position": 5.0, "velocity": 2.0}
"""Smallest ratio of a limit of MoveIt to that of the robot that is not meant; positions are often widened."""


def limit_defects(entry: MoveitEntry, joint: Joint | None) -> Defects:
    """Yield values of ``joint_limits`` that are no numbers, and limits in degrees or beyond those of the robot."""
    limits = joint.limit if joint is not None else None
    for key, node in entry.settings.entries:
        side, _, quantity = key.text.partition("_")
        if side not in ("min", "max"):
            if key.text.startswith("has_") and node.text.lower() in ("true", "false") and not node.is_plain:
                yield node, f'`{key.text}` is "{node.text}", a quoted string; write true or false'
            continue
        if problem := not_a_number(node):
            yield node, f"`{key.text}` of joint `{entry.name.text}` is {problem}"
            continue
        if (
            limits is None
            or joint is None
            or joint.type not in ("revolute", "prismatic", "continuous")
            or (value := number_of(node)) is None
        ):
            continue
        bounds = {"min_position": limits.lower, "max_position": limits.upper, "max_velocity": limits.velocity}
        bound = bounds.get(key.text)
        if bound is None or not bound or (quantity == "position" and joint.type == "continuous"):
            continue
        unit = "m" if joint.type == "prismatic" else "rad"
        unit += "/s" if quantity == "velocity" else ""
        ratio = value / bound
        if joint.type != "prismatic" and abs(ratio / _DEGREES - 1.0) < 0.005:
            message = f"`{key.text}` of joint `{entry.name.text}` is {value:g}: the limit {bound:g} {unit} in degrees"
            yield node, f"{message}; write {bound:g}"
        elif ratio >= _BEYOND[quantity]:
            yield (
                node,
                f"`{key.text}` of joint `{entry.name.text}` is {value:g} {unit}, but its limit is {bound:g} {unit}",
            )


def uncontrolled_joints(source: Source, root: Element, robot: Robot) -> Defects:
    """Yield controllers that lack one joint of the group that they move."""
    from urdfkit.lint.facts.moveit.srdf import groups, joints_of

    passive = {element.get("name") for element in root.find_all("passive_joint")}
    controllers = [entry for entry in entries(source) if entry.kind == "controller"]
    controlled = {node.text for entry in controllers for node in _joints(entry)}
    active: list[tuple[str, set[str]]] = []
    for name in groups(root):
        found = {
            robot.joint_by_name[each] for each in joints_of(name, root, robot) or () if each in robot.joint_by_name
        }
        moving = {
            joint.name
            for joint in found
            if joint.type in ("revolute", "prismatic", "continuous")
            and joint.mimic is None
            and joint.name not in passive
        }
        active.append((name, moving))
    for entry in controllers:
        kind, joints = entry.settings.find("type"), {node.text for node in _joints(entry)}
        whole = any(moving and moving <= joints for _, moving in active)
        if kind is None or kind.text != "FollowJointTrajectory" or not joints or whole:
            continue
        for group, moving in active:
            lacking = moving - controlled
            if len(lacking) == 1 and joints < moving and len(joints) == len(moving) - 1:
                key = next(key for key, _ in entry.settings.entries if key.text == "joints")
                message = f"no controller moves joint `{lacking.pop()}` of group `{group}`; add it to `joints`"
                yield key, message
                break


def _joints(entry: MoveitEntry) -> tuple[Node, ...]:
    node = entry.settings.find("joints")
    return node.items if node is not None else ()


def controller_defects(entry: MoveitEntry) -> Defects:
    """Yield values of a MoveIt controller that have the wrong type, and misspelt actions."""
    name, seen = entry.name.text, set[str]()
    joints, action, default = (entry.settings.find(key) for key in ("joints", "action_ns", "default"))
    if joints is not None and joints.kind == "text" and joints.text:
        yield joints, f"`joints` of controller `{name}` is a string; write a list"
    for node in joints.items if joints is not None else ():
        if node.text and node.text in seen:
            yield node, f"`{node.text}` occurs twice in `joints` of controller `{name}`"
        seen.add(node.text)
    near = nearest(action.text, _ACTIONS, cutoff=0.85) if action is not None else None
    if action is not None and near is not None and action.text not in _ACTIONS:
        yield action, f"unknown action `{action.text}` of controller `{name}`" + Suggestion(near, action.text)
    if default is not None and default.kind == "text" and not default.is_plain:
        yield default, f'`default` of controller `{name}` is "{default.text}", a quoted string; write true or false'


def unused_limits(source: Source) -> Defects:
    """Yield each limit above zero that is switched off, although most other joints have that limit.

    The setup assistant writes zeros for limits that are switched off.
    """
    joints = [entry for entry in entries(source) if entry.kind == "joint"]
    for quantity in ("velocity", "acceleration"):
        flags = [(entry, flag) for entry in joints if (flag := entry.settings.find(f"has_{quantity}_limits"))]
        off = [(entry, flag) for entry, flag in flags if flag.text.lower() in ("false", "no", "off")]
        for entry, flag in off if 2 * len(off) < len(flags) else ():
            value = number_of(entry.settings.find(f"max_{quantity}"))
            if value is not None and value > 0.0:
                name = entry.name.text
                yield flag, f"`max_{quantity}` of joint `{name}` is not used, because `has_{quantity}_limits` is false"
