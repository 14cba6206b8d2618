"""Joints of the groups of an SRDF, compared with the projections of planners and with the names of the groups.

A projection of MoveIt's OMPL planners reads joints of its group; this was not compared with the source.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, documents
from urdfkit.lint.facts.moveit.settings import entries, unwrapped
from urdfkit.lint.facts.moveit.srdf import groups, joints_of


def projection_defects(
    source: Source, root: Element, robot: Robot, texts: Collection[str]
) -> Iterator[tuple[Node, str, tuple[str, ...]]]:
    """Yield the projections of groups with joints that the groups do not contain, or that no other file names.

    The names after the message are the joint and its group if the group does not contain it.

    Args:
        source: a file with planners.
        root: the SRDF.
        robot: the robot.
        texts: the texts of the other files.
    """
    defined = groups(root)
    for group, settings in (entry for each in documents(source) for top in unwrapped(each) for entry in top.entries):
        node = settings.find("projection_evaluator") if group.text in defined else None
        written = re.fullmatch(r"joints\(([\w\s,./-]+)\)", node.text.strip()) if node is not None else None
        members = joints_of(group.text, root, robot) if written is not None else None
        names = [name.strip() for name in written[1].split(",")] if written is not None and members else []
        foreign = [name for name in names if name in robot.joint_by_name and name not in (members or ())]
        unknown = [name for name in names if name not in robot.joint_by_name] if not foreign else []
        unknown = [name for name in unknown if not any(re.search(rf"\b{re.escape(name)}\b", text) for text in texts)]
        if node is not None and unknown and len(unknown) < len(names):
            yield node, f"joint `{unknown[0]}` of `projection_evaluator` does not exist in the robot", ()
        if node is not None and foreign:
            message = f"joint `{foreign[0]}` of `projection_evaluator` is not in group `{group.text}`"
            yield node, message, (foreign[0], group.text)


def group_of_states(name: str, candidates: Collection[str], root: Element, robot: Robot) -> str | None:
    """Return the only candidate with all joints that the states of an undefined group set; None without one.

    Args:
        name: the undefined group.
        candidates: groups of the SRDF.
        root: the SRDF.
        robot: the robot.
    """
    states = [state for state in root.find_all("group_state") if state.get("group") == name]
    valued = {value.get("name") or "" for state in states for value in state.find_all("joint")}
    found = [each for each in candidates if valued and valued <= (joints_of(each, root, robot) or set())]
    return found[0] if len(found) == 1 else None


def without_chain(source: Source, root: Element, robot: Robot) -> Iterator[tuple[Node, str]]:
    """Yield the groups with a solver for chains whose joints are on several branches of the robot.

    Source: moveit_kinematics (kdl_kinematics_plugin.cpp, "Group ... is not a chain"), Noetic to Rolling.
    """
    is_unique = len(robot.joint_by_name) == len(robot.joints)
    for entry in entries(source) if is_unique else ():
        solver = entry.settings.find("kinematics_solver") if entry.kind == "group" else None
        if solver is None or not re.search(_FOR_CHAINS, solver.text):
            continue
        names = joints_of(entry.name.text, root, robot) or ()
        joints = [robot.joint_by_name[name] for name in names if name in robot.joint_by_name]
        joints = [joint for joint in joints if joint.is_movable]
        ends = [joint for joint in joints if not any(_is_below(other, joint, robot) for other in joints)]
        if len(ends) > 1:
            tips = " and ".join(f"`{joint.name}`" for joint in sorted(ends, key=lambda each: each.name)[:2])
            yield entry.name, f"group `{entry.name.text}` is not a chain: {tips} are on different branches"


def orientation_out_of_reach(source: Source, root: Element, robot: Robot) -> Iterator[tuple[Node, str]]:
    """Yield the solvers of arms with too few joints for an orientation, without ``position_only_ik``.

    Source: moveit_kinematics (kdl_kinematics_plugin.cpp), which then solves for all six coordinates of a pose.
    """
    for entry in entries(source):
        solver = entry.settings.find("kinematics_solver") if entry.kind == "group" else None
        if solver is None or "KDL" not in solver.text or entry.settings.find("position_only_ik") is not None:
            continue
        names = joints_of(entry.name.text, root, robot) or ()
        joints = [robot.joint_by_name[name] for name in names if name in robot.joint_by_name]
        count = sum(joint.is_movable and joint.mimic is None for joint in joints)
        if _FEWEST <= count <= _MOST:
            message = f"group `{entry.name.text}` has {count} joints, too few for the orientation of a pose; "
            yield solver, message + "add `position_only_ik: true`"


_FEWEST, _MOST = 3, 4
"""Numbers of joints of an arm that reaches places, but few orientations."""

_FOR_CHAINS = r"KDL|LMA|TRAC_IK|TRACIK"


def _is_below(joint: Joint, above: Joint, robot: Robot) -> bool:
    """Return whether a joint is farther from the root than another one, on the same branch."""
    seen = set[str]()
    at = next(iter(robot.parents_of.get(joint.parent or "", ())), None)
    while at is not None and at.name not in seen:
        if at is above:
            return True
        seen.add(at.name)
        at = next(iter(robot.parents_of.get(at.parent or "", ())), None)
    return False


def repeated_groups(root: Element, robot: Robot) -> Iterator[tuple[Element, str]]:
    """Yield the groups with the joints of another group, named after a third group of which they have no joint.

    ``left_arm_torso`` without the joints of ``torso`` repeats ``left_arm``.
    """
    defined = groups(root)
    joints = {name: joints_of(name, root, robot) for name in defined}
    for name, group in defined.items():
        own = _moving(joints[name], robot)
        equal = [other for other in defined if other != name and own and _moving(joints[other], robot) == own]
        named = [
            other
            for other in defined
            if other != name and other not in equal and re.search(rf"(?:^|_){re.escape(other)}(?:_|$)", name)
        ]
        lacking = [other for other in named if (each := _moving(joints[other], robot)) and not each & own]
        if lacking and any(re.search(rf"(?:^|_){re.escape(other)}(?:_|$)", name) for other in equal):
            yield group, f"group `{name}` has the joints of `{equal[0]}` only, and none of group `{lacking[0]}`"


def _moving(names: set[str] | None, robot: Robot) -> frozenset[str]:
    joints = [robot.joint_by_name[name] for name in names or () if name in robot.joint_by_name]
    return frozenset(joint.name for joint in joints if joint.is_movable and joint.mimic is None)
