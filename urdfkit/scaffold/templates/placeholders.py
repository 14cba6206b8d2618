"""Replacement of the placeholders of a template by answers: ``@name@``, and lines repeated for several answers."""

import os
import re
from collections.abc import Mapping
from pathlib import Path

from urdfkit.errors import ResourceError, did_you_mean

_PLACEHOLDER = re.compile(r"@([a-z][a-z0-9_]*)@")


def fill(text: str, answers: Mapping[str, str], *, where: str) -> str:
    """Return `text` with every ``@name@`` replaced by the answer.

    Args:
        text: the text of a file, or its path.
        answers: answers by name.
        where: file name for the error message.

    Raises:
        ResourceError: a placeholder has no answer.
    """

    def answer(match: re.Match[str]) -> str:
        if match[1] not in answers:
            line = text.count("\n", 0, match.start()) + 1
            column = match.start() - text.rfind("\n", 0, match.start())
            raise ResourceError(f"{where}:{line}:{column}: no question `{match[1]}`{did_you_mean(match[1], answers)}")
        return answers[match[1]]

    return _PLACEHOLDER.sub(answer, text)


def path_inside(path: str | Path, *, where: str) -> Path:
    """Return a normalized path, checked to be inside the folder that is written to.

    Args:
        path: path relative to that folder, from a template and its answers.
        where: file name for the error message.

    Raises:
        ResourceError: the path is absolute, or leads out of the folder.
    """
    short = Path(os.path.normpath(path))
    if short.is_absolute() or short.parts[:1] == ("..",):
        raise ResourceError(f"{where}: {path} is outside the output folder; use a relative path without `..`")
    return short


def repeat_lines(text: str, several: Mapping[str, tuple[str, ...]]) -> str:
    """Return `text` with each line that names one of `several` repeated for each value, and removed without values.

    Args:
        text: the text of a file.
        several: values by placeholder.
    """
    if not any(f"@{name}@" in text for name in several):
        return text
    return "".join(_repeated(line, several) for line in text.splitlines(keepends=True))


def _repeated(line: str, several: Mapping[str, tuple[str, ...]]) -> str:
    for name, values in several.items():
        if f"@{name}@" in line:
            return "".join(_repeated(line.replace(f"@{name}@", value), several) for value in values)
    return line
