"""Entries of YAML files that differ from others of the same file: misspelt keys and names, lengths, missing keys.

These checks need no table of a node. They compare sections of the same shape, and a list with the sections that it
names.
"""

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of
from urdfkit.lint.facts.ros_packages import is_slip

Defects = Iterator[tuple[Node, str]]
_Flat = dict[tuple[str, ...], tuple[Node, Node]]
"""Path of names below a section → key and value."""

_FEWEST = 3
"""Smallest number of sections that are compared with each other."""

_MAX_DEPTH = 3
_SHORTEST = 4
"""Smallest number of letters of a name that is compared."""

_NAME = r"[A-Za-z][\w/:.-]*"


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
    """Yield the keys, names and lists of sections of the same shape that only one of them has in this form."""
    if len(sections) < 2:
        return
    flat = [_flat(section) for _, section in sections]
    count = Counter(path for each in flat for path in each)
    if len(sections) == 2:
        yield from _odd_key_of_two(source, *flat)
        return
    common = [path for path, times in count.items() if times >= _FEWEST - 1]
    misspelt = False
    for each in flat:
        for path, (key, _) in each.items():
            if count[path] != 1 or len(key.text) < _SHORTEST:
                continue
            others = [one for one in common if one not in each and one[:-1] == path[:-1]]
            near = next((name for *_, name in others if is_slip(key.text, name)), None)
            if near is not None:
                misspelt = True
                yield key, f"unknown key `{key.text}`, unlike the other sections" + Suggestion(near, key.text)
    if not misspelt:
        yield from _lacking_key(sections)
    for path in common:
        values = [value for each in flat if path in each for _, value in [each[path]]]
        yield from _odd_names(path[-1], [value for value in values if value.kind == "text" and value.is_plain])
        yield from _odd_list(path[-1], values)


def _odd_key_of_two(source: Source, one: _Flat, other: _Flat) -> Defects:
    """Yield the key of two sections that differs by a slip from a key of the other one and occurs less often."""
    for path in one.keys() - other.keys():
        for near in other.keys() - one.keys():
            if near[:-1] == path[:-1] and len(path[-1]) > _SHORTEST and is_slip(path[-1], near[-1]):
                is_first = _times(path[-1], source) < _times(near[-1], source)
                (key, _), right = (one[path], near[-1]) if is_first else (other[near], path[-1])
                yield key, f"unknown key `{key.text}`, unlike the other section" + Suggestion(right, key.text)


def _lacking_key(sections: list[tuple[Node, Node]]) -> Defects:
    """Yield the section that lacks one key, if all other sections have exactly the same keys."""
    names = Counter(frozenset(key.text for key, _ in section.entries) for _, section in sections)
    if len(names) != 2 or len(sections) <= _FEWEST:
        return
    (usual, times), (odd, single) = names.most_common()
    if single == 1 and times >= _FEWEST and len(usual - odd) == 1 and odd < usual and len(usual) > 1:
        place = next(key for key, section in sections if odd == {key.text for key, _ in section.entries})
        (lacking,) = usual - odd
        name = f"section `{place.text}`" if place.text else "this section"
        yield place, f"{name} has no `{lacking}`, unlike the other sections"


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
    """Yield the name that differs by a slip from the name in at least two of the other sections."""
    count = Counter(value.text for value in values)
    if len(values) < _FEWEST or len(count) < 2:
        return
    usual = [text for text, times in count.items() if times >= _FEWEST - 1]
    for value in values:
        if count[value.text] == 1 and len(value.text) > _SHORTEST and re.fullmatch(_NAME, value.text):
            near = next((text for text in usual if is_slip(value.text, text)), None)
            if near is not None:
                message = f"unknown `{name}` `{value.text}`, unlike the other sections" + Suggestion(near, value.text)
                yield value, message


def _odd_list(name: str, values: list[Node]) -> Defects:
    """Yield the list of numbers that is one value longer or shorter than the list of all other sections."""
    lists = [value for value in values if _is_numbers(value)]
    lengths = Counter(len(value.items) for value in lists)
    if len(lists) < _FEWEST or len(lists) < len(values) or len(lengths) != 2:
        return
    (usual, times), (odd, single) = lengths.most_common()
    if single == 1 and times >= _FEWEST - 1 and abs(usual - odd) == 1 and usual >= _FEWEST:
        value = next(value for value in lists if len(value.items) == odd)
        yield value, f"`{name}` has {odd} values; the other sections have {usual}"


def _odd_lengths(node: Node) -> Defects:
    """Yield the list of numbers that is one value longer or shorter than at least three others next to it."""
    lists = [(key, value) for key, value in node.entries if _is_numbers(value)]
    lengths = Counter(len(value.items) for _, value in lists)
    if len(lists) <= _FEWEST or len(lengths) != 2:
        return
    (usual, _), (odd, single) = lengths.most_common()
    if single == 1 and abs(usual - odd) == 1 and usual > _FEWEST:
        key, value = next((key, value) for key, value in lists if len(value.items) == odd)
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
        near = next((name for name in free if len(name) >= _SHORTEST and is_slip(item.text, name)), None)
        if near is None:
            continue
        if _times(item.text, source) > _times(near, source):
            yield sections[near], f"`{key.text}` does not list `{near}`" + Suggestion(item.text, near)
        else:
            yield item, f"`{item.text}` in `{key.text}` has no section" + Suggestion(near, item.text)


def _times(name: str, source: Source) -> int:
    """Return how often the words of a name occur in a file."""
    return min(
        len(re.findall(rf"(?<![A-Za-z]){re.escape(word)}", source.text)) for word in re.findall(r"[A-Za-z]+", name)
    )
