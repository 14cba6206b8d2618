"""Planning groups of a robot: arms, which are chains of joints, and the grippers at their ends."""

import re
from collections import Counter
from dataclasses import dataclass

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.errors import KinematicsError, UnknownNameError, did_you_mean

LEAST = 4
"""Joints of an arm at least; legs of quadrupeds and heads have fewer."""
_USUAL = ("joint", "link", "wrist", "elbow", "shoulder", "forearm", "upper", "lower", "hand", "arm", "base")


@dataclass(frozen=True)
class PlanningGroup:
    """A planning group: a chain, or joints.

    Attributes:
        name: name of the group.
        base: first link of a chain; empty for a group of joints.
        tip: last link of a chain.
        joints: names of the moving joints, base first, without mimic joints.
    """

    name: str
    base: str
    tip: str
    joints: tuple[str, ...]


@dataclass(frozen=True)
class EndEffector:
    """An end effector: the group of a gripper, the link it is attached to, and the group of the arm."""

    name: str
    parent: str
    group: str
    parent_group: str


def find_groups(robot: Robot) -> tuple[list[PlanningGroup], list[EndEffector]]:
    """Return the arms and grippers of a robot.

    An arm is a chain of at least `LEAST` joints with one degree of freedom, in which each link but the last carries one
    moving joint. What moves beyond its end, with two branches or a mimic joint, is its gripper.
    """
    moving = _moving_below(robot)
    groups: list[PlanningGroup] = []
    effectors: list[EndEffector] = []
    for joints, ends in _chains(robot, moving):
        base, tip = joints[0].parent or "", joints[-1].child or ""
        name = _name(joints, [group.name for group in groups], "arm")
        groups.append(PlanningGroup(name, base, tip, tuple(joint.name for joint in joints)))
        fingers = [joint for joint in ends if joint.mimic is None]
        if fingers:
            side = name.removesuffix("arm").rstrip("_")
            hand = f"{side}_gripper" if side else "gripper"
            mount = _mount(robot, tip, ends)
            groups.append(PlanningGroup(hand, "", "", tuple(joint.name for joint in fingers)))
            effectors.append(EndEffector(f"{hand}_end", mount, hand, name))
    return groups, effectors


def group_of_chain(robot: Robot, name: str, base: str, tip: str) -> PlanningGroup:
    """Return the group of a chain from a link to a link below it.

    Raises:
        UnknownNameError: a link is unknown.
        KinematicsError: the tip is not below the base, or no joint between them moves.
    """
    for link in (base, tip):
        if link not in robot.link_by_name:
            hint = did_you_mean(link, robot.link_by_name)
            raise UnknownNameError(f"group `{name}`: robot `{robot.name}` has no link `{link}`{hint}")
    joints: list[Joint] = []
    at = tip
    while at != base:
        above = robot.parents_of.get(at)
        if not above or len(joints) > len(robot.joints):
            raise KinematicsError(f"group `{name}`: `{tip}` is not below `{base}`")
        joints.insert(0, above[0])
        at = above[0].parent or ""
    moving = tuple(joint.name for joint in joints if joint.is_movable and joint.mimic is None)
    if not moving:
        raise KinematicsError(f"group `{name}`: no joint moves between `{base}` and `{tip}`")
    return PlanningGroup(name, base, tip, moving)


def _moving_below(robot: Robot) -> dict[str, list[Joint]]:
    """Return link → the next moving joints below it, through fixed joints."""
    found: dict[str, list[Joint]] = {}
    for link in robot.links:
        waiting, ends = [link.name], list[Joint]()
        while waiting and len(ends) <= len(robot.joints):
            for joint in robot.children_of.get(waiting.pop(), ()):
                if joint.is_movable:
                    ends.append(joint)
                elif joint.child is not None:
                    waiting.append(joint.child)
        found[link.name] = ends
    return found


def _chains(robot: Robot, moving: dict[str, list[Joint]]) -> list[tuple[list[Joint], list[Joint]]]:
    """Return the chains of arms, each with all moving joints beyond its end."""
    found = []
    waiting = [joint for root in robot.roots() for joint in moving[root.name]]
    while waiting:
        joint = waiting.pop(0)
        chain = [joint]
        while len(below := moving.get(chain[-1].child or "", [])) == 1 and _serial(below[0]):
            chain.append(below[0])
        while chain and not _serial(chain[0]):
            chain.pop(0)
        ends = _all_below(moving, below)
        if len(chain) >= LEAST:
            found.append((chain, ends if len(ends) <= 2 * LEAST else []))
        else:
            waiting += below
    return found


def _serial(joint: Joint) -> bool:
    return joint.type in ("revolute", "continuous", "prismatic") and joint.mimic is None


def _all_below(moving: dict[str, list[Joint]], joints: list[Joint]) -> list[Joint]:
    found, waiting = [], list(joints)
    while waiting:
        joint = waiting.pop(0)
        found.append(joint)
        waiting += moving.get(joint.child or "", [])
    return found


def _mount(robot: Robot, tip: str, ends: list[Joint]) -> str:
    """Return the link that carries all fingers if it is one, else the end of the arm."""
    parents = {joint.parent for joint in ends} - {joint.child for joint in ends}
    return next(iter(parents), None) or tip if len(parents) == 1 else tip


def _name(joints: list[Joint], taken: list[str], kind: str) -> str:
    """Return a name for a group from the word that its joints share, such as `left`."""
    words = Counter(word for joint in joints for word in dict.fromkeys(re.findall(r"[a-z]+", joint.name.lower())))
    shared = [word for word, count in words.items() if count == len(joints) and word not in _USUAL and len(word) > 1]
    letters = {match[0] for joint in joints if (match := re.match(r"[lr](?=_)", joint.name.lower()))}
    if not shared and len(letters) == 1:
        shared = [{"l": "left", "r": "right"}[letters.pop()]]
    name = f"{shared[0]}_{kind}" if shared else kind
    number = 2
    while name in taken:
        name = f"{name.rstrip('0123456789_')}_{number}"
        number += 1
    return name
