"""Frames of navigation: names that only one node uses, and links that would have two parents."""

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, walk, yamls
from urdfkit.lint.facts.gazebo.plugins import OUTSIDE_FRAMES, references
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.navigation.tables import DIFFERENT_FRAMES
from urdfkit.lint.facts.topics.graph import published_by_type
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.model.model import Model

_ROLES = {
    **dict.fromkeys(("odom_frame", "odom_frame_id", "local_frame"), ("odom",)),
    **dict.fromkeys(("map_frame", "map_frame_id", "global_frame_id"), ("map",)),
    "global_frame": ("odom", "map"),
}
"""Parameter → the frames that it can name, by their usual names."""

_MOVING = "diff_drive_controller/"
"""Part of the types of controllers that publish the transform of ``base_frame_id``."""


def equal_frames(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield the second of two frames of a node in a YAML file that must differ and are equal, with the message."""
    for node in nodes(source) if "frame" in source.text else ():
        for names in DIFFERENT_FRAMES if node.entries else ():
            first, second = (node.find(name) for name in names)
            if first is not None and second is not None and first.text and first.text == second.text:
                wrong = first if second.text == "odom" and names[0] in ("map_frame", "global_frame_id") else second
                yield wrong, f"`{names[0]}` and `{names[1]}` are both `{first.text}`"


def frames_with_slash(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield the frames of Nav2 nodes that start with a slash, which tf2 refuses (tf2 of ROS 2, buffer_core.cpp)."""
    for _, group in sections(source) if "frame: " in source.text else ():
        for node in walk(group):
            for name in ("global_frame", "robot_base_frame"):
                value = node.find(name)
                if value is not None and value.text.startswith("/"):
                    yield value, f"`{name}` is `{value.text}`; tf2 rejects frames with a leading slash"


def lone_frames(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the frames that occur in one place, while other nodes use another frame there: file, place, message."""
    from urdfkit.lint.facts.ros_packages import is_slip

    found: list[tuple[Source, Node, Node]] = []
    for source in yamls(model):
        for node in nodes(source) if "frame" in source.text else ():
            world = node.find("world_frame")  # parameter-value-invalid compares it with the other frames
            if world is not None and world.text not in [value.text for _, value in node.entries if value is not world]:
                continue
            found += [(source, key, value) for key, value in node.entries if key.text in _ROLES and value.text]
    if not found:
        return
    words = Words(model)
    plugged = {
        text.strip("/") for text, _, parameter, _ in references(model, ("frame",)) if "odom" in parameter.meaning
    }
    topics = set().union(*published_by_type(model).values())
    for source, key, value in found:
        frame, roles = value.text.strip("/"), _ROLES[key.text]
        used = {other.text.strip("/") for _, name, other in found if _ROLES[name.text] == roles}
        used |= {other.text.strip("/") for _, name, other in found if set(_ROLES[name.text]) & set(roles)} & {*roles}
        others = sorted((used | (plugged if "odom" in roles else set())) - {frame})
        is_reported = any(is_slip(frame, name) for name in ("odom", "map"))
        if "/" in frame and frame in topics:
            yield source, value, f"`{key.text}` is `{frame}`, which is a topic, not a frame"
        if not others or "$" in frame or is_reported or frame in ("map", "odom") or frame in model.robot.link_by_name:
            continue
        if frame.isidentifier() and (words.occurs_once(frame) or _is_only_frame(model, words, frame)):
            shown = " or ".join(f"`{name}`" for name in others[:3])
            yield source, value, f"no other file names the frame `{frame}` of `{key.text}`; other nodes use {shown}"


def _is_only_frame(model: Model, words: Words, frame: str) -> bool:
    """Return whether a name is a whole value in one place, and elsewhere only a part of topics and paths."""
    pattern = rf"(?<![\w/.~-]){re.escape(frame)}(?![\w/.-])"
    texts = (source.text for source in {**model.expanded.sources, **model.related_files}.values())
    return sum(len(re.findall(pattern, text)) for text in texts) == 1 and not words.match(pattern)


def second_parents(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the base frames of controllers that publish the transform of a link that has a parent.

    Source: diff_drive_controller (userdoc.rst). The filters of robot_localization are compared elsewhere.
    """
    roots = model.robot.roots()
    root = roots[0].name if len(roots) == 1 and not model.is_incomplete else None
    for source in yamls(model) if root is not None and root not in OUTSIDE_FRAMES else ():
        for one in settings(source):
            frame, publishes = one.group.find("base_frame_id"), one.group.find("enable_odom_tf")
            link = frame.text.strip("/") if frame is not None and _MOVING in one.kind else ""
            is_off = publishes is not None and publishes.text.lower() == "false"
            if frame is not None and link != root and link in model.robot.link_by_name and not is_off:
                message = f"`base_frame_id` is `{link}`, but the root link is `{root}`: `{link}` has two parents in TF"
                yield source, frame, message
