"""Replacement of names of links and joints that some tools reject."""

import codecs
import re
from collections.abc import Iterator, Mapping
from html import unescape

from urdfkit.scaffold.templates.names import portable_name, unused_name

_TAG = re.compile(r"<!--.*?-->|<([A-Za-z][\w:.-]*)((?:[^<>\"']|\"[^\"]*\"|'[^']*')*)>", re.DOTALL)
_TEXT = re.compile(r"<!--.*?-->|(?<=>)([^<>]+)(?=</)", re.DOTALL)
_NAMED = {"link": "name", "joint": "name", "parent": "link", "child": "link", "mimic": "joint", "gazebo": "reference"}
"""Attribute that refers to a link or joint, by element."""
_DECLARED = re.compile(rb"""\A\s*(<\?xml\b[^>]*?\bencoding\s*=\s*)(["'])([\w.-]+)\2""")
_LISTED = 6
"""Number of new names to print; of further ones, only the count is printed."""


def in_utf8(content: bytes) -> bytes:
    """Return an XML file converted to UTF-8; a file in UTF-8 is returned unchanged.

    Args:
        content: bytes in UTF-16 with a byte order mark, or in the declared encoding; content in an unknown encoding is
            returned unchanged.
    """
    if content[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
        content = content.decode("utf-16", "replace").encode("utf-8")
    elif (declaration := _DECLARED.match(content)) is not None:
        try:
            encoding = codecs.lookup(declaration[3].decode()).name
            content = content if encoding.startswith("utf") else content.decode(encoding, "replace").encode("utf-8")
        except (LookupError, UnicodeError):
            return content
    declaration = _DECLARED.match(content)
    if declaration is None or declaration[3].lower() in (b"utf-8", b"us-ascii"):
        return content
    return content[: declaration.start(3)] + b"utf-8" + content[declaration.end(3) :]


def renamed(text: str, package: str) -> tuple[str, dict[str, str]]:
    """Return a URDF with portable names, and the new name of each renamed element.

    Links and joints are renamed in their definitions, in references, and in parameters of plugins.

    Args:
        text: the URDF; all other characters are unchanged.
        package: new name of a robot whose name is not portable.
    """
    names = dict.fromkeys(name for tag, name in _names(text) if tag in ("link", "joint") and name)
    new: dict[str, str] = {}
    for name in names:
        if portable_name(name) != name:
            new[name] = unused_name(portable_name(name) or "part", lambda each: each in names or each in new.values())
    robot = next((name for tag, name in _names(text) if tag == "robot"), "")
    again = {robot: package} if robot and portable_name(robot) != robot else {}
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


def renaming_note(new: Mapping[str, str]) -> list[str]:
    """Return a line that lists new names; empty if nothing was renamed.

    Args:
        new: old name → new name.
    """
    listed = ", ".join(f"`{old}` → `{name}`" for old, name in list(new.items())[:_LISTED])
    more = f" and {len(new) - _LISTED} more" if len(new) > _LISTED else ""
    return [f"renamed: {listed}{more}"] if new else []


def _names(text: str) -> Iterator[tuple[str, str]]:
    for match in _TAG.finditer(text):
        if match[1] and (found := _value(match[2], "name")) is not None:
            yield match[1], unescape(found[2])


def _value(attributes: str, name: str) -> re.Match[str] | None:
    return re.search(rf"""(?<![\w:.-]){name}\s*=\s*(["'])(.*?)\1""", attributes, re.DOTALL)
