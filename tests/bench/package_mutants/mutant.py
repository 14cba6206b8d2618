"""One mistake in one file of a workspace, and the tools that the kinds of mistakes share.

A kind is a function that yields the mutants of its kind in a workspace; its docstring is the effect of the mistake. A
mutant holds the places that a finding may name: the changed lines, the element around the change, and its names.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from urdfkit.description.xml.source import Source
from urdfkit.lint.engine.checker import model_of
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.project.entry_files import find_entries
from urdfkit.lint.project.options import Options


@dataclass(frozen=True)
class Mutant:
    """One mistake.

    Attributes:
        file: path inside the workspace.
        start: offset of the replaced text.
        end: offset after the replaced text.
        text: what replaces the text.
        also: offsets of a second place that is equally right for a finding, such as the start tag that lacks a child.
        around: offsets of the element that contains the change; a finding inside it names the mistake, not its line.
        names: words of the mistake, old and new; a finding that quotes one names the mistake, wherever it is.
        uses: the lines that hold one of the names are right too: a definition was renamed or removed.
        anywhere: any line of the file is right, since the missing text has no place.
        action: ``edit``, ``rename`` (to `text`), ``delete`` or ``add`` (a new file with `text`).
    """

    file: str
    start: int = 0
    end: int = 0
    text: str = ""
    also: tuple[int, int] | None = None
    around: tuple[int, int] | None = None
    names: tuple[str, ...] = ()
    uses: bool = False
    anywhere: bool = False
    action: str = "edit"
    area: str = ""
    kind: str = ""
    base: str = ""


Kind = Callable[["Workspace", random.Random], Iterator[Mutant]]
KINDS: dict[str, dict[str, Kind]] = {}


def kind(area: str) -> Callable[[Kind], Kind]:
    """Register a function as a kind of mistake of an area."""

    def register(function: Kind) -> Kind:
        KINDS.setdefault(area, {})[function.__name__.strip("_").replace("_", "-")] = function
        return function

    return register


class Workspace:
    """Text files of a workspace, and its robot."""

    def __init__(self, base: str, folder: Path) -> None:
        self.base = base
        self.folder = folder
        self.files: dict[str, str] = {}
        for path in sorted(folder.rglob("*")):
            if path.is_file() and path.suffix != ".stl":
                self.files[str(path.relative_to(folder))] = path.read_text("utf-8")
        self.packages = {path.split("/")[0] for path in self.files if path.endswith("package.xml")}
        self.ros = 1 if any("catkin" in self.files[f"{name}/package.xml"] for name in self.packages) else 2

    def of(self, pattern: str) -> Iterator[tuple[str, str]]:
        """Yield path and text of the files whose path a pattern finds."""
        for path, text in self.files.items():
            if re.search(pattern, path):
                yield path, text

    def tags(self, pattern: str, *names: str) -> Iterator[tuple[str, Tag]]:
        """Yield the tags of XML files; those with one of the names, if names are given."""
        for path, _text in self.of(pattern):
            for tag in self.document(path).walk():
                if not names or tag.name in names:
                    yield path, tag

    def document(self, path: str) -> Document:
        """Return the tags of a file."""
        return self._documents.setdefault(path, Document(Source(path, self.files[path])))

    @cached_property
    def _documents(self) -> dict[str, Document]:
        return {}

    @cached_property
    def models(self) -> list[object]:
        """The robots of the workspace."""
        return [model_of(entry.path, Options()) for entry in find_entries([self.folder]) if entry.has_robot]

    @cached_property
    def joints(self) -> dict[str, str]:
        """Name → type of the joints of the robots."""
        return {joint.name: joint.type for model in self.models for joint in model.robot.joints}  # type: ignore[attr-defined]

    @cached_property
    def links(self) -> list[str]:
        """Names of the links of the robots."""
        return [link.name for model in self.models for link in model.robot.links]  # type: ignore[attr-defined]

    def model_tags(self, *names: str, parent: str = "") -> Iterator[tuple[str, Tag]]:
        """Yield the tags of the description that are part of the expanded robot."""
        for path, tag in self.tags(r"/urdf/", *names):
            line = self.files[path].count("\n", 0, tag.start) + 1
            if (path, line) in self._live and (not parent or (tag.parent is not None and tag.parent.name == parent)):
                yield path, tag

    @cached_property
    def _live(self) -> set[tuple[str, int]]:
        found = set()
        for model in self.models:
            root = model.expanded.root  # type: ignore[attr-defined]
            for element in root.walk():
                for position in (element.origin.position, *(call.position for call in element.origin.expansions)):
                    path = Path.cwd() / position.file
                    if path.is_relative_to(self.folder):
                        found.add((str(path.relative_to(self.folder)), position.line))
        return found

    def expanded_names(self, file: str, tag: Tag) -> tuple[str, ...]:
        """Return the names of the links and joints of the robots that a tag creates."""
        line = self.files[file].count("\n", 0, tag.start) + 1
        found = []
        for model in self.models:
            for part in (*model.robot.links, *model.robot.joints):  # type: ignore[attr-defined]
                position = part.element.origin.position
                if position.line == line and Path.cwd() / position.file == self.folder / file:
                    found.append(part.name)
        return tuple(dict.fromkeys(found))

    @cached_property
    def movable_links(self) -> set[str]:
        """The children of movable joints."""
        joints = [joint for model in self.models for joint in model.robot.joints]  # type: ignore[attr-defined]
        return {joint.child for joint in joints if joint.type != "fixed"}

    def uses(self, word: str, *, outside: str = "") -> int:
        """Return how many files hold a word."""
        return sum(
            bool(re.search(rf"(?<![\w-]){re.escape(word)}(?![\w-])", text))
            for path, text in self.files.items()
            if path != outside and not path.endswith((".md", ".rviz", ".toml"))
        )


def typo(name: str, lot: random.Random, taken: object = ()) -> str:
    """Return a name as a person mistypes it, different from the names that exist."""
    letters = [i for i, character in enumerate(name) if character.isalpha()]
    for _ in range(50):
        way = lot.randrange(6)
        at = lot.choice(letters)
        if way == 0 and at + 1 < len(name) and name[at + 1].isalpha() and name[at] != name[at + 1]:
            wrong = name[:at] + name[at + 1] + name[at] + name[at + 2 :]
        elif way == 1 and len(name) > 4:
            wrong = name[:at] + name[at + 1 :]
        elif way == 2:
            wrong = name[: at + 1] + name[at:]
        elif way == 3 and "_" in name:
            at = lot.choice([i for i, character in enumerate(name) if character == "_"])
            wrong = name[:at] + lot.choice(["", "-"]) + name[at + 1 :]
        elif way == 4:
            wrong = name[:-1] if name.endswith("s") else f"{name}s"
        elif way == 5 and name[-1].isdigit():
            wrong = f"{name[:-1]}{(int(name[-1]) + 7) % 10}"
        else:
            continue
        if wrong != name and wrong not in taken:  # type: ignore[operator]
            return wrong
    return f"{name}x"


def literal(tag: Tag, name: str) -> str:
    """Return the value of an attribute without expressions, or an empty text."""
    written = tag.attributes.get(name)
    return written.value if written is not None and "$" not in written.value else ""


def numbers(text: str) -> list[float]:
    """Return the numbers of a text; an empty list if it holds anything else."""
    try:
        return [float(word) for word in text.split()]
    except ValueError:
        return []


def _around(tag: Tag) -> tuple[int, int]:
    whole = tag.parent or tag
    return whole.start, whole.close_end


def value(file: str, tag: Tag, name: str, new: str, **more: object) -> Mutant:
    """Replace the value of an attribute."""
    written = tag.attributes[name]
    return Mutant(file, written.value_start, written.value_end, new, (tag.start, tag.end), _around(tag), **more)  # type: ignore[arg-type]


def wrong_name(file: str, tag: Tag, name: str, new: str, **more: object) -> Mutant:
    """Replace the value of an attribute that is a name."""
    return value(file, tag, name, new, names=(new, tag.attributes[name].value), **more)


def attribute(file: str, tag: Tag, name: str, new: str) -> Mutant:
    """Rename an attribute; remove it if the new name is empty."""
    written = tag.attributes[name]
    start = written.start
    if not new:
        while tag.start < start and tag._text[start - 1].isspace():
            start -= 1
        return Mutant(file, start, written.end, "", (tag.start, tag.end), _around(tag))
    return Mutant(file, start, start + len(name), new, (tag.start, tag.end), _around(tag), (new,))


def element(file: str, tag: Tag, new: str = "", **more: object) -> Mutant:
    """Replace an element; it is missing at the start tag of the element around it."""
    start, end = tag.start, tag.close_end
    if not new:
        text = tag._text
        while start and text[start - 1] in " \t":
            start -= 1
        if text[end : end + 1] == "\n":
            end += 1
    above = tag.parent
    also = (above.start, above.end) if above is not None else None
    return Mutant(file, start, end, new, also, _around(tag), **more)  # type: ignore[arg-type]


def content(file: str, tag: Tag, new: str, **more: object) -> Mutant:
    """Replace the text of an element."""
    assert tag.close is not None
    return Mutant(file, tag.end, tag.close, new, (tag.start, tag.close_end), _around(tag), **more)  # type: ignore[arg-type]


def text_of(tag: Tag) -> str:
    """Return the text of an element without children."""
    return tag._text[tag.end : tag.close] if tag.close is not None and not tag.children else ""


def renamed_tag(file: str, tag: Tag, new: str) -> Mutant:
    """Rename an element, in its start and its end tag."""
    text = tag._text[tag.start : tag.close_end]
    text = f"<{new}{text[1 + len(tag.name) :]}"
    if tag.close is not None:
        text = f"{text[: -len(tag.name) - 1]}{new}>"
    start_tag = (tag.start, tag.start + 1)
    return Mutant(file, tag.start, tag.close_end, text, start_tag, _around(tag), (new,))


def match(file: str, found: re.Match[str], new: str, group: int = 0, **more: object) -> Mutant:
    """Replace a group of a match."""
    return Mutant(file, found.start(group), found.end(group), new, **more)  # type: ignore[arg-type]


def placed(mutants: Iterator[Mutant], **more: object) -> Iterator[Mutant]:
    """Yield mutants with other attributes."""
    for mutant in mutants:
        yield replace(mutant, **more)  # type: ignore[arg-type]
