"""Mutations of XML files: elements, attributes and values, valid ones as well as hostile ones."""

from __future__ import annotations

import random
import re
from typing import NamedTuple

from tests.bench.fuzz.hostile_values import HOSTILE

_MARKUP = re.compile(r"<!--.*?-->|<\?.*?\?>|<!\[CDATA\[.*?\]\]>|<(/?)([\w:.-]+)([^<>]*?)(/?)>", re.DOTALL)
_ATTRIBUTE = re.compile(r"""\s([\w:.-]+)\s*=\s*("[^"<]*"|'[^'<]*')""")
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_FACTORS = (0.0, -1.0, 1e-3, 1e3, 0.5, 2.0, 1e-9, 1e6, 1e-30, 1e30)


class Element(NamedTuple):
    """An element of a text: the range of its characters, the end of its start tag, its name and depth."""

    start: int
    end: int
    inner: int
    name: str
    depth: int


class Value(NamedTuple):
    """The value of an attribute, or the text of an element without children: its range and the name of its owner."""

    start: int
    end: int
    owner: str


def elements(text: str) -> list[Element]:
    """Return the closed elements below the root, in the order of their ends."""
    found, opened = [], []
    for tag in _MARKUP.finditer(text):
        if tag[2] is None:
            continue
        if tag[4]:
            found.append(Element(tag.start(), tag.end(), tag.end(), tag[2], len(opened)))
        elif not tag[1]:
            opened.append(tag)
        elif opened and opened[-1][2] == tag[2]:
            start = opened.pop()
            found.append(Element(start.start(), tag.end(), start.end(), tag[2], len(opened)))
    return [each for each in found if each.depth] or found


def values(text: str) -> list[Value]:
    """Return the values of the attributes of elements, and the texts of elements that contain only text."""
    found = []
    tags = [tag for tag in _MARKUP.finditer(text) if tag[2] is not None]
    for tag, following in zip(tags, [*tags[1:], None], strict=False):
        begin = tag.start(3)
        for each in _ATTRIBUTE.finditer(tag[3]):
            found.append(Value(begin + each.start(2) + 1, begin + each.end(2) - 1, f"{tag[2]} {each[1]}"))
        if following is not None and following[1] and not tag[1] and text[tag.end() : following.start()].strip():
            found.append(Value(tag.end(), following.start(), tag[2]))
    return found


def xml(text: str, rng: random.Random) -> str:
    """Remove, duplicate, move, swap, rename and nest elements; remove and move attributes; replace values.

    In half of the cases each value stays of its kind, so that a reader comes beyond the first check of values.
    """
    valid = rng.random() < 0.5
    value = _value if valid else _hostile_value
    for _ in range(rng.choice((1, 1, 1, 2, 3, 8))):
        kind = rng.choice((value, value, value, _element, _element, _attribute, _value, _nest))
        text = kind(text, rng)
    if valid or rng.random() < 0.9:
        return text
    return text[: rng.randrange(len(text) + 1)]


def _put(text: str, start: int, end: int, new: str) -> str:
    return text[:start] + new + text[end:]


def _hostile_value(text: str, rng: random.Random) -> str:
    """Replace a value, or one part of a list of numbers, by a hostile one."""
    found = values(text)
    if not found:
        return text
    start, end, _ = rng.choice(found)
    parts = text[start:end].split()
    new = rng.choice(HOSTILE)
    if len(parts) > 1 and rng.random() < 0.5:
        parts[rng.randrange(len(parts))] = new
        new = " ".join(parts)
    return _put(text, start, end, new.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;"))


def _value(text: str, rng: random.Random) -> str:
    """Change a number, or refer to another name of the same kind, at one place or wherever the value stands."""
    found = values(text)
    if not found:
        return text
    start, end, owner = rng.choice(found)
    old = text[start:end]
    numbers = list(_NUMBER.finditer(old))
    if numbers and rng.random() < 0.9:
        for number in reversed(numbers if rng.random() < 0.2 else [rng.choice(numbers)]):
            new = float(number[0]) * rng.choice(_FACTORS) if rng.random() < 0.7 else rng.uniform(-2, 2)
            old = _put(old, *number.span(), f"{new:.6g}")
        return _put(text, start, end, old)
    alike = [text[each.start : each.end] for each in found if each.owner == owner]
    new = rng.choice(alike if rng.random() < 0.6 else [text[each.start : each.end] for each in found])
    if rng.random() < 0.2 and old.strip():
        return re.sub(rf"(?<![\w/]){re.escape(old.strip())}(?![\w/])", lambda _: new, text)
    return _put(text, start, end, new)


def _element(text: str, rng: random.Random) -> str:
    found = elements(text)
    if not found:
        return text
    one, other = rng.choice(found), rng.choice(found)
    content = text[one.start : one.end]
    kind = rng.randrange(8)
    if kind == 0:
        return _put(text, one.start, one.end, "")
    if kind == 1:
        return _put(text, one.end, one.end, content * rng.choice((1, 1, 1, 2, 30)))
    if kind == 2:
        renamed = re.sub(r'(\sname\s*=\s*")([^"]*)', rf"\g<1>\g<2>_{rng.randrange(100)}", content)
        return _put(text, one.end, one.end, renamed)
    if kind == 3:
        return _put(text, other.start, other.start, content)
    if kind == 4:
        return _put(text, one.start, one.end, text[other.start : other.end])
    if kind == 5:
        place = rng.choice((other.inner, other.start))
        if one.start <= place < one.end:
            return text
        moved = _put(text, place, place, content)
        shift = len(content) if place <= one.start else 0
        return _put(moved, one.start + shift, one.end + shift, "")
    if kind == 6:
        return _put(text, one.start, one.end, re.sub(rf"(</?){re.escape(one.name)}\b", rf"\g<1>{other.name}", content))
    inner = text[one.inner : one.end]
    return _put(text, one.start, one.end, inner[: inner.rfind("</")] if "</" in inner else "")


def _attribute(text: str, rng: random.Random) -> str:
    """Remove an attribute, or move a copy of it to another element."""
    tags = [tag for tag in _MARKUP.finditer(text) if tag[2] is not None and not tag[1]]
    owners = [tag for tag in tags if "=" in tag[3]]
    if not owners:
        return text
    owner = rng.choice(owners)
    attributes = list(_ATTRIBUTE.finditer(owner[3]))
    if not attributes:
        return text
    one = rng.choice(attributes)
    if rng.random() < 0.5:
        return _put(text, owner.start(3) + one.start(), owner.start(3) + one.end(), "")
    other = rng.choice(tags)
    if rng.random() < 0.8 and one[1] in other[3]:
        return text
    return _put(text, other.end(2), other.end(2), one[0])


def _nest(text: str, rng: random.Random) -> str:
    """Put an element into others of a name, few or deeper than any reader accepts."""
    found = elements(text)
    if not found:
        return text
    one, name = rng.choice(found), rng.choice(found).name
    depth = rng.choice((1, 1, 2, 10, 150)) if rng.random() < 0.95 else 1000
    return _put(text, one.start, one.end, f"<{name}>" * depth + text[one.start : one.end] + f"</{name}>" * depth)
