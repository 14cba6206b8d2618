"""The other side of velocity commands without a reader, where its file shows that it is the wrong one."""

from __future__ import annotations

import re

from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.ros2_controllers import declared
from urdfkit.lint.facts.control.yaml_tree import nodes, span_of, yamls
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.topics.graph import remapped
from urdfkit.lint.model.model import Model

_UNSTAMPED = r"/?([\w/]+)/(?:cmd_vel|reference)_unstamped"
_INPUTS = {"velocity_smoother": "cmd_vel", "collision_monitor": "cmd_vel_in"}
"""Program that changes velocity commands → its topic for them."""


def other_side(source: Source, name: Named, model: Model) -> Span | None:
    """Return the place of the wrong subscriber of a topic of velocity commands that no node reads.

    It is the flag ``use_stamped_vel: true`` of the controller that has the topic without it, or the topic of twist_mux
    that is the input of the unread node: the mux is to read its output.

    Args:
        source: the launch file of the publisher.
        name: the topic or the node in it.
        model: the linted model.
    """
    controller = re.fullmatch(_UNSTAMPED, name.name)
    for file in yamls(model) if controller is not None else ():
        for one in declared(file):
            is_own = controller is not None and one.name == controller[1]
            flag = one.settings.find("use_stamped_vel") if is_own and one.settings is not None else None
            if flag is not None and flag.text.lower() == "true":
                return span_of(file, flag)
    inputs = set[str]()
    for node in launched_nodes(model):
        start, end = node.place or (0, 0)
        is_publisher = node.source is source and (
            start <= name.start <= end or any(new.start == name.start for _, new in node.remappings)
        )
        if is_publisher and node.program in _INPUTS:
            inputs.add(remapped(node, _INPUTS[node.program]))
    for file in yamls(model) if inputs else ():
        for group in nodes(file):
            topic = group.find("topic") if group.find("priority") is not None else None
            if topic is not None and topic.text.strip("/") in inputs:
                return span_of(file, topic)
    return None
