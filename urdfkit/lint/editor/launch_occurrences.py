"""Occurrences of symbols in launch files: arguments of xacro, frames, and the joints of parameters.

The files are searched as text. A word counts only where launch files name frames (parameters such as ``base_frame``,
``static_transform_publisher``), joints, or arguments of xacro in a file that names the description.
"""

import re
from collections.abc import Iterator

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.editor.symbol_occurrences import Occurrence
from urdfkit.lint.model.model import Model

_FRAME = r"[\w-]*(?:frame|link)[\w-]*[\"']?(?:\s*[:=,]\s*|\s+value\s*=\s*)([\"'])([^\"'\s]+)\1"
_JOINT = r"([\"'])([^\"'\s]+)\1"
_ARGUMENT = r"(?:^|(?<=[\s\"']))([A-Za-z_][\w-]*):="
_MAPPINGS = r"\bmappings\s*=\s*\{([^{}]*)\}"
_KEY = r"[\"']([\w-]+)[\"']\s*:"
_PUBLISHER = "static_transform_publisher"


def in_launch_files(model: Model) -> Iterator[Occurrence]:
    """Yield the links, joints and xacro arguments named in launch files of the package and of related packages."""
    links, joints = model.robot.link_by_name, model.robot.joint_by_name
    for source in model.related_files.values():
        if not source.file.endswith(LAUNCH):
            continue
        text = _uncommented(source)
        for at in re.finditer(_FRAME, text):
            if at[2] in links:
                yield _occurrence(source, "link", at[2], at.start(2))
        for start, end in _publishers(text):
            for word in re.finditer(r"(?<![^\s\"'])[^\s\"',\[\]()]+(?![^\s\"'])", text[start:end]):
                if word[0] in links:
                    yield _occurrence(source, "link", word[0], start + word.start())
        for at in re.finditer(_JOINT, text):
            if at[2] in joints:
                yield _occurrence(source, "joint", at[2], at.start(2))
        if model.expanded.path.name in text:
            for at in re.finditer(_ARGUMENT, text, re.MULTILINE):
                yield _occurrence(source, "argument", at[1], at.start(1))
            for mapping in re.finditer(_MAPPINGS, text):
                for key in re.finditer(_KEY, mapping[1]):
                    yield _occurrence(source, "argument", key[1], mapping.start(1) + key.start(1))


def _occurrence(source: Source, kind: str, name: str, start: int) -> Occurrence:
    return Occurrence(kind, name, source.span(start, start + len(name)), False, name)


def _uncommented(source: Source) -> str:
    """Return the text with comments replaced by spaces, so that offsets stay."""
    pattern = r"(?m)#.*$" if source.file.endswith((".py", ".yaml", ".yml")) else r"(?s)<!--.*?(?:-->|\Z)"
    return re.sub(pattern, lambda comment: " " * len(comment[0]), source.text)


def _publishers(text: str) -> Iterator[tuple[int, int]]:
    """Yield start and end offset of the arguments of each publisher of a static transform."""
    for found in re.finditer(_PUBLISHER, text):
        before = max(text.rfind("Node(", 0, found.start()), text.rfind("<node", 0, found.start()))
        if before < 0:
            continue
        end = text.find(">", found.end()) if text[before] == "<" else _closing(text, before + len("Node"))
        at = re.compile(r"\barg(?:ument)?s\s*=").search(text, before, max(end, before))
        if at is not None:
            yield at.end(), end


def _closing(text: str, opening: int) -> int:
    """Return the offset of the parenthesis that closes the one at an offset; the end of the text without one."""
    depth = 0
    for at in re.compile(r"[()]").finditer(text, opening):
        depth += 1 if at[0] == "(" else -1
        if depth == 0:
            return at.start()
    return len(text)
