"""Insertion of elements before ``</robot>`` that leaves all other bytes of the file unchanged."""

import re
from pathlib import Path

from urdfkit.errors import ResourceError

_HIDDEN = re.compile(rb"<!--.*?-->|<!\[CDATA\[.*?\]\]>", re.DOTALL)
_CLOSE = re.compile(rb"</\s*robot\s*>")
_XACRO = re.compile(rb"""xmlns:([\w.-]+)\s*=\s*["'](?:https?://)?(?:www\.|wiki\.)?ros\.org/(?:wiki/)?xacro/?["']""")
_CHILD = re.compile(rb"(?m)^([ \t]+)<[^/!?]")


def xacro_prefix(content: bytes) -> str | None:
    """Return the prefix of xacro's namespace in a file; None if the file does not declare it.

    Args:
        content: the bytes of the file.
    """
    declaration = _XACRO.search(_without_comments(content))
    return declaration[1].decode() if declaration else None


def insert_before_end(content: bytes, lines: str, *, path: Path) -> bytes:
    r"""Return the content of a file with lines inserted before its last ``</robot>``.

    The lines get the indentation and line endings of the file; all other bytes are unchanged.

    Args:
        content: the bytes of the file.
        lines: the lines to insert, indented by two blanks per level and separated by ``\n``.
        path: path of the file, for error messages.

    Raises:
        ResourceError: the file has no ``</robot>``, or its encoding is not compatible with ASCII.
    """
    shown = _without_comments(content)
    closes = list(_CLOSE.finditer(shown))
    if not closes:
        raise ResourceError(f"{path} has no </robot>, before which elements could be inserted")
    end = closes[-1].start()
    newline = "\r\n" if b"\r\n" in content else "\n"
    unit = _unit(shown)
    text = "".join(_indented(line, unit) + newline for line in lines.splitlines())
    line_start = content.rfind(b"\n", 0, end) + 1
    if content[line_start:end].strip():  # `</robot>` is not at the beginning of its line
        return content[:end] + newline.encode() + text.encode("utf-8") + content[end:]
    return content[:line_start] + text.encode("utf-8") + content[line_start:]


def _indented(line: str, unit: str) -> str:
    blanks = len(line) - len(line.lstrip(" "))
    return unit * (1 + blanks // 2) + line[blanks:] if line.strip() else ""


def _unit(shown: bytes) -> str:
    """Return the indentation of the first element inside the robot."""
    first = _CHILD.search(shown)
    return first[1].decode() if first and len(first[1]) <= 8 else "  "


def _without_comments(content: bytes) -> bytes:
    """Return the content with comments and CDATA replaced by blanks of the same length."""
    return _HIDDEN.sub(lambda match: re.sub(rb"[^\n]", b" ", match[0]), content)
