"""Heights at which launch files spawn a robot in Gazebo, and the parameters with its description."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.numbers import number
from urdfkit.lint.facts.control.launched_nodes import Started
from urdfkit.lint.facts.launch.spawned_controllers import ros1_files, tags
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.model.model import Model

SPAWNERS = {
    ("gazebo_ros", "spawn_model"): "-param",
    ("gazebo_ros", "spawn_entity.py"): "-topic",
    ("ros_gz_sim", "create"): "-topic",
    ("ros_ign_gazebo", "create"): "-topic",
}
"""Package and program that spawns a robot → option with the parameter or topic of its description."""

_SOURCES = {program: option for (_, program), option in SPAWNERS.items()}
_MAX_DEPTH = 0.05
"""Accepted depth of the lowest point below the plane of the ground [m]."""


def spawned_in_the_ground(node: Started, model: Model) -> Iterator[tuple[int, str, str]]:
    """Yield offset, text and message of a height that puts a part of the robot below the ground at zero."""
    if node.program not in _SOURCES or model.is_incomplete or len(model.robot.roots()) != 1:
        return
    if model.robot.roots()[0].name == "world" or not any(joint.type == "continuous" for joint in model.robot.joints):
        return
    for option, word in zip(node.arguments, node.arguments[1:], strict=False):
        height = number(word.name) if option is not None and word is not None and option.name == "-z" else None
        lowest = _lowest(model) if height is not None else None
        if word is not None and height is not None and lowest is not None and height + lowest < -_MAX_DEPTH:
            depth = -(height + lowest)
            yield word.start, word.name, f"at this height the robot extends {depth:.3g} m into the ground"


def undefined_parameters(node: Started, model: Model) -> Iterator[tuple[int, str, str]]:
    """Yield offset, text and message of a description that no launch file of ROS 1 sets as a parameter."""
    if node.program == "create":
        yield from _own_parameters(node, model)
    if (node.package, node.program) != ("gazebo_ros", "spawn_model"):
        return
    names = {tag.attributes["name"].value for _, tag in tags(ros1_files(model), "param") if "name" in tag.attributes}
    for option, word in zip(node.arguments, node.arguments[1:], strict=False):
        is_name = option is not None and word is not None and option.name == "-param" and "$" not in word.name
        if word is not None and is_name and names and not any("$" in name for name in names):
            own = {name.rpartition("/")[2] for name in names if "description" in name}
            if own and word.name.rpartition("/")[2] not in {name.rpartition("/")[2] for name in names}:
                near = next(iter(own)) if len(own) == 1 else None
                message = f"no launch file of these packages sets the parameter `{word.name}`"
                yield word.start, word.name, message + Suggestion(near, word.name)


def wrong_formats(node: Started, model: Model) -> Iterator[tuple[int, str, str]]:
    """Yield offset, text and message of ``-sdf`` for a parameter of ROS 1 that has the text of a URDF."""
    words = {word.name: word for word in node.arguments if word is not None}
    values = dict(zip(node.arguments, node.arguments[1:], strict=False))
    named = values.get(words.get("-param"))
    if node.program != "spawn_model" or "-sdf" not in words or named is None or "$" in named.name:
        return
    texts = [
        tag.attributes[key].value
        for _, tag in tags(ros1_files(model), "param")
        for key in ("command", "textfile")
        if key in tag.attributes and "name" in tag.attributes and tag.attributes["name"].value == named.name
    ]
    if texts and all(re.search(r"\.urdf(?:\.xacro)?\b|\bxacro\b", text) for text in texts):
        word = words["-sdf"]
        yield word.start, word.name, f"`{named.name}` is a URDF" + Suggestion("-urdf", word.name)


def _own_parameters(node: Started, model: Model) -> Iterator[tuple[int, str, str]]:
    """Yield a parameter with the description that ``create`` reads from itself and no launch file gives it.

    Source: ros_gz_sim (create.cpp), which declares the parameter of its own node.
    """
    spawners = [each for each in launched_nodes(model) if each.program == "create"]
    is_open = any(each.inline is None or each.files for each in spawners)
    parameters = {name for each in spawners for name in each.inline or ()}
    for option, word in zip(node.arguments, node.arguments[1:], strict=False):
        is_name = option is not None and word is not None and option.name == "-param" and "$" not in word.name
        if word is not None and is_name and not is_open and word.name not in parameters:
            message = f"`create` reads `{word.name}` from its own parameters, which do not contain it"
            yield word.start, word.name, f"{message}; write `-topic robot_description`"


def names_as_files(node: Started) -> Iterator[tuple[int, str, str]]:
    """Yield offset, text and message of a file that is no path but the name of a topic or parameter."""
    source = _SOURCES.get(node.program)
    for option, word in zip(node.arguments, node.arguments[1:], strict=False):
        if source is None or option is None or word is None or option.name != "-file":
            continue
        if word.name.endswith("description"):
            yield word.start, word.name, f"`-file` requires the path of a file; write `{source} {word.name}`"


def _lowest(model: Model) -> float | None:
    """Return the height of the lowest point of the links in the root link [m]; None if a size is unknown."""
    frames = model.frames
    heights = [z for name, each in model.extents.items() if name in frames for _, _, z in each.corners_in(frames[name])]
    return min(heights, default=None)
