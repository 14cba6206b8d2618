"""Features of one document or of the workspace: symbols, folding, formatting, semantic tokens, inlay hints."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

from lsprotocol import types

from urdfkit.cli.lsp.positions import offset_of, path_of, position_of
from urdfkit.description.xml.reader import read_source
from urdfkit.errors import UrdfkitError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.cli.lsp.session import EditorSession
    from urdfkit.description.xml.source import Source
    from urdfkit.lint.editor.outline import Symbol
    from urdfkit.lint.model.tags import Document

MAX_SYMBOLS = 1000
"""Maximum number of symbols in the answer to a search in the workspace."""

_KINDS = {
    "robot": types.SymbolKind.Module,
    "link": types.SymbolKind.Object,
    "joint": types.SymbolKind.Interface,
    "material": types.SymbolKind.Constant,
    "macro": types.SymbolKind.Function,
    "property": types.SymbolKind.Variable,
    "argument": types.SymbolKind.Property,
    "call": types.SymbolKind.Event,
    "include": types.SymbolKind.File,
    "plugin": types.SymbolKind.Class,
    "sensor": types.SymbolKind.Class,
}


class DocumentFeatures:
    """Requests on the text of a document.

    Args:
        session: the session of the editor.
    """

    def __init__(self, session: EditorSession) -> None:
        self.session = session

    def symbols(self, uri: str) -> list[types.DocumentSymbol]:
        """Return the named elements of a document, as a tree."""
        from urdfkit.lint.editor.outline import outline

        document = self._document(uri)
        return [_symbol(document.source, one) for one in outline(document)] if document is not None else []

    def workspace_symbols(self, query: str) -> list[types.WorkspaceSymbol]:
        """Return the links, joints, macros and properties of all descriptions in the workspace that match a query."""
        from urdfkit.lint.editor.outline import matches, outline
        from urdfkit.lint.model.tags import Document
        from urdfkit.lint.project.description_files import walk

        found: list[types.WorkspaceSymbol] = []
        workspace = self.session.server.workspace
        roots = [path_of(uri) for uri in workspace.folders] or [path_of(workspace.root_uri or "")]
        files = dict.fromkeys(file for root in roots if root is not None for file in walk(root))
        for file in files:
            try:
                source = read_source(file, texts=self.session.project.texts)
            except UrdfkitError:
                continue
            for one in _walk(outline(Document(source))):
                if one.kind not in ("call", "include", "robot") and matches(one.name, query):
                    place = types.Location(file.as_uri(), _range(source, one.name_start, one.name_end))
                    found.append(types.WorkspaceSymbol(place, one.name, _KINDS[one.kind], container_name=file.name))
                    if len(found) == MAX_SYMBOLS:
                        return found
        return found

    def folds(self, uri: str) -> list[types.FoldingRange]:
        """Return the ranges of a document that can be folded."""
        from urdfkit.lint.editor.outline import folds

        document = self._document(uri)
        found = folds(document) if document is not None else ()
        return [
            types.FoldingRange(first - 1, last - 1, kind=types.FoldingRangeKind(kind)) for first, last, kind in found
        ]

    def format(self, uri: str) -> list[types.TextEdit]:
        """Return the edits that format a document; none if it is not well-formed, which a finding reports."""
        from urdfkit.description.xml.formatting import formatted
        from urdfkit.lint.engine.settings import find

        document, path = self._document(uri), path_of(uri)
        if document is None or path is None:
            return []
        source = document.source
        try:
            after = formatted(source, indent=find(path).indent)
        except UrdfkitError:
            return []
        old, new = source.text.splitlines(keepends=True), after.splitlines(keepends=True)
        offsets = [0]
        for line in old:
            offsets.append(offsets[-1] + len(line))
        matcher = difflib.SequenceMatcher(None, old, new, autojunk=False)
        return [
            types.TextEdit(_range(source, offsets[i1], offsets[i2]), "".join(new[j1:j2]))
            for kind, i1, i2, j1, j2 in matcher.get_opcodes()
            if kind != "equal"
        ]

    def tokens(self, uri: str) -> types.SemanticTokens:
        """Return the semantic tokens of a document."""
        from urdfkit.lint.editor.semantic_tokens import TYPES, semantic_tokens

        found = self.session.analysed(uri)
        data: list[int] = []
        if found is None:
            return types.SemanticTokens(data)
        source = found[1].source
        line = column = 0
        for start, length, kind in semantic_tokens(*found):
            begin, end = position_of(source, start), position_of(source, start + length)
            moved = begin.line - line
            data += [moved, begin.character - (0 if moved else column), end.character - begin.character]
            data += [TYPES.index(kind), 0]
            line, column = begin.line, begin.character
        return types.SemanticTokens(data)

    def hints(self, uri: str, within: types.Range) -> list[types.InlayHint]:
        """Return the values of expressions and the masses of links in a range of a document."""
        from urdfkit.lint.editor.inlay_hints import inlay_hints

        found, path = self.session.analysed(uri), path_of(uri)
        if found is None or path is None:
            return []
        model, document = found
        start, end = offset_of(document.source, within.start), offset_of(document.source, within.end)
        entry, project = model.expanded.path, self.session.project
        hints = inlay_hints(model, document, start, end, lambda probes: project.probe_all(entry, path, probes))
        return [
            types.InlayHint(position_of(document.source, offset), text, padding_left=True)
            for offset, text in sorted(hints)
        ]

    def _document(self, uri: str) -> Document | None:
        from urdfkit.lint.model.tags import Document

        path = self.session.update(uri)
        return Document(self.session.source(path)) if path is not None else None


def _symbol(source: Source, one: Symbol) -> types.DocumentSymbol:
    return types.DocumentSymbol(
        one.name,
        _KINDS[one.kind],
        _range(source, one.start, one.end),
        _range(source, one.name_start, one.name_end),
        detail=one.detail or None,
        children=[_symbol(source, child) for child in one.children],
    )


def _walk(symbols: list[Symbol] | tuple[Symbol, ...]) -> Iterator[Symbol]:
    for one in symbols:
        yield one
        yield from _walk(tuple(one.children))


def _range(source: Source, start: int, end: int) -> types.Range:
    return types.Range(position_of(source, start), position_of(source, end))
