"""Put elements before ``</robot>`` in a file that a person wrote, and touch no other byte of it."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.errors import ResourceError

_HIDDEN = re.compile(rb"<!--.*?-->|<!\[CDATA\[.*?\]\]>", re.DOTALL)
_CLOSE = re.compile(rb"</\s*robot\s*>")
_XACRO = re.compile(rb"""xmlns:([\w.-]+)\s*=\s*["'](?:https?://)?(?:www\.|wiki\.)?ros\.org/(?:wiki/)?xacro/?["']""")
_CHILD = re.compile(rb"(?m)^([ \t]+)<[^/!?]")


def xacro_prefix(content: bytes) -> str | None:
    """Return what a file calls xacro's namespace; None where it declares none.

    Args:
        content: of the file.
    """
    found = _XACRO.search(_shown(content))
    return found[1].decode() if found else None


def insert_before_end(content: bytes, lines: str, *, path: Path) -> bytes:
    r"""Return the content of a file with lines before its last ``</robot>``.

    They get the indentation of the file's elements and its line ends; all else stays, byte for byte.

    Args:
        content: of the file.
        lines: to put in, with an indentation of two blanks a level and ``\n``.
        path: of the file, for the error.

    Raises:
        ResourceError: it has no ``</robot>``, or is in an encoding where that is not ASCII.
    """
    shown = _shown(content)
    closes = list(_CLOSE.finditer(shown))
    if not closes:
        raise ResourceError(f"{path} has no </robot> that something could be put before")
    end = closes[-1].start()
    newline = "\r\n" if b"\r\n" in content else "\n"
    unit = _unit(shown)
    text = "".join(_indented(line, unit) + newline for line in lines.splitlines())
    line_start = content.rfind(b"\n", 0, end) + 1
    if content[line_start:end].strip():  # something is before it on its line
        return content[:end] + newline.encode() + text.encode("utf-8") + content[end:]
    return content[:line_start] + text.encode("utf-8") + content[line_start:]


def _indented(line: str, unit: str) -> str:
    blanks = len(line) - len(line.lstrip(" "))
    return unit * (1 + blanks // 2) + line[blanks:] if line.strip() else ""


def _unit(shown: bytes) -> str:
    """Return what an element of the robot is indented by: as the first is."""
    first = _CHILD.search(shown)
    return first[1].decode() if first and len(first[1]) <= 8 else "  "


def _shown(content: bytes) -> bytes:
    """Return the content with what is in comments blanked, in place."""
    return _HIDDEN.sub(lambda match: re.sub(rb"[^\n]", b" ", match[0]), content)
