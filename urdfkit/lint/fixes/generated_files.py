"""Recognise files that a program wrote: by their first lines, or by neighbours of the same structure."""

import os
import re
from collections.abc import Mapping
from pathlib import Path

_HEAD = 2_000
_MARK = (
    r"(?i)\b(?:auto-?generated|generated (?:automatically|by|from|using|with)|automatically generated"
    r"|do not (?:edit|modify|change)|editing this file by hand is not recommended)\b"
)
_MIN_NEIGHBOURS = 3
_MAX_NEIGHBOURS = 30
_MAX_BYTES = 1_000_000


def reason_if_generated(path: Path, text: str, others: Mapping[Path, str] | None = None) -> str:
    """Return why a file is taken for the output of a program; empty if a person wrote it.

    Args:
        path: the file.
        text: its content.
        others: path → content that replaces neighbouring files on disk.
    """
    pattern = r"(?s)<!--(.*?)-->" if text.lstrip("\ufeff \t\r\n").startswith("<") else r"(?m)#(.*)$"
    mark = next((at for at in re.finditer(pattern, text[:_HEAD]) if re.search(_MARK, at[1])), None)
    if mark is not None:
        line = text.count("\n", 0, mark.start()) + 1
        return f"a comment on line {line} marks it as generated"
    neighbours = _neighbours(path)
    if _MIN_NEIGHBOURS <= len(neighbours) <= _MAX_NEIGHBOURS:
        structure = _structure(text)  # empty unless the file is XML
        if structure and all(
            _structure((others or {}).get(other) or _read(other)) == structure for other in neighbours
        ):
            return f"the {len(neighbours)} files next to it have the same structure, as if a program had written them"
    return ""


def _neighbours(path: Path) -> list[Path]:
    """Return the other files in the folder with the same suffix."""
    try:
        with os.scandir(path.parent) as scan:
            names = sorted(each.name for each in scan if each.is_file() and each.name.endswith(path.suffix))
    except OSError:
        return []
    return [path.parent / name for name in names if name != path.name]


def _read(path: Path) -> str:
    try:
        return "" if path.stat().st_size > _MAX_BYTES else path.read_text("utf-8", "replace")
    except OSError:
        return ""


def _structure(text: str) -> list[str]:
    """Return the names of the elements, with those of their attributes, in their order."""
    text = re.sub(r"(?s)<!--.*?-->", "", text)
    return [
        " ".join((tag[1], *re.findall(r"([\w:]+)\s*=", re.sub(r"\"[^\"]*\"|'[^']*'", "", tag[2]))))
        for tag in re.finditer(r"<(/?[\w:]+)((?:[^<>\"']|\"[^\"]*\"|'[^']*')*)>", text)
    ]
