"""Mistakes in the SRDF."""

from __future__ import annotations

import random
from collections.abc import Iterator

from tests.bench.package_mutants.mutant import (
    Mutant,
    Workspace,
    attribute,
    element,
    kind,
    literal,
    renamed_tag,
    typo,
    value,
    wrong_name,
)

_SRDF = kind("SRDF")
_FILE = r"\.srdf$"
Mutants = Iterator[Mutant]


def _groups(ws: Workspace) -> list[str]:
    return [literal(tag, "name") for _, tag in ws.tags(_FILE, "group")]


@_SRDF
def group_of_unknown_joint(ws: Workspace, lot: random.Random) -> Mutants:
    """The group lacks the joint."""
    for file, tag in ws.tags(_FILE, "joint"):
        if tag.parent is not None and tag.parent.name == "group":
            yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot, ws.joints))


@_SRDF
def group_of_unknown_link(ws: Workspace, lot: random.Random) -> Mutants:
    """The group lacks the link."""
    for file, tag in ws.tags(_FILE, "link"):
        for _ in range(4):
            yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot, ws.links))


@_SRDF
def chain_to_unknown_link(ws: Workspace, lot: random.Random) -> Mutants:
    """The chain is empty: MoveIt has no group."""
    for file, tag in ws.tags(_FILE, "chain"):
        for name in ("base_link", "tip_link"):
            for _ in range(2):
                yield wrong_name(file, tag, name, typo(literal(tag, name), lot, ws.links))
            yield wrong_name(file, tag, name, lot.choice(["base", "tool0", "end_effector", "base_link_arm"]))


@_SRDF
def chain_reversed(ws: Workspace, lot: random.Random) -> Mutants:
    """The tip is not below the base: the chain is empty."""
    for file, tag in ws.tags(_FILE, "chain"):
        base, tip = literal(tag, "base_link"), literal(tag, "tip_link")
        yield element(file, tag, f'<chain base_link="{tip}" tip_link="{base}"/>')


@_SRDF
def chain_attribute_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A chain needs both ends."""
    for file, tag in ws.tags(_FILE, "chain"):
        for name in ("base_link", "tip_link"):
            yield attribute(file, tag, name, "")
            yield attribute(file, tag, name, typo(name, lot))


@_SRDF
def unknown_subgroup(ws: Workspace, lot: random.Random) -> Mutants:
    """The group is dropped: its part is unknown."""
    for file, tag in ws.tags(_FILE, "group"):
        if tag.parent is not None and tag.parent.name == "group":
            for _ in range(2):
                yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot, _groups(ws)))


@_SRDF
def group_contains_itself(ws: Workspace, lot: random.Random) -> Mutants:
    """The group cannot be resolved."""
    for file, tag in ws.tags(_FILE, "group"):
        if tag.parent is not None and tag.parent.name == "group":
            yield wrong_name(file, tag, "name", literal(tag.parent, "name"))


@_SRDF
def renamed_group(ws: Workspace, lot: random.Random) -> Mutants:
    """States, end effectors and YAML files name the old group."""
    for file, tag in ws.tags(_FILE, "group"):
        name = literal(tag, "name")
        if tag.parent is not None and tag.parent.name == "robot" and ws.files[file].count(f'"{name}"') > 1:
            yield wrong_name(file, tag, "name", typo(name, lot, _groups(ws)), uses=True)


@_SRDF
def group_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """States and end effectors name a group that does not exist."""
    for file, tag in ws.tags(_FILE, "group"):
        name = literal(tag, "name")
        if tag.parent is not None and tag.parent.name == "robot" and ws.files[file].count(f'"{name}"') > 1:
            yield element(file, tag, names=(name,), uses=True)


@_SRDF
def empty_group(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt drops a group without joints."""
    for file, tag in ws.tags(_FILE, "group"):
        if len(tag.children) == 1:
            yield element(file, tag.children[0])


@_SRDF
def duplicated_group(ws: Workspace, lot: random.Random) -> Mutants:
    """Of two groups of one name one is lost."""
    for file, tag in ws.tags(_FILE, "group"):
        others = [name for name in _groups(ws) if name != literal(tag, "name")]
        if tag.parent is not None and tag.parent.name == "robot":
            yield wrong_name(file, tag, "name", lot.choice(others), uses=True)


@_SRDF
def state_of_unknown_group(ws: Workspace, lot: random.Random) -> Mutants:
    """The state is dropped."""
    for file, tag in ws.tags(_FILE, "group_state"):
        yield wrong_name(file, tag, "group", typo(literal(tag, "group"), lot, _groups(ws)))


@_SRDF
def state_of_unknown_joint(ws: Workspace, lot: random.Random) -> Mutants:
    """The state lacks the joint."""
    for file, tag in ws.tags(_FILE, "joint"):
        if tag.parent is not None and tag.parent.name == "group_state":
            yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot, ws.joints))


@_SRDF
def state_of_other_joint(ws: Workspace, lot: random.Random) -> Mutants:
    """The joint is not in the group of the state."""
    for file, tag in ws.tags(_FILE, "joint"):
        if tag.parent is not None and tag.parent.name == "group_state":
            arm = literal(tag.parent, "group") in ("arm", "manipulator")
            other = (
                ("gripper_left_joint" if ws.ros == 1 else "jaw_joint")
                if arm
                else ("joint_2" if ws.ros == 1 else "arm_yaw")
            )
            yield wrong_name(file, tag, "name", other)


@_SRDF
def state_beyond_limits(ws: Workspace, lot: random.Random) -> Mutants:
    """The position is beyond the limits, as in degrees."""
    for file, tag in ws.tags(_FILE, "joint"):
        if tag.parent is not None and tag.parent.name == "group_state":
            yield value(file, tag, "value", lot.choice(["90", "-45", "5.2", "-4"]))


@_SRDF
def state_without_number(ws: Workspace, lot: random.Random) -> Mutants:
    """The position cannot be read."""
    for file, tag in ws.tags(_FILE, "joint"):
        if tag.parent is not None and tag.parent.name == "group_state":
            yield value(file, tag, "value", lot.choice(["", "0,5", "pi/2", "1.2 rad"]))
            yield attribute(file, tag, "value", "")


@_SRDF
def duplicated_state(ws: Workspace, lot: random.Random) -> Mutants:
    """Of two states of one name one is lost."""
    for file, tag in ws.tags(_FILE, "group_state"):
        for _, other in ws.tags(_FILE, "group_state"):
            if other.start != tag.start and literal(other, "group") == literal(tag, "group"):
                yield wrong_name(file, tag, "name", literal(other, "name"))


@_SRDF
def end_effector_of_unknown_part(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt drops the end effector."""
    for file, tag in ws.tags(_FILE, "end_effector"):
        for name, taken in (("parent_link", ws.links), ("group", _groups(ws)), ("parent_group", _groups(ws))):
            yield wrong_name(file, tag, name, typo(literal(tag, name), lot, taken))


@_SRDF
def end_effector_attribute_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """An end effector needs a name, a group and a link."""
    for file, tag in ws.tags(_FILE, "end_effector"):
        for name in ("name", "parent_link", "group"):
            yield attribute(file, tag, name, "")
        yield attribute(file, tag, "parent_link", "parentlink")


@_SRDF
def end_effector_inside_its_parent(ws: Workspace, lot: random.Random) -> Mutants:
    """The parent group contains the end effector."""
    for file, tag in ws.tags(_FILE, "end_effector"):
        yield value(file, tag, "parent_group", literal(tag, "group"))
        yield value(file, tag, "group", literal(tag, "parent_group"))


@_SRDF
def virtual_joint_of_unknown_link(ws: Workspace, lot: random.Random) -> Mutants:
    """The robot is not attached to its frame."""
    for file, tag in ws.tags(_FILE, "virtual_joint"):
        for _ in range(2):
            yield wrong_name(file, tag, "child_link", typo(literal(tag, "child_link"), lot, ws.links))


@_SRDF
def virtual_joint_type(ws: Workspace, lot: random.Random) -> Mutants:
    """A virtual joint is fixed, planar or floating."""
    for file, tag in ws.tags(_FILE, "virtual_joint"):
        for wrong in ("plane", "Fixed", "float", "revolute"):
            yield wrong_name(file, tag, "type", wrong)


@_SRDF
def virtual_joint_attribute_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A virtual joint needs a type, a frame and a link."""
    for file, tag in ws.tags(_FILE, "virtual_joint"):
        for name in ("type", "parent_frame", "child_link"):
            yield attribute(file, tag, name, "")


@_SRDF
def passive_joint_unknown(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt waits for the state of the joint."""
    for file, tag in ws.tags(_FILE, "passive_joint"):
        for _ in range(2):
            yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot, ws.joints))


@_SRDF
def disabled_pair_of_unknown_link(ws: Workspace, lot: random.Random) -> Mutants:
    """The pair collides: no plan is found."""
    for file, tag in ws.tags(_FILE, "disable_collisions"):
        for name in ("link1", "link2"):
            yield wrong_name(file, tag, name, typo(literal(tag, name), lot, ws.links))


@_SRDF
def disabled_pair_incomplete(ws: Workspace, lot: random.Random) -> Mutants:
    """The pair has one link only, or one link twice."""
    for file, tag in ws.tags(_FILE, "disable_collisions"):
        yield attribute(file, tag, lot.choice(["link1", "link2"]), "")
        yield attribute(file, tag, "link2", lot.choice(["link", "link_2"]))
        yield wrong_name(file, tag, "link2", literal(tag, "link1"))


@_SRDF
def adjacent_pair_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """Neighbours that bend collide in nearly every state: no plan is found."""
    bending = {"upper_arm_link", "forearm_link", "boom", "stick"}
    for file, tag in ws.tags(_FILE, "disable_collisions"):
        if bending & {literal(tag, "link1"), literal(tag, "link2")}:
            yield element(file, tag, names=(literal(tag, "link1"), literal(tag, "link2")), anywhere=True)


@_SRDF
def robot_name(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt reports that the SRDF belongs to another robot."""
    for file, tag in ws.tags(_FILE, "robot"):
        for wrong in (typo(literal(tag, "name"), lot), f"{literal(tag, 'name')}_robot"):
            yield wrong_name(file, tag, "name", wrong)


@_SRDF
def unknown_element(ws: Workspace, lot: random.Random) -> Mutants:
    """The element is not read."""
    for file, tag in ws.tags(_FILE):
        if tag.name != "robot":
            yield renamed_tag(file, tag, typo(tag.name, lot))


@_SRDF
def unknown_attribute(ws: Workspace, lot: random.Random) -> Mutants:
    """The attribute is not read."""
    for file, tag in ws.tags(_FILE):
        for name in tag.attributes:
            if name not in ("reason", "xmlns:xacro"):
                yield attribute(file, tag, name, typo(name, lot))


@_SRDF
def no_xml(ws: Workspace, lot: random.Random) -> Mutants:
    """The file is no XML."""
    for file, tag in ws.tags(_FILE):
        text = ws.files[file]
        if tag.close is not None and tag.name != "robot":
            whole = (tag.start, len(text))
            yield Mutant(file, tag.close, tag.close_end, "", (tag.start, tag.end), whole)
        elif tag.empty:
            yield Mutant(file, tag.end - 2, tag.end, ">", (tag.start, tag.end), (tag.start, len(text)))


@_SRDF
def old_srdf(ws: Workspace, lot: random.Random) -> Mutants:
    """A second SRDF, left from before joints were renamed."""
    for file, text in ws.of(_FILE):
        joints = [name for name in ws.joints if f'"{name}"' in text]
        for name in lot.sample(joints, min(2, len(joints))):
            old = f"{name}_old"
            changed = text.replace(f'"{name}"', f'"{old}"')
            path = file.replace(".srdf", "_old.srdf")
            yield Mutant(path, text=changed, action="add", names=(old,), uses=True)
