"""Names of links and joints that not every tool takes, replaced wherever the description has them."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator, Mapping
from html import unescape

from urdfkit.scaffold.templates.names import free, plain

_TAG = re.compile(r"<!--.*?-->|<([A-Za-z][\w:.-]*)((?:[^<>\"']|\"[^\"]*\"|'[^']*')*)>", re.DOTALL)
_TEXT = re.compile(r"<!--.*?-->|(?<=>)([^<>]+)(?=</)", re.DOTALL)
_NAMED = {"link": "name", "joint": "name", "parent": "link", "child": "link", "mimic": "joint", "gazebo": "reference"}
"""Which attribute of an element names a link or joint."""
_DECLARED = re.compile(rb"""\A\s*(<\?xml\b[^>]*?\bencoding\s*=\s*)(["'])([\w.-]+)\2""")
_TOLD = 6
"""So many new names are told; of more, how many."""


def in_utf8(content: bytes) -> bytes:
    """Return an XML file in UTF-8, declared so; one that is in UTF-8 stays as it is, byte for byte.

    Args:
        content: of the file, in UTF-16 with its mark or in the encoding that it declares. What nobody knows stays.
    """
    if content[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
        content = content.decode("utf-16", "replace").encode("utf-8")
    elif (said := _DECLARED.match(content)) is not None:
        try:
            encoding = codecs.lookup(said[3].decode()).name
            content = content if encoding.startswith("utf") else content.decode(encoding, "replace").encode("utf-8")
        except (LookupError, UnicodeError):
            return content
    said = _DECLARED.match(content)
    if said is None or said[3].lower() in (b"utf-8", b"us-ascii"):
        return content
    return content[: said.start(3)] + b"utf-8" + content[said.end(3) :]


def renamed(text: str, package: str) -> tuple[str, dict[str, str]]:
    """Return a URDF whose names every tool takes, and what is called otherwise now: old name → new name.

    Links and joints are renamed where they are, in what refers to them, and where a parameter of a plugin names them.

    Args:
        text: of the URDF; all else stays, character for character.
        package: what a robot is called whose own name is none.
    """
    names = dict.fromkeys(name for tag, name in _names(text) if tag in ("link", "joint") and name)
    new: dict[str, str] = {}
    for name in names:
        if plain(name) != name:
            new[name] = free(plain(name) or "part", lambda each: each in names or each in new.values())
    robot = next((name for tag, name in _names(text) if tag == "robot"), "")
    again = {robot: package} if robot and plain(robot) != robot else {}
    if not new and not again:
        return text, {}

    def tag(match: re.Match[str]) -> str:
        attribute, by = ("name", again) if match[1] == "robot" else (_NAMED.get(match[1] or "", ""), new)
        found = _value(match[2] or "", attribute) if attribute else None
        if found is None or (name := by.get(unescape(found[2]))) is None:
            return match[0]
        start = match.start(2) - match.start()
        return match[0][: start + found.start(2)] + name + match[0][start + found.end(2) :]

    def parameter(match: re.Match[str]) -> str:
        words = re.split(r"(\s*,\s*|\A\s+|\s+\Z)", match[1] or "")
        return "".join(new.get(unescape(word), word) for word in words) if match[1] else match[0]

    return _TEXT.sub(parameter, _TAG.sub(tag, text)), {**again, **new}


def told(new: Mapping[str, str]) -> list[str]:
    """Return the line that says what is called otherwise now; none where nothing is.

    Args:
        new: old name → new name.
    """
    listed = ", ".join(f"`{old}` → `{name}`" for old, name in list(new.items())[:_TOLD])
    more = f" and {len(new) - _TOLD} more" if len(new) > _TOLD else ""
    return [f"renamed: {listed}{more}"] if new else []


def _names(text: str) -> Iterator[tuple[str, str]]:
    for match in _TAG.finditer(text):
        if match[1] and (found := _value(match[2], "name")) is not None:
            yield match[1], unescape(found[2])


def _value(attributes: str, name: str) -> re.Match[str] | None:
    return re.search(rf"""(?<![\w:.-]){name}\s*=\s*(["'])(.*?)\1""", attributes, re.DOTALL)
