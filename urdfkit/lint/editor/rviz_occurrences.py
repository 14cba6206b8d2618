"""Frames in the settings of RViz: fixed, reference and target frames, and the links and frames of displays."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.errors import ResourceError
from urdfkit.lint.editor.symbol_occurrences import Occurrence

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from urdfkit.description.xml.source import Source
    from urdfkit.lint.model.model import Model

_MAX_FILES = 100
_LINE = re.compile(r"(?m)^(?P<indent>[ ]*(?:-[ ]+)*)(?P<key>[^\s:#][^:\n]*):[ \t]*(?P<value>[^\r\n]*?)[ \t]*\r?$")
_TABLES = ("Links", "Frames", "Tree")
"""Settings whose keys are the names of links or frames."""


def in_rviz_files(model: Model) -> Iterator[Occurrence]:
    """Yield the links named in the RViz files of the package and of related packages."""
    packages = dict.fromkeys(filter(None, (model.package, *(package_of(Path(file)) for file in model.related_files))))
    files = dict.fromkeys(file for package in packages for file in sorted(package.rglob("*.rviz"))[:_MAX_FILES])
    for file in files:
        try:
            source = read_source(file, shown_as=shown_path(file), texts=model.texts)
        except ResourceError:
            continue
        yield from _in_source(source, model.robot.link_by_name.keys())


def _in_source(source: Source, links: Collection[str]) -> Iterator[Occurrence]:
    tables: list[int] = []  # indents of the enclosing tables of links
    for line in _LINE.finditer(source.text):
        indent = len(line["indent"])
        while tables and indent <= tables[-1]:
            tables.pop()
        key, value = (line[group].strip("\"'") for group in ("key", "value"))
        start = None
        if tables and key in links:
            start, name = line.start("key") + line["key"].index(key), key
        elif key.endswith("Frame") and value.lstrip("/") in links:
            name = value.lstrip("/")
            start = line.start("value") + line["value"].index(name)
        if start is not None:
            yield Occurrence("link", name, source.span(start, start + len(name)), False, name)
        if key in _TABLES and not value:
            tables.append(indent)
