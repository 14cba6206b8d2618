"""Symbols: the named entities in the files of a model, with their definitions and references.

Links, joints and materials are collected after expansion: a name made of ``${prefix}_wheel`` leads to the line in the
macro. Macros, properties and arguments are collected from the source text.
"""

import re
from collections.abc import Iterator

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Expansion, Source, Span
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record

EXPANDED = ("link", "joint", "material")
"""Kinds of symbols that are collected after expansion."""

REFERENCES = {
    ("parent", "link"): "link",
    ("child", "link"): "link",
    ("mimic", "joint"): "joint",
    ("gazebo", "reference"): "part",
    ("joint", "name"): "joint",
    ("material", "name"): "material",
}
"""Element and attribute → kind of the named symbol; ``part`` is a link or a joint."""


@record
class Occurrence:
    """One occurrence of a symbol.

    Attributes:
        kind: ``link``, ``joint``, ``material``, ``macro``, ``property``, ``argument`` or ``file``.
        name: name of the symbol after expansion.
        span: the name in the source, or the expression that computes the name.
        defines: whether the occurrence is the definition.
        written: the source text.
        calls: the macro calls that produced it, innermost first.
    """

    kind: str
    name: str
    span: Span
    defines: bool
    written: str
    calls: tuple[Expansion, ...] = ()


def of_model(model: Model) -> list[Occurrence]:
    """Return all occurrences of symbols in the files of a model."""
    found = dict.fromkeys(expanded_occurrences(model))
    macros = set(model.expanded.macros)
    for file in model.expanded.sources:
        found.update(dict.fromkeys(written_occurrences(model.document(file), macros)))
    return list(found)


def in_settings(model: Model) -> Iterator[Occurrence]:
    """Yield the links and joints named in YAML files of the package and of related packages."""
    from urdfkit.lint.facts.control.controller_joints import joints
    from urdfkit.lint.facts.control.launch_package_paths import uncommented

    def occurrence(source: Source, kind: str, written: str, start: int) -> Occurrence:
        name = written.rpartition("/")[2]
        start += len(written) - len(name)
        return Occurrence(kind, name, source.span(start, start + len(name)), False, name)

    for source in model.related_files.values():
        if source.file.endswith((".yaml", ".yml")):
            for named in joints(source):
                yield occurrence(source, "joint", named.name, named.start)
            for at in re.finditer(_FRAME, uncommented(source)):
                yield occurrence(source, "link", at[2], at.start(2))


def expanded_occurrences(model: Model) -> Iterator[Occurrence]:
    """Yield the links, joints and materials of the expanded robot; an element for each of its expansions."""
    root = model.expanded.root
    if root is None:
        return
    robot = model.robot
    pending: list[tuple[Element, bool]] = [(child, True) for child in root.children]
    while pending:
        element, is_top = pending.pop()
        is_visual = element.tag in ("link", "visual")
        pending += [(child, False) for child in element.children] if element.children else []
        name = element.get("name")
        if is_top and element.tag in ("link", "joint") and name:
            yield from _at(model, element, "name", element.tag, name, defines=True)
            continue
        if element.tag == "material" and name and (is_top or not is_visual):
            defines = any(child.tag in ("color", "texture") for child in element.children)
            yield from _at(model, element, "name", "material", name, defines=defines)
            continue
        for (tag, attribute), kind in REFERENCES.items():
            value = element.get(attribute) if element.tag == tag and tag != "material" else None
            if value:
                named = "joint" if kind == "part" and value not in robot.link_by_name else kind
                yield from _at(model, element, attribute, "link" if named == "part" else named, value)
    if robot.gazebo:
        from urdfkit.lint.facts.gazebo.plugins import references

        for text, element, parameter, _ in references(model, ("joint", "link", "frame")):
            kind = "joint" if parameter.names == "joint" else "link"
            yield from _text(model, element, kind, text)


def _at(
    model: Model, element: Element, attribute: str, kind: str, name: str, *, defines: bool = False
) -> Iterator[Occurrence]:
    position = element.origin.position
    tag = model.tag(position)
    written = tag.attributes.get(attribute) if tag is not None else None
    if written is not None:
        span = model.document(position.file).source.span(written.value_start, written.value_end)
        yield Occurrence(kind, name, span, defines, written.value, element.origin.expansions)


def _text(model: Model, element: Element, kind: str, name: str) -> Iterator[Occurrence]:
    position = element.origin.position
    tag = model.tag(position)
    if tag is None or tag.close is None or tag.children:
        return
    source = model.document(position.file).source
    text = source.text[tag.end : tag.close]
    start = tag.end + (text.find(name) if name in text else len(text) - len(text.lstrip()))
    end = start + (len(name) if name in text else len(text.strip()))
    yield Occurrence(kind, name, source.span(start, end), False, source.text[start:end], element.origin.expansions)


def written_occurrences(document: Document, macros: set[str]) -> Iterator[Occurrence]:
    """Yield the macros, properties, arguments and included files in the text of a file.

    Args:
        document: the file.
        macros: names of the macros of the model.
    """
    source = document.source

    def occurrence(kind: str, name: str, start: int, *, defines: bool = False) -> Occurrence:
        return Occurrence(kind, name, source.span(start, start + len(name)), defines, name)

    for tag in document.walk():
        plain = tag.name.removeprefix("xacro:")
        attributes = tag.attributes
        named = attributes.get("name")
        kind = {"macro": "macro", "property": "property", "arg": "argument"}.get(plain)
        if kind is not None and named is not None and tag.name.startswith("xacro:"):
            name = named.value.removeprefix("xacro:")
            yield occurrence(kind, name, named.value_end - len(name), defines=True)
        elif plain in macros and (tag.name.startswith("xacro:") or tag.name not in _URDF):
            yield occurrence("macro", plain, tag.start + 1 + len(tag.name) - len(plain))
            if tag.close is not None:
                yield occurrence("macro", plain, tag.close + 2 + len(tag.name) - len(plain))
        if plain == "include" and "filename" in attributes:
            written = attributes["filename"]
            span = source.span(written.value_start, written.value_end)
            yield Occurrence("file", written.value, span, False, written.value)
    comments = document.comments
    for found in re.finditer(r"\$\{([^{}]*)\}|\$\((arg|eval)\s+([^()]*)\)", source.text):
        if any(start <= found.start() < end for start, end, _ in comments):
            continue
        if found[2] == "arg":
            yield occurrence("argument", found[3].strip(), found.start(3))
            continue
        group = 1 if found[1] is not None else 3
        for word in re.finditer(r"(?<![\w.'\"])[A-Za-z_]\w*(?![\w'\"(])", found[group]):
            if word[0] not in _PYTHON:
                yield occurrence("property", word[0], found.start(group) + word.start())


_FRAME = r"(?m)^[ \t]*\w*(?:frame|frame_id|link|links)[ \t]*:[ \t]*[\"']?([\w./-]*/)?([\w.-]+)[\"']?[ \t]*\r?$"
"""YAML settings whose value is a frame."""

_URDF = frozenset(("link", "joint", "material", "origin", "visual", "collision", "inertial", "gazebo", "transmission"))
_PYTHON = frozenset(
    ("and", "or", "not", "if", "else", "in", "is", "for", "lambda", "True", "False", "None", "pi", "e", "xacro", "math")
)


def parameters_around(tag: Tag | None) -> dict[str, tuple[int, int]]:
    """Return the parameters of the macros that enclose a tag: name → start and end offset."""
    found: dict[str, tuple[int, int]] = {}
    above = [tag, *tag.ancestors()] if tag is not None else []
    for outer in above:
        params = outer.attributes.get("params") if outer.name.removeprefix("xacro:") == "macro" else None
        for word in re.finditer(r"(?:^|\s)\**([^\s:=,;*]+)", params.value) if params is not None else ():
            start = params.value_start + word.start(1) if params is not None else 0
            found.setdefault(word[1], (start, start + len(word[1])))
    return found
