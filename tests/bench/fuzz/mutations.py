"""Mutations of YAML, Python, JSON, text and binary files that keep most of their structure."""

from __future__ import annotations

import json
import random
import re
import struct
from typing import Any

from tests.bench.fuzz.hostile_values import HOSTILE

_SCALAR = re.compile(r"(?:(?<=: )|(?<=- )|(?<=\[)|(?<=, ))[^\s\[\]{}#,:][^\n\[\]{}#,]*")
_PYTHON = re.compile(r"'[^'\n]*'|\"[^\"\n]*\"|\b\d+(?:\.\d+)?\b|\b[a-z_]{3,}\b")


def _put(text: str, start: int, end: int, new: str) -> str:
    return text[:start] + new + text[end:]


def yaml(text: str, rng: random.Random) -> str:
    """Change values of the parsed file, or lines of its text."""
    from yaml import YAMLError, dump, safe_load

    if rng.random() < 0.5:
        try:
            parsed = safe_load(text)
        except (YAMLError, ValueError):
            parsed = None
        if isinstance(parsed, dict | list):
            for _ in range(rng.choice((1, 2, 4))):
                changed = tree(parsed, rng)
                parsed = changed if isinstance(changed, dict | list) else parsed
            if _is_small(parsed):
                return str(dump(parsed, allow_unicode=True, sort_keys=False))
    return lines_of_yaml(text, rng)


def _is_small(tree: Any) -> bool:
    """Return whether a tree has few nodes; each use of a YAML anchor counts."""
    pending = [tree]
    for node in pending:  # The list grows during the iteration.
        pending += node.values() if isinstance(node, dict) else node if isinstance(node, list | tuple | set) else ()
        if len(pending) > 10_000:
            return False
    return True


def lines_of_yaml(text: str, rng: random.Random) -> str:
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
            text = lines_of_yaml(text, rng)
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


def glb(content: bytes, rng: random.Random) -> bytes:
    """Change the JSON of a binary glTF file, and correct the lengths in its headers."""
    size = struct.unpack_from("<I", content, 12)[0]
    document = tree(json.loads(content[20 : 20 + size]), rng)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = content[20 + size :]
    return content[:8] + struct.pack("<III", 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest


def words(content: bytes, rng: random.Random) -> bytes:
    """Change numbers and words of a text file such as OBJ."""
    text = content.decode("utf-8", "replace")
    for _ in range(rng.choice((1, 2, 5))):
        found = list(re.finditer(r"[^\s/]+", text))
        if found:
            one = rng.choice(found)
            new = rng.choice(HOSTILE) if rng.random() < 0.5 else rng.choice(found)[0]
            text = _put(text, *one.span(), new)
        if found and rng.random() < 0.3:
            lines = text.split("\n")
            at = rng.randrange(len(lines))
            lines[at : at + rng.choice((0, 1, 1))] = [rng.choice(lines)] * rng.choice((0, 1, 2, 100))
            text = "\n".join(lines)
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
            return value * rng.choice((2, 100, 1000 if len(value) < 10 and depth < 3 else 3))
        return [*value[:at], tree(value[at], rng, depth + 1), *value[at + 1 :]]
    nested: Any = value
    for _ in range(rng.choice((1, 50))):
        nested = [nested]
    numbers = (0, -1, 1, 0.5, 2**31, 2**32, 2**64, 10**400, -(10**400), 1e308, -1e308, float("nan"), float("inf"))
    return rng.choice((None, True, False, {}, [], nested, *numbers, *rng.sample(HOSTILE, 3)))


def frame(message: dict[str, Any], rng: random.Random) -> str | bytes:
    """Return a frame of the WebSocket, mostly JSON with a changed part."""
    for _ in range(rng.choice((0, 0, 0, 1, 1, 2))):
        parts = [name for name, value in message.items() if isinstance(value, dict | list)]
        if parts and rng.random() < 0.8:
            part = rng.choice(parts)
            message = {**message, part: tree(message[part], rng)}
        elif rng.random() < 0.5:
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
