"""Entries of YAML files that differ from others of the same file: misspelt keys and names, values in quotes, lengths.

These checks need no table of a node. They compare sections of the same shape, and a list with the sections that it
names.
"""

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of
from urdfkit.lint.facts.parameters.declared_types import type_of_text
from urdfkit.lint.facts.parameters.misspelt_names import is_misspelt

Defects = Iterator[tuple[Node, str]]
_Flat = dict[tuple[str, ...], tuple[Node, Node]]
"""Path of names below a section → key and value."""

_FEWEST = 3
"""Smallest number of sections that are compared with each other."""

_MAX_DEPTH = 3
_SHORTEST = 4
"""Smallest number of letters of a name that is compared."""

_PARTS = r"(?=.*[_/:][\w.-])[A-Za-z][\w.-]*(?:[/:][\w.-]+)*"
"""Matches names with several words; single words such as `heating` and `heading` are often different values."""

_MOST_UNLIKE = 4
"""Largest number of keys in which two sections of the same shape differ."""

_SIDES = r"(?<![a-z])(?:min|max|upper|lower)(?![a-z])"
"""Matches words of keys whose lists have the same length as the list of the opposite key."""

_TEXTS = r"(?:.*_)?(?:value|default|text|label|name|id|version|serial|serial_no|code|password|address)"
"""Matches keys whose values are texts, also if they look like numbers."""


def odd_entries(source: Source) -> Defects:
    """Yield the entries that differ from others of their file, with a message."""
    for node in nodes(source):
        if node.kind == "list":
            yield from _odd_sections(source, [(item, item) for item in node.items if item.kind == "group"])
        elif node.entries:
            yield from _odd_sections(source, [(key, value) for key, value in node.entries if value.kind == "group"])
            yield from _unlisted_sections(source, node)
            yield from _odd_lengths(node)


def _odd_sections(source: Source, sections: list[tuple[Node, Node]]) -> Defects:
    """Yield the keys and values of sections of the same shape that only one of them has in this form."""
    if len(sections) < 2:
        return
    flat = [_flat(section) for _, section in sections]
    if len(sections) == 2:
        yield from _odd_key_of_two(source, *flat)
        return
    count = Counter(path for each in flat for path in each)
    common = [path for path, times in count.items() if times >= max(_FEWEST - 1, len(sections) / 2)]
    for each in flat:
        lacking = [path for path in common if path not in each]
        for path, (key, _) in each.items() if lacking else ():
            if count[path] == 1 and len(key.text) >= _SHORTEST:
                others = (name for *parent, name in lacking if tuple(parent) == path[:-1])
                near = next((name for name in others if is_misspelt(key.text, name)), None)
                if near is not None:
                    yield key, f"unknown key `{key.text}`, unlike the other sections" + Suggestion(near, key.text)
    for path in common:
        values = [value for each in flat if path in each for _, value in [each[path]] if value.kind == "text"]
        yield from _odd_names(path[-1], [value for value in values if value.is_plain])
        yield from _quoted(path[-1], values)


def _odd_key_of_two(source: Source, one: _Flat, other: _Flat) -> Defects:
    """Yield the key of two sections that differs by a slip from a key of the other one and occurs less often."""
    left, right = one.keys() - other.keys(), other.keys() - one.keys()
    if max(len(left), len(right)) > _MOST_UNLIKE:
        return
    for path in left:
        for near in right:
            if near[:-1] == path[:-1] and len(path[-1]) > _SHORTEST and is_misspelt(path[-1], near[-1]):
                times, others = _times(path[-1], source), _times(near[-1], source)
                (key, _), name = (one[path], near[-1]) if times < others else (other[near], path[-1])
                if times != others:
                    yield key, f"unknown key `{key.text}`, unlike the other section" + Suggestion(name, key.text)


def _flat(section: Node) -> _Flat:
    """Return the entries below a section: path of names → key and value."""
    found: _Flat = {}
    waiting: list[tuple[tuple[str, ...], Node]] = [((), section)]
    while waiting:
        path, node = waiting.pop()
        for key, value in node.entries:
            inner = (*path, key.text)
            found.setdefault(inner, (key, value))
            if value.kind == "group" and len(inner) < _MAX_DEPTH:
                waiting.append((inner, value))
    return found


def _odd_names(name: str, values: list[Node]) -> Defects:
    """Yield the name that differs by a slip from the name in at least half of the sections."""
    count = Counter(value.text for value in values)
    if len(values) < _FEWEST or len(count) < 2:
        return
    usual = [text for text, times in count.items() if times >= max(_FEWEST - 1, len(values) / 2)]
    for value in values:
        if count[value.text] == 1 and re.fullmatch(_PARTS, value.text):
            near = next((text for text in usual if is_misspelt(value.text, text)), None)
            if near is not None:
                message = f"unknown `{name}` `{value.text}`, unlike the other sections" + Suggestion(near, value.text)
                yield value, message


def _quoted(name: str, values: list[Node]) -> Defects:
    """Yield the only number or Boolean in quotes, if the values of at least two other sections have none."""
    quoted = [value for value in values if not value.is_plain]
    if len(quoted) != 1 or len(values) < _FEWEST or re.fullmatch(_TEXTS, name):
        return
    (value,) = quoted
    types = {type_of_text(each.text) for each in values}
    is_text = "\n" in value.text or re.match(r"[-+]?0\d", value.text)
    if not is_text and (types <= {"int", "double"} or types == {"bool"}):
        yield value, f'`{name}` is "{value.text}", a quoted string; write {value.text}'


def _odd_lengths(node: Node) -> Defects:
    """Yield the list of numbers whose length differs by one from all others, as from the list of the opposite key."""
    lists = [(key, value) for key, value in node.entries if _is_numbers(value)]
    lengths = Counter(len(value.items) for _, value in lists)
    if len(lists) <= _FEWEST or len(lengths) != 2:
        return
    (usual, _), (odd, single) = lengths.most_common()
    if single == 1 and abs(usual - odd) == 1 and usual > _FEWEST:
        key, value = next((key, value) for key, value in lists if len(value.items) == odd)
        stem = re.sub(_SIDES, "", key.text)
        if stem != key.text and any(each is not key and re.sub(_SIDES, "", each.text) == stem for each, _ in lists):
            yield value, f"`{key.text}` has {odd} values; the other lists in this section have {usual}"


def _is_numbers(value: Node) -> bool:
    return value.kind == "list" and bool(value.items) and all(number_of(item) is not None for item in value.items)


def _unlisted_sections(source: Source, node: Node) -> Defects:
    """Yield the entry of a list that is the misspelt name of a section next to the list, or the name of the section."""
    sections = {key.text: key for key, value in node.entries if value.kind in ("group", "list")}
    for key, value in node.entries if len(sections) > 1 else ():
        names = value.texts() if value.kind == "list" else []
        lacking = [item for item in value.items if item.text and item.text not in sections]
        if len(names) < 2 or len(lacking) != 1 or len(names) != len(value.items):
            continue
        (item,) = lacking
        free = [name for name in sections if name not in names and name != key.text]
        near = next((name for name in free if len(name) >= _SHORTEST and is_misspelt(item.text, name)), None)
        if near is None:
            continue
        if _times(item.text, source) > _times(near, source):
            yield sections[near], f"`{key.text}` does not list `{near}`" + Suggestion(item.text, near)
        else:
            yield item, f"`{item.text}` in `{key.text}` has no section" + Suggestion(near, item.text)


def _times(name: str, source: Source) -> int:
    """Return how often the words of a name occur in a file."""
    words = re.findall(r"[A-Za-z]+", name)
    return min((len(re.findall(rf"(?<![A-Za-z]){word}(?![a-z])", source.text)) for word in words), default=0)
