"""Mutations of input files that keep most of their structure."""

from __future__ import annotations

import json
import random
import re
import struct
from typing import Any

HOSTILE = (
    "",
    " ",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e999",
    "5e-324",
    "-1",
    "0",
    "-0",
    "1e30",
    "99999999999999999999",
    "0x10",
    "1,5",
    "1_0",
    "٣",
    "0.1 m",
    "90deg",
    "1 2",
    "1 2 3",
    "nan nan nan",
    "1e200 1e200 1e200",
    "0 0 0 0 0 0",
    "true",
    "missing_name",
    "world",
    "__model__",
    "a::b",
    "::",
    "model://missing",
    "model://../../..",
    "package://missing/a.stl",
    "file:///dev/zero",
    "http://example.com/a.dae",
    "..",
    "/",
    "~",
    "*",
    "a\tb",
    "é😀\u202e",
    "\ufeff",
    "$(find missing)",
    "$(arg missing)",
    "${1/0}",
    "x" * 300,
    "x" * 90_000,
    "9" * 5000,
    "1 " * 20_000,
)
"""Values for attributes and texts: not finite, huge, negative, of the wrong kind or with the name of nothing."""

_ELEMENT = re.compile(r"<([\w:.-]+)(?:\s[^<>]*)?/>|<([\w:.-]+)(?:\s[^<>]*)?>.*?</\2\s*>", re.DOTALL)
_OPEN = re.compile(r"<[\w:.-]+(?:\s[^<>]*?)?(?=/?>)")
_ATTRIBUTE = re.compile(r"""\s[\w:.-]+\s*=\s*("[^"<]*"|'[^'<]*')""")
_TEXT = re.compile(r">([^<>]*[^<>\s][^<>]*)<")
_SCALAR = re.compile(r"(?:(?<=: )|(?<=- )|(?<=\[)|(?<=, ))[^\s\[\]{}#,:][^\n\[\]{}#,]*")
_PYTHON = re.compile(r"'[^'\n]*'|\"[^\"\n]*\"|\b\d+(?:\.\d+)?\b|\b[a-z_]{3,}\b")


def xml(text: str, rng: random.Random) -> str:
    """Remove, duplicate, swap and replace elements, attributes and values."""
    for _ in range(rng.choice((1, 1, 1, 2, 3, 8))):
        text = rng.choice((_value, _value, _value, _element, _attribute, _nest))(text, rng)
    return text if rng.random() < 0.95 else text[: rng.randrange(len(text) + 1)]


def _escaped(value: str) -> str:
    return value.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")


def _put(text: str, start: int, end: int, new: str) -> str:
    return text[:start] + new + text[end:]


def _value(text: str, rng: random.Random) -> str:
    """Replace one value, all values that are equal to it, or one number of a list of numbers."""
    attributes, texts = list(_ATTRIBUTE.finditer(text)), list(_TEXT.finditer(text))
    found = rng.choice([*attributes, *texts]) if attributes or texts else None
    if found is None:
        return text
    quoted = found[1][0] in "\"'" and found[0][0] != ">"
    old = found[1][1:-1] if quoted else found[1]
    start, end = (found.start(1) + 1, found.end(1) - 1) if quoted else found.span(1)
    parts = old.split()
    new = rng.choice(HOSTILE)
    if len(parts) > 1 and rng.random() < 0.5:
        parts[rng.randrange(len(parts))] = rng.choice(HOSTILE)
        new = " ".join(parts)
    elif rng.random() < 0.2:
        other = rng.choice([*attributes, *texts])[1]
        new = other.strip("\"'")
        return text.replace(old, new) if old.strip() and rng.random() < 0.3 else _put(text, start, end, new)
    return _put(text, start, end, _escaped(new))


def _element(text: str, rng: random.Random) -> str:
    elements = list(_ELEMENT.finditer(text))
    if not elements:
        return text
    found, other = rng.choice(elements), rng.choice(elements)
    kind = rng.randrange(6)
    if kind == 0:
        return _put(text, *found.span(), "")
    if kind == 1:
        return _put(text, found.end(), found.end(), found[0] * rng.choice((1, 1, 2, 30)))
    if kind == 2:
        return _put(text, other.start(), other.start(), found[0])
    if kind == 3:
        return _put(text, *found.span(), other[0])
    name, new = found[1] or found[2], other[1] or other[2]
    return _put(text, *found.span(), re.sub(rf"(</?){re.escape(name)}\b", rf"\g<1>{new}", found[0]))


def _attribute(text: str, rng: random.Random) -> str:
    found = list(_ATTRIBUTE.finditer(text))
    tags = list(_OPEN.finditer(text))
    if not found or not tags:
        return text
    one = rng.choice(found)
    if rng.random() < 0.5:
        return _put(text, *one.span(), "")
    place = rng.choice(tags).end()
    return _put(text, place, place, one[0])


def _nest(text: str, rng: random.Random) -> str:
    elements = list(_ELEMENT.finditer(text))
    if not elements:
        return text
    found = rng.choice(elements)
    name = found[1] or found[2]
    depth = rng.choice((1, 2, 10, 150, 1000))
    return _put(text, *found.span(), f"<{name}>" * depth + found[0] + f"</{name}>" * depth)


def yaml(text: str, rng: random.Random) -> str:
    """Remove, duplicate, move and indent lines; replace values; add anchors, aliases and merges."""
    for _ in range(rng.choice((1, 1, 2, 3, 8))):
        lines = text.split("\n")
        at, other = rng.randrange(len(lines)), rng.randrange(len(lines))
        kind = rng.randrange(8)
        if kind == 0:
            del lines[at]
        elif kind == 1:
            lines[at:at] = [lines[other]] * rng.choice((1, 1, 50))
        elif kind == 2:
            lines[at], lines[other] = lines[other], lines[at]
        elif kind == 3:
            lines[at] = rng.choice(("  ", "\t", " ", "    " * 50)) + lines[at]
        elif kind == 4:
            indent = lines[at][: len(lines[at]) - len(lines[at].lstrip())]
            lines.insert(at, indent + rng.choice(_YAML))
        else:
            scalars = list(_SCALAR.finditer(text))
            if scalars:
                found = rng.choice(scalars)
                text = _put(text, *found.span(), rng.choice((*HOSTILE, *_YAML_VALUES)))
            continue
        text = "\n".join(lines)
    return text if rng.random() < 0.95 else text[: rng.randrange(len(text) + 1)]


_YAML = (
    "<<: *x",
    "<<: [*x, *x]",
    "a: &x {b: 1}",
    "a: &x [*x]",
    "? [a, b]\n: c",
    "- a",
    "a: !!python/object/apply:os.system [echo]",
    "a: !!binary x",
    "--- ",
    "%YAML 9.9",
    "a/b/c: 1",
    "/**:",
    "'': 1",
    "~: 1",
    "1: 2",
    "2001-01-01: 2001-99-99",
    "<<: 1",
    "a: {" * 300,
)
_YAML_VALUES = (
    "[]",
    "{}",
    "~",
    "[nan, .inf, -.inf]",
    ".nan",
    "!!float x",
    "*missing",
    "&x",
    "|",
    ">-",
    "[[[[]]]]",
    "'",
)


def python(text: str, rng: random.Random) -> str:
    """Replace literals and names of a Python file, and remove or duplicate lines."""
    for _ in range(rng.choice((1, 2, 5))):
        found = list(_PYTHON.finditer(text))
        if found and rng.random() < 0.7:
            one = rng.choice(found)
            new = rng.choice(
                (repr(rng.choice(HOSTILE)), rng.choice(found)[0], "[]", "None", "(" * 300, "1" + "+1" * 5000)
            )
            text = _put(text, *one.span(), new)
        else:
            text = yaml(text, rng)
    return text


def binary(content: bytes, rng: random.Random) -> bytes:
    """Flip, remove, insert and repeat bytes, and write extreme numbers at places of numbers."""
    for _ in range(rng.choice((1, 1, 2, 4, 16))):
        if not content:
            return content
        at = rng.randrange(len(content) if rng.random() < 0.7 else min(len(content), 128))
        kind = rng.randrange(6)
        if kind == 0:
            content = content[:at] + bytes([content[at] ^ 1 << rng.randrange(8)]) + content[at + 1 :]
        elif kind == 1:
            content = content[:at] + content[at + rng.choice((1, 2, 4, 50)) :]
        elif kind == 2:
            content = content[:at] + rng.choice(_NUMBERS) + content[at:]
        elif kind == 3:
            new = rng.choice(_NUMBERS)
            content = content[:at] + new + content[at + len(new) :]
        elif kind == 4:
            content = content[: at + 50] + content[at : at + 50] * rng.choice((1, 20)) + content[at + 50 :]
        elif rng.random() < 0.3:
            content = content[:at]
    return content


_NUMBERS = (
    *(struct.pack("<f", value) for value in (float("nan"), float("inf"), -float("inf"), 3e38, -1.0, 1e-45)),
    *(struct.pack("<I", value) for value in (0, 1, 2**31 - 1, 2**31, 2**32 - 1, 10**6)),
    *(struct.pack(">I", value) for value in (1, 2**31 - 1, 2**32 - 1, 10**5)),
    b"\xff\xff",
    b"\x00",
)


def words(content: bytes, rng: random.Random) -> bytes:
    """Change numbers and words of a text file such as OBJ."""
    text = content.decode("utf-8", "replace")
    for _ in range(rng.choice((1, 2, 5))):
        found = list(re.finditer(r"[^\s/]+", text))
        if found:
            one = rng.choice(found)
            text = _put(text, *one.span(), rng.choice((*HOSTILE, rng.choice(found)[0])))
    return text.encode("utf-8", "replace")


def tree(value: Any, rng: random.Random, depth: int = 0) -> Any:
    """Change a JSON value: one of its parts is replaced, removed, duplicated or nested."""
    if isinstance(value, dict) and value and rng.random() < 0.9 - 0.1 * depth:
        key = rng.choice(list(value))
        kind = rng.randrange(6)
        if kind == 0:
            return {name: each for name, each in value.items() if name != key}
        if kind == 1:
            return {**value, rng.choice(HOSTILE): value[key]}
        return {**value, key: tree(value[key], rng, depth + 1)}
    if isinstance(value, list) and value and rng.random() < 0.8 - 0.1 * depth:
        at = rng.randrange(len(value))
        kind = rng.randrange(4)
        if kind == 0:
            return value[:at] + value[at + 1 :]
        if kind == 1:
            return value * rng.choice((2, 100, 3000))
        return [*value[:at], tree(value[at], rng, depth + 1), *value[at + 1 :]]
    nested: Any = value
    for _ in range(rng.choice((1, 50))):
        nested = [nested]
    numbers = (0, -1, 1, 0.5, 2**31, 2**32, 2**64, 10**400, -(10**400), 1e308, -1e308, float("nan"), float("inf"))
    return rng.choice((None, True, False, {}, [], nested, *numbers, *rng.sample(HOSTILE, 3)))


def frame(message: dict[str, Any], rng: random.Random) -> str | bytes:
    """Return a frame of the WebSocket, mostly JSON with a changed part."""
    for _ in range(rng.choice((0, 1, 1, 1, 2, 4))):
        changed = tree(message, rng)
        message = changed if isinstance(changed, dict) else message
    text = json.dumps(message)
    kind = rng.random()
    if kind < 0.03:
        return text[: rng.randrange(len(text) + 1)]
    if kind < 0.05:
        return binary(text.encode(), rng)
    if kind < 0.07:
        return binary(text.encode(), rng).decode("utf-8", "replace")
    if kind < 0.08:
        return rng.choice(("[" * 30_000, '{"a":' * 20_000, "1" * 60_000, "", "null", '"x"', "[]"))
    return text
