"""Topics that only one node of a workspace publishes or reads, although another node has messages of the same type."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.topics.graph import has_namespaces, is_closed, published_by_type, starts_components
from urdfkit.lint.facts.topics.own_ends import End, own_ends
from urdfkit.lint.facts.topics.robot_topics import last
from urdfkit.lint.facts.topics.velocity_commands import drive_command_topics, has_drive, velocity_inputs
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model

_EVERYWHERE = frozenset(
    ("clock", "diagnostics", "joint_states", "parameter_events", "robot_description", "rosout", "tf", "tf_static")
)
_COMMON = r"(?:Bool|Byte|Char|ColorRGBA|Empty|Header|String|(?:UInt|Int|Float)\d+)(?:MultiArray)?"
"""Matches the types of std_msgs, which topics of all kinds have."""

_COMMANDS = ("Twist", "TwistStamped")


def unpaired(model: Model) -> Iterator[tuple[End, str]]:
    """Yield each end whose topic no other node has, with the message: a reader without publisher, or the reverse.

    A topic that any other file names is accepted. An end is reported if one other end of its type is without
    counterpart too, if it reads a sensor and all publishers of the type are in these packages, or if it has the
    commands of the drive, which reads another topic.
    """
    ends = own_ends(model)
    if not ends:
        return
    words = Words(model)
    by_type = published_by_type(model)
    published = {topic for topics in by_type.values() for topic in topics}
    inputs = velocity_inputs(model) | drive_command_topics(model)
    topics = {publishes: {end.topic for end in ends if end.publishes is publishes} for publishes in (True, False)}
    is_open = {
        publishes: {end.type for end in ends if not end.topic and end.publishes is publishes} for publishes in topics
    }

    in_namespaces, has_components = has_namespaces(model), starts_components(model)

    def is_lone(end: End) -> bool:
        """Return whether no other node has the topic of an end on the other side."""
        others = topics[not end.publishes] | (inputs if end.publishes else published)
        if not end.topic or not end.type or not end.is_launched or end.topic in others | _EVERYWHERE:
            return False
        return not in_namespaces or not any(last(other) == last(end.topic) for other in others)

    sides = Counter((kind, side) for kind, side, _ in {(end.type, end.publishes, end.topic) for end in ends})
    frequent = {kind for (kind, _), count in sides.items() if count > 1}

    def fits(end: End, other: End) -> bool:
        """Return whether two ends belong together; those of common types must have similar names."""
        if not _fit(end, other):
            return False
        is_common = end.type in frequent or re.fullmatch(_COMMON, end.type) is not None
        return not is_common or nearest(end.topic, [other.topic], cutoff=0.6) is not None

    lone = [end for end in ends if is_lone(end) and end.type not in is_open[not end.publishes]]
    unnamed = [end for end in lone if words.places_of(end.topic) <= sum(other.topic == end.topic for other in ends)]
    seen = set[str]()
    for end in unnamed:
        found = {each.topic for each in lone if _fit(end, each)}
        partners = [each for each in lone if fits(end, each)]
        if end.topic in seen:
            continue
        is_only = len({each.topic for each in partners}) == 1
        if is_only and len({each.topic for each in unnamed if fits(partners[0], each)}) == 1:
            is_other = any(each is partners[0] for each in unnamed)
            wrong, right = _wrong(end, partners[0], words) if is_other else (end, partners[0])
            seen |= {end.topic, partners[0].topic}
            yield wrong, _message(wrong) + Suggestion(right.topic, wrong.topic)
            continue
        others = inputs if end.publishes else by_type.get(end.type, set())
        is_command = end.publishes and end.type in _COMMANDS and re.search("cmd|vel|twist", end.topic) is not None
        is_missing = not end.publishes and not has_components and is_closed(model, end.type)
        if not found and others and (is_missing or is_command) and not (end.topic == "cmd_vel" and has_drive(model)):
            seen.add(end.topic)
            yield end, _message(end) + _hint(end, sorted(others))


def _hint(end: End, others: list[str]) -> str:
    near = others[0] if len(others) == 1 else nearest(end.topic, others, cutoff=0.6)
    if near is not None:
        return Suggestion(near, end.topic)
    verb = "publish" if not end.publishes else "subscribe to"
    return f"; the nodes of these packages {verb} {', '.join(f'`{each}`' for each in others[:3])}"


def mistyped_in_code(model: Model) -> Iterator[tuple[End, str]]:
    """Yield each reader in code whose topic has messages of another type, with the message."""
    ends = own_ends(model) or []
    by_type = published_by_type(model)
    published: dict[str, set[str]] = {}
    for kind, topics in by_type.items():
        for topic in topics:
            published.setdefault(topic, set()).add(kind)
    for end in ends:
        if end.publishes and end.topic:
            published.setdefault(end.topic, set()).add(end.type)
    for end in ends:
        types = published.get(end.topic, set()) if not end.publishes and end.type and end.is_launched else set()
        if types and "" not in types and end.type not in types and re.fullmatch(r"[A-Z]\w+", end.type):
            what = " and ".join(sorted(types))
            yield end, f"`{end.topic}` has {what} messages, but its subscriber expects {end.type} messages"


def _fit(end: End, other: End) -> bool:
    """Return whether two ends without counterpart are of one type, on opposite sides and in different files."""
    return end.publishes is not other.publishes and end.type == other.type and end.path != other.path


def _wrong(end: End, other: End, words: Words) -> tuple[End, End]:
    """Return the wrong one of two ends first: the one in a launch or parameter file, or with the rarer word."""
    ranks = [
        (each.source.file.endswith((".py", "pp", ".h", ".cc")), words.count_of(each.topic), each.publishes)
        for each in (end, other)
    ]
    return (end, other) if ranks[0] <= ranks[1] else (other, end)


def _message(end: End) -> str:
    verb = "subscribes to" if end.publishes else "publishes"
    return f"no node {verb} the {end.type} messages on `{end.topic}`"
