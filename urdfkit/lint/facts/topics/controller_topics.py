"""Topics and actions of controllers in the code of a workspace, and private names of topics that other nodes have.

Sources: ros2_controllers (joint_trajectory_controller.cpp, forward_controllers_base.cpp,
gripper_action_controller_impl.hpp) and ros_controllers (joint_trajectory_controller_impl.h,
forward_command_controller.h, gripper_action_controller_impl.h); roscpp, NodeHandle.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import yamls
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.topics.graph import published_by_type
from urdfkit.lint.facts.topics.own_ends import End, own_ends
from urdfkit.lint.facts.topics.robot_topics import last
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts

_INPUTS = (
    (r"\w+/JointTrajectoryController", ("joint_trajectory", "command"), "follow_joint_trajectory"),
    (
        r"\w+/(?:Joint)?GroupPositionController|\w+/JointGroup\w+|\w+/ForwardCommandController",
        ("commands", "command"),
        "",
    ),
    (r"\w+/Joint(?:Position|Velocity|Effort)Controller", ("", "command"), ""),
    (r"\w+/GripperActionController", ("", ""), "gripper_cmd"),
)
"""Pattern of the type of a controller → its topic of commands in ROS 2 and ROS 1, and its action."""

_EVERY = frozenset(name for _, topics, action in _INPUTS for name in (*topics, action) if name)
_LITERAL = r"[\"']/?((?:[\w/]|\{[^{}\"'\n]{1,60}\}|%s)+)/(\w+)[\"']"


def wrong_inputs(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the topics and actions below the name of a controller that it does not have, in code and remappings."""
    inputs: dict[str, set[str]] = {}
    for source in yamls(model):
        version = 0 if PARAMETERS in source.text else 1
        for one in settings(source):
            entry = next((each for each in _INPUTS if re.fullmatch(each[0], one.kind)), None)
            own = {entry[1][version], entry[2]} - {""} if entry is not None else {*_EVERY}
            inputs.setdefault(one.name, set()).update(own)
    for node in launched_nodes(model) if inputs else ():
        for _, new in node.remappings:
            space, _, name = new.name.strip("/").rpartition("/")
            accepted = inputs.get(space.rpartition("/")[2], set())
            if name in _EVERY and accepted and name not in accepted:
                start = new.start + new.name.rstrip("/").rfind("/") + 1
                yield node.source, Named(name, start), _message(space.rpartition("/")[2], name, accepted)
    packages = neighbours(model.package) if model.package is not None and inputs else {}
    for folder in packages.values():
        model.expanded.packages.watch(folder)
        for path, text in node_texts(folder):
            for at in re.finditer(_LITERAL, text) if any(name in text for name in _EVERY) else ():
                pattern = re.sub(r"\\\{.*?\\\}|%s", r"\\w*", re.escape(at[1].rpartition("/")[2]))
                found = [name for name in inputs if re.fullmatch(pattern, name)]
                accepted = {name for each in found for name in inputs[each]}
                line = text[text.rfind("\n", 0, at.start()) + 1 : at.start()]
                if at[2] not in _EVERY or not accepted or at[2] in accepted or re.match(r"\s*(?:#|//|\*)", line):
                    continue
                place = Named(at[2], at.start(2))
                yield Source(shown_path(path), text), place, _message(found[0], at[2], accepted)


def _message(controller: str, name: str, accepted: set[str]) -> str:
    names = sorted(accepted)
    right = Suggestion(names[0], name) if len(names) == 1 else f"; use `{'` or `'.join(names)}`"
    return f"controller `{controller}` has no topic or action `{name}`" + right


_GLOBAL = ("clock", "joint_states", "tf", "tf_static")


def private_readers(model: Model) -> Iterator[tuple[End, str]]:
    """Yield each reader with the private name of a topic that other nodes publish under its global name."""
    ends = own_ends(model) or []
    published = {topic for topics in published_by_type(model).values() for topic in topics}
    published |= {end.topic for end in ends if end.publishes}
    shared = {*_GLOBAL, *(topic for topic in published if "/" not in topic)}
    places: dict[tuple[str, int], list[End]] = {}
    for end in ends:
        if end.is_private and not end.publishes and end.is_launched:
            places.setdefault((end.source.file, end.start), []).append(end)
    for found in places.values():
        name = last(found[0].topic)
        if name in shared and published.isdisjoint(end.topic for end in found):
            message = f"no node publishes `{name}` in the private namespace of this node"
            yield found[0], message + "; read it without `~`"
