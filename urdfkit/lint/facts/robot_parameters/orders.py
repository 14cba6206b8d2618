"""Lists of joints for commands by index whose orders differ: of a controller and of the node that sends to it.

The controllers of these types take one number for each joint, without names. Sources: forward_command_controller and
joint_group_position_controller (README), Noetic to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import groupby

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.yaml_tree import Node, yamls
from urdfkit.lint.facts.robot_parameters.groups import groups_of_nodes
from urdfkit.lint.model.model import Model

_BY_INDEX = r".*/(?:JointGroup\w*Controller|(?:MultiInterface)?ForwardCommandController)"

_FEWEST_GROUPS = 3
"""Smallest number of limbs in a list of joints that are compared with each other."""


def wrong_orders(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the first joint of each list that is in another order, with a message."""
    controllers = [
        (source, one, joints.items)
        for source in yamls(model)
        for one in settings(source)
        if (joints := one.group.find("joints")) is not None
    ]
    lists = [(source, one.name, items) for source, one, items in controllers if re.fullmatch(_BY_INDEX, one.kind)]
    orders = [(one.name, [item.text for item in items]) for _, one, items in controllers]
    sent = [
        (key, [item.text for item in value.items])
        for _, group in (groups_of_nodes(model) if lists else ())
        for key, value in group.entries
        if len(value.items) > 1 and group.find("type") is None  # MoveIt's controllers get joints by name
    ]
    for source, name, items in lists:
        names = [item.text for item in items]
        others = [(key, texts) for key, texts in sent if texts != names and sorted(texts) == sorted(names)]
        of_others = [order for other, order in orders if other != name]
        is_expected = any(texts == names for _, texts in sent) or any(texts in of_others for _, texts in others)
        if others and not is_expected:
            key, texts = others[0]
            at = _first_difference(names, texts)
            message = f"joint {at + 1} of controller `{name}`, which takes commands by index, is `{names[at]}`"
            yield source, items[at], f"{message}, but joint {at + 1} of `{key.text}` is `{texts[at]}`"
        elif not others and (odd := _odd_limb(names)) is not None:
            message = f"`{names[odd]}` is in a different order from the joints of the other limbs"
            yield source, items[odd], f"{message} in this list, whose commands have no names"


def _first_difference(one: list[str], other: list[str]) -> int:
    return next(at for at, (a, b) in enumerate(zip(one, other, strict=True)) if a != b)


def _odd_limb(names: list[str]) -> int | None:
    """Return the index of the first joint that is out of order in the only limb with another order; None without one.

    The first word of a name is that of the limb, the rest is the joint's.
    """
    limbs = [list(group) for _, group in groupby(names, lambda name: name.partition("_")[0])]
    orders = [[name.partition("_")[2] for name in limb] for limb in limbs]
    usual = max(orders, key=orders.count, default=[])
    odd = [at for at, order in enumerate(orders) if order != usual]
    if len(limbs) < _FEWEST_GROUPS or len(usual) < 2 or len(odd) != 1 or sorted(orders[odd[0]]) != sorted(usual):
        return None
    before = sum(len(limb) for limb in limbs[: odd[0]])
    return before + _first_difference(orders[odd[0]], usual)
