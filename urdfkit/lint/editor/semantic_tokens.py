"""Semantic tokens: kinds of the names of xacro in a file, which the syntax of XML does not show."""

import re

from urdfkit.lint.editor.symbol_occurrences import parameters_around, written_occurrences
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag

TYPES = ("keyword", "macro", "variable", "parameter")
"""Types of the protocol that are used: directives, macros, properties, and parameters of macros or arguments."""

_DIRECTIVES = ["macro", "property", "include", "arg", "if", "unless", "insert_block", "call", "element", "attribute"]
_KINDS = {"macro": "macro", "property": "variable", "argument": "parameter"}


def semantic_tokens(model: Model, document: Document) -> list[tuple[int, int, str]]:
    """Return start offset, length and type of each token of a file, by offset and without overlaps."""
    found: dict[int, tuple[int, str]] = {}
    source = document.source
    macros = set(model.expanded.macros)
    for tag in document.walk():
        if tag.name.startswith("xacro:") and tag.name[6:] in _DIRECTIVES:
            found[tag.start + 1] = len(tag.name), "keyword"
            if tag.close is not None:
                found[tag.close + 2] = len(tag.name), "keyword"
        if tag.name == "xacro:macro":
            for start, end in parameters_around(tag).values():
                found.setdefault(start, (end - start, "parameter"))
    for one in written_occurrences(document, macros):
        kind = _KINDS.get(one.kind)
        if kind is None:
            continue
        start = source.offset(one.span.line, one.span.column)
        if one.kind == "property" and not one.defines and one.name in parameters_around(_tag_at(document, start)):
            kind = "parameter"
        found[start] = len(one.written), kind
    tokens: list[tuple[int, int, str]] = []
    for start, (length, kind) in sorted(found.items()):
        if not tokens or start >= tokens[-1][0] + tokens[-1][1]:
            tokens.append((start, length, kind))
    return [token for token in tokens if not re.search(r"[\r\n]", source.text[token[0] : token[0] + token[1]])]


def _tag_at(document: Document, offset: int) -> Tag | None:
    from urdfkit.lint.editor.cursor import Cursor

    return Cursor(document, offset).tag
