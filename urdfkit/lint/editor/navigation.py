"""Definitions and references of symbols."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path

from urdfkit.description.packages.existence import is_file
from urdfkit.lint.editor.launch_occurrences import in_launch_files
from urdfkit.lint.editor.rviz_occurrences import in_rviz_files
from urdfkit.lint.editor.srdf_occurrences import in_srdf_files
from urdfkit.lint.editor.symbol_occurrences import EXPANDED, in_settings, of_model, parameters_around

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from urdfkit.description.xml.source import Source, Span
    from urdfkit.lint.editor.cursor import Cursor
    from urdfkit.lint.editor.symbol_occurrences import Occurrence
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Tag


def at(model: Model, cursor: Cursor) -> list[Occurrence]:
    """Return the symbols under the cursor; several if a macro is expanded several times."""
    source = cursor.document.source
    here = [o for o in of_model(model) if o.span.file == source.file and _holds(source, o.span, cursor.offset)]
    inner = [o for o in here if o.kind not in EXPANDED]  # in ${…}: the property, not the expanded name
    return inner or here


def definitions(model: Model, cursor: Cursor) -> list[Span]:
    """Return the definitions of the symbols under the cursor."""
    found: dict[Span, None] = {}
    source = cursor.document.source
    every = of_model(model)
    for one in at(model, cursor):
        if one.kind == "file":
            continue
        if one.kind == "property" and one.name in (parameters := parameters_around(cursor.tag)):
            found[source.span(*parameters[one.name])] = None
            continue
        for other in every:
            if other.defines and (other.kind, other.name) == (one.kind, one.name):
                found[other.span] = None
    return list(found)


def file_at(model: Model, cursor: Cursor) -> Path | None:
    """Return the included file or mesh file under the cursor."""
    from urdfkit.errors import ResourceError
    from urdfkit.lint.model.mesh_files import meshes, path_of

    tag, attribute = cursor.tag, cursor.attribute
    if tag is None or attribute is None or attribute.name != "filename":
        return None
    value = attribute.value
    if tag.name.removeprefix("xacro:") == "include":
        base = Path(cursor.document.source.file).absolute().parent
        try:
            value = re.sub(r"\$\(find ([^()]+)\)", lambda m: str(model.expanded.packages.find(m[1].strip())), value)
        except ResourceError:
            return None
        path = base / value
        if not is_file(path):
            path = model.expanded.packages.relocate(path) or path
        return path if "$" not in value and is_file(path) else None
    for mesh, element, _ in meshes(model.robot):
        if model.tag(element.origin.position) is tag:
            return path_of(mesh, model.expanded)
    return None


def references(models: Sequence[Model], cursor: Cursor, *, with_definition: bool = True) -> list[Span]:
    """Return all references to the symbol under the cursor, in all models that its file belongs to."""
    found: dict[Span, None] = {}
    if (parameter := parameter_at(cursor)) is not None:
        return sorted(of_parameter(models, cursor, *parameter, with_definition=with_definition))
    for model in models:
        wanted = {(one.kind, one.name) for one in at(model, cursor)}
        outside = (search(model) for search in (in_settings, in_launch_files, in_srdf_files, in_rviz_files))
        for other in (*of_model(model), *chain.from_iterable(outside)):
            if (other.kind, other.name) in wanted and (with_definition or not other.defines):
                found[other.span] = None
    return sorted(found)


def parameter_at(cursor: Cursor) -> tuple[str, Tag] | None:
    """Return the macro parameter under the cursor and its macro, in the declaration or in an expression."""
    attribute, word = cursor.attribute, cursor.word[0]
    if attribute is None or not word or not (cursor.expression or attribute.name == "params"):
        return None
    name = word.lstrip("*") if cursor.expression is None else word.partition(".")[0]
    for tag in [cursor.tag, *cursor.tag.ancestors()] if cursor.tag is not None else []:
        if tag.name.removeprefix("xacro:") == "macro" and name in parameters_around(tag):
            return name, tag
    return None


def of_parameter(
    models: Sequence[Model], cursor: Cursor, name: str, macro: Tag, *, with_definition: bool
) -> Iterator[Span]:
    """Yield the uses of a parameter in its macro, its arguments in calls, and its declaration."""
    source = cursor.document.source
    if with_definition:
        yield source.span(*parameters_around(macro)[name])
    called = macro.attributes["name"].value.removeprefix("xacro:") if "name" in macro.attributes else ""
    found: dict[Span, None] = {}
    for model in models:
        for one in of_model(model):
            start = source.offset(one.span.line, one.span.column)
            if (one.kind, one.name, one.span.file) == ("property", name, source.file):
                if macro.end <= start < macro.close_end:
                    found[one.span] = None
            elif (one.kind, one.name, one.defines) == ("macro", called, False):
                document = model.document(one.span.file)
                at = document.source.offset(one.span.line, one.span.column)
                tag = document.tag_at(one.span.line, one.span.column - (at - document.source.text.rfind("<", 0, at)))
                attribute = tag.attributes.get(name) if tag is not None else None
                if attribute is not None:
                    found[document.source.span(attribute.start, attribute.start + len(name))] = None
    yield from found


def _holds(source: Source, span: Span, offset: int) -> bool:
    return source.offset(span.line, span.column) <= offset <= source.offset(span.end_line, span.end_column)
