"""Put answers into the text of a template: ``@name@``, and lines that come once for each of several answers."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path

from urdfkit.errors import ResourceError, did_you_mean

_PLACEHOLDER = re.compile(r"@([a-z][a-z0-9_]*)@")


def fill(text: str, answers: Mapping[str, str], *, where: str) -> str:
    """Return `text` with every ``@name@`` replaced.

    Args:
        text: of a file, or its path.
        answers: what the names stand for.
        where: named in the error.

    Raises:
        ResourceError: a placeholder is unknown.
    """

    def answer(match: re.Match[str]) -> str:
        if match[1] not in answers:
            line = text.count("\n", 0, match.start()) + 1
            column = match.start() - text.rfind("\n", 0, match.start())
            raise ResourceError(f"{where}:{line}:{column}: no question `{match[1]}`{did_you_mean(match[1], answers)}")
        return answers[match[1]]

    return _PLACEHOLDER.sub(answer, text)


def inside(path: str | Path, *, where: str) -> Path:
    """Return a path of the result, without the ``..`` in it.

    Args:
        path: as a template and its answers give it.
        where: named in the error.

    Raises:
        ResourceError: it is absolute, or leads out of the result.
    """
    short = Path(os.path.normpath(path))
    if short.is_absolute() or short.parts[:1] == ("..",):
        raise ResourceError(f"{where}: {path} is outside of what is written: a path in it, without a / in front")
    return short


def repeat_lines(text: str, several: Mapping[str, tuple[str, ...]]) -> str:
    """Return `text` with each line that names one of `several` once for each of its values; without values, not at all.

    Args:
        text: of a file.
        several: values by name.
    """
    if not any(f"@{name}@" in text for name in several):
        return text
    return "".join(_repeated(line, several) for line in text.splitlines(keepends=True))


def _repeated(line: str, several: Mapping[str, tuple[str, ...]]) -> str:
    for name, values in several.items():
        if f"@{name}@" in line:
            return "".join(_repeated(line.replace(f"@{name}@", value), several) for value in values)
    return line
