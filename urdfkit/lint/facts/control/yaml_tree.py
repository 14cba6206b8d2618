"""YAML syntax tree with source positions: mappings, lists and scalars; no Python objects are constructed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.model.model import Model
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_MAX_NODES = 20_000
_MAX_DEPTH = 12
_DEEP = r"(?:[\[{]\s*){200}"
"""Matches brackets that are nested more deeply than in any file of parameters; PyYAML reads many of them slowly."""


@record(eq=False)
class Node:
    """Node of a YAML document.

    Attributes:
        kind: ``group`` (a mapping), ``list`` or ``text`` (a scalar).
        text: text of a scalar; empty for other nodes.
        entries: keys and values of a mapping.
        items: items of a list.
        line: line of the start of the node, from 1.
        column: column of the start of the node, from 1.
        is_plain: whether the node is a scalar without quotes and not a block scalar.
    """

    kind: str
    text: str
    entries: tuple[tuple[Node, Node], ...]
    items: tuple[Node, ...]
    line: int
    column: int
    is_plain: bool = False

    def find(self, name: str) -> Node | None:
        """Return the value of a key in a mapping; None if the key is missing."""
        for key, value in self.entries:
            if key.text == name:
                return value
        return None

    @property
    def last_name(self) -> str:
        """The last part of a name with a namespace: ``node`` of ``/robot/node``."""
        return self.text.strip("/").rpartition("/")[2]

    @property
    def class_name(self) -> str:
        """The name of a plugin's class without its package: ``Class`` of ``package::Class`` and ``package/Class``."""
        return self.text.replace("/", "::").rpartition("::")[2]

    def texts(self) -> list[str]:
        """Return the non-empty scalars among the node and its list items."""
        return [node.text for node in (self, *self.items) if node.kind == "text" and node.text]


@record(eq=False)
class Broken:
    """Line and column of a YAML syntax error, from 1, and the reason."""

    line: int
    column: int
    why: str


def yamls(model: Model) -> Iterator[Source]:
    """Yield the YAML files of the model's package and of related packages."""
    yield from (source for name, source in model.related_files.items() if name.endswith((".yaml", ".yml")))


def yamls_of_robot(model: Model) -> Iterator[Source]:
    """Yield these files without parameters that only another robot of a family loads.

    The plugins of this robot load other files, and another description names the left-out files.
    """
    blocks = (plugin.element for block in model.robot.gazebo for plugin in block.plugins)
    loaded = {each.text.rpartition("/")[2].strip() for one in blocks for each in one.find_all("parameters")}
    for source in yamls(model):
        name = source.file.rpartition("/")[2]
        if not loaded or name in loaded or not model.neighbouring_descriptions.mention(f"/{name}"):
            yield source


def documents(source: Source) -> tuple[Node, ...]:
    """Return the documents of a YAML file, up to the first syntax error."""
    return documents_in(source.text)[0]


def syntax_error(source: Source) -> Broken | None:
    """Return the first syntax error of a YAML file; None if it has none."""
    return documents_in(source.text)[1]


def nodes(source: Source) -> tuple[Node, ...]:
    """Return every node of every document of a YAML file that is read as a value."""
    return _nodes_in(source.text)


@lru_cache(maxsize=100)
def _nodes_in(text: str) -> tuple[Node, ...]:
    return tuple(node for document in documents_in(text)[0] for node in walk(document))


_PROPERTIES = re.compile(r"(?:[&!]\S*[ \t]+)+(?=\S)")
"""Matches the anchor and the tag of a node in YAML."""


def start_of(source: Source, node: Node) -> int:
    """Return the start offset of a node; after the opening quote of a quoted scalar, and after anchor and tag."""
    start = source.offset(node.line, node.column)
    properties = _PROPERTIES.match(source.text, start)
    start = properties.end() if properties is not None else start
    return start + (source.text[start : start + 1] in ("'", '"'))


def span_of(source: Source, node: Node) -> Span:
    """Return the span of a scalar on one line, without quotes; for other nodes, of the first character."""
    start = start_of(source, node)
    return source.span(start, start + max(len(node.text) if "\n" not in node.text else 1, 1))


def not_a_number(node: Node) -> str:
    """Return the description of a value that is not a number; empty for numbers and computed values."""
    if node.kind != "text":
        return "" if node.kind == "group" else "a list, not a number"
    try:
        float(node.text)
    except ValueError:
        # rad(…) and deg(…) are expressions of rosparam.
        is_number = re.fullmatch(r"[-+]?\.(inf|nan)|(rad|deg)\(.*\)", node.text, re.IGNORECASE)
        if is_number or "$" in node.text or not node.text:
            return ""
        return f"`{node.text}`, which is not a number"
    return "" if node.is_plain else f'"{node.text}", a quoted string'


def number_of(node: Node | None) -> float | None:
    """Return the number that a value is; None for other values, for `.inf` and for `.nan`."""
    try:
        return float(node.text) if node is not None else None
    except ValueError:
        return None


def walk(node: Node) -> Iterator[Node]:
    """Yield a node and all nodes below it."""
    waiting = [(node, 0)]
    while waiting:
        node, depth = waiting.pop()
        yield node
        if depth < _MAX_DEPTH:
            waiting += [(item, depth + 1) for item in reversed(node.items)]
            waiting += [(value, depth + 1) for _, value in reversed(node.entries)]


def groups(node: Node, name: str = "") -> Iterator[tuple[str, Node]]:
    """Yield a node and the values below it with their names; ``ros__parameters`` has the name of its ROS node."""
    waiting = [(name, node, 0)]
    while waiting:
        name, node, depth = waiting.pop()
        yield name, node
        for key, value in reversed(node.entries) if depth < 4 else ():
            called = name if key.text == "ros__parameters" else key.last_name
            waiting.append((called, value, depth + 1))


@lru_cache(maxsize=400)
def documents_in(text: str) -> tuple[tuple[Node, ...], Broken | None]:
    """Return the documents of a YAML text up to the first syntax error, and the error or None."""
    import yaml

    from urdfkit.description.control.parameter_yaml import loader_of

    found: list[Node] = []
    deep = re.search(_DEEP, text)
    if deep is not None:
        line = text.count("\n", 0, deep.start()) + 1
        return (), Broken(line, deep.start() - text.rfind("\n", 0, deep.start()), "nested too deeply")
    try:
        for document in yaml.compose_all(str(text), Loader=loader_of(text)):  # LibYAML refuses subclasses
            found.append(_Reader().node(document, 0))
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        why = error.problem or error.context or "invalid YAML"
        return tuple(found), Broken(mark.line + 1 if mark else 1, mark.column + 1 if mark else 1, why)
    except _TooManyAliasesError as error:
        return tuple(found), Broken(*error.place, "nested too deeply, or too many aliases")
    except RecursionError:
        return tuple(found), Broken(1, 1, "nested too deeply")
    except yaml.YAMLError as error:
        return tuple(found), Broken(1, 1, " ".join(str(error).split())[:200] or "invalid YAML")
    return tuple(found), None


class _TooManyAliasesError(Exception):
    """Aliases repeat a document more often than it has nodes.

    Args:
        place: line and column of the last node that is written out.
    """

    def __init__(self, place: tuple[int, int]) -> None:
        super().__init__()
        self.place = place


class _Reader:
    """Convert PyYAML nodes to `Node`; the number of nodes is bounded, because aliases are followed."""

    def __init__(self) -> None:
        self._count = 0
        self._seen: dict[int, int] = {}
        self._last = (1, 1)

    def node(self, written: Any, depth: int) -> Node:
        self._count += 1
        place = (written.start_mark.line + 1, written.start_mark.column + 1)
        times = self._seen[id(written)] = self._seen.get(id(written), 0) + 1
        if times == 1:
            self._last = place
        elif self._count > _MAX_NODES and len(self._seen) * 4 < self._count:
            raise _TooManyAliasesError(self._last)
        if depth > _MAX_DEPTH or self._count > _MAX_NODES:
            return Node("text", "", (), (), *place)
        if written.id == "mapping":
            entries = ((self.node(key, depth + 1), self.node(value, depth + 1)) for key, value in written.value)
            return Node("group", "", tuple(entries), (), *place)
        if written.id == "sequence":
            return Node("list", "", (), tuple(self.node(item, depth + 1) for item in written.value), *place)
        return Node("text", str(written.value), (), (), *place, not written.style)
