"""Session of one editor: diagnostics, hover, navigation, renaming and completion for the files of a project."""

from __future__ import annotations

import asyncio
import gc
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lsprotocol import types

from urdfkit.cli.lsp.positions import diagnostic, failure, offset_of, path_of, position_of, range_of
from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.errors import UrdfkitError

if TYPE_CHECKING:
    from pygls.lsp.server import LanguageServer

    from urdfkit.description.xml.source import Source, Span
    from urdfkit.lint.editor.cursor import Cursor
    from urdfkit.lint.editor.open_files import Project
    from urdfkit.lint.finding import Edit
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Document

PAUSE = 0.005
"""Seconds without a change before a text is checked: key presses in quick succession count once."""

IDLE = 1.0
"""Seconds without a key press after which garbage is collected: reference cycles of outdated trees."""

MAX_CHECKS = 100
"""Number of checks after which garbage is collected without waiting."""

_KINDS = {
    "element": types.CompletionItemKind.Class,
    "attribute": types.CompletionItemKind.Property,
    "name": types.CompletionItemKind.Reference,
    "value": types.CompletionItemKind.EnumMember,
    "file": types.CompletionItemKind.File,
    "parameter": types.CompletionItemKind.Field,
}


class EditorSession:
    """Requests of one editor, in the units of the protocol: URIs, lines from 0, columns in UTF-16.

    Args:
        server: the connection to the editor.
        project: the files and their analyses.
    """

    def __init__(self, server: LanguageServer, project: Project) -> None:
        self.server, self.project = server, project
        self._waiting: dict[str, asyncio.TimerHandle] = {}
        self._published: set[str] = set()
        self._collection: asyncio.TimerHandle | None = None
        self._checks = 0

    def load_rules(self) -> None:
        """Load the modules of the linter by linting a bundled robot, before the first document is opened."""
        from urdfkit.lint.editor.open_files import Project
        from urdfkit.resources import find_model

        Project(self.project.options).findings(find_model(["heterogeneous"]).path)

    def changed(self, uri: str) -> None:
        """Read the text of a document; publish its findings when no change follows within `PAUSE`."""
        if self.update(uri) is None:
            return
        if uri in self._waiting:
            self._waiting[uri].cancel()
        self._waiting[uri] = asyncio.get_running_loop().call_later(PAUSE, self._publish, uri)

    def closed(self, uri: str) -> None:
        """Use the file on disk again."""
        path = path_of(uri)
        if (timer := self._waiting.pop(uri, None)) is not None:
            timer.cancel()
        if path is not None:
            self.project.set_text(path, None)
            self._show(uri, [])
            self.publish_all()

    def publish_all(self) -> None:
        """Publish the findings of every open document."""
        for text in list(self.project.texts):
            self._publish(Path(text).as_uri())

    def _publish(self, uri: str) -> None:
        self._waiting.pop(uri, None)
        path = path_of(uri)
        if path is None or str(path) not in self.project.texts:
            return
        self._schedule_collection()
        for file, findings in self.project.findings(path).items():
            its = uri if file == path else file.as_uri()
            source = self.source(file)
            shown = [diagnostic(finding, source) for finding in findings if finding.file == source.file]
            if file == path:
                shown += map(failure, self.project.failures(path))
            self._show(its, shown)

    def _schedule_collection(self) -> None:
        """Collect cyclic garbage while the user does not type: during typing it would delay the findings."""
        self._checks += 1
        if self._collection is not None:
            self._collection.cancel()
        self._collection = asyncio.get_running_loop().call_later(
            0.0 if self._checks > MAX_CHECKS else IDLE, self._collect_garbage
        )

    def _collect_garbage(self) -> None:
        self._collection, self._checks = None, 0
        gc.collect()

    def _show(self, uri: str, diagnostics: list[types.Diagnostic]) -> None:
        is_open = path_of(uri) is not None and str(path_of(uri)) in self.project.texts
        if diagnostics or uri in self._published or is_open:
            document = self.server.workspace.text_documents.get(uri)
            version = document.version if document is not None else None
            if diagnostics:
                self._published.add(uri)
            self.server.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, diagnostics, version))

    def source(self, file: Path) -> Source:
        """Return the current text of a file."""
        return read_source(file, shown_as=shown_path(file), texts=self.project.texts)

    def update(self, uri: str) -> Path | None:
        """Return the file of a URI after reading its text from the editor, or from disk where it is not open.

        Returns:
            None for a URI that is not a file, a file that neither is open nor exists, or a folder.
        """
        path = path_of(uri)
        if path is None or path.is_dir():
            return None
        opened = self.server.workspace.text_documents.get(uri)
        if opened is not None:
            self.project.set_text(path, opened.source)
        return path if opened is not None or path.is_file() else None

    def _at(self, uri: str, position: types.Position) -> tuple[list[Model], Cursor, Path] | None:
        """Return the models that a document belongs to, at least one; None if it cannot be read."""
        from urdfkit.lint.editor.cursor import Cursor

        path = self.update(uri)
        if path is None:
            return None
        models = [analysis.model for analysis in self.project.analyses(path) if analysis.model is not None]
        for model in models:
            document = model.document(shown_path(path))
            if document.source.text or len(models) == 1:
                return models, Cursor(document, offset_of(document.source, position)), path
        return None

    def analysed(self, uri: str) -> tuple[Model, Document] | None:
        """Return the model that a document belongs to, and the document; None if it cannot be read."""
        found = self._at(uri, types.Position(0, 0))
        return (found[0][0], found[1].document) if found is not None else None

    def hover(self, uri: str, position: types.Position) -> types.Hover | None:
        """Return the documentation of the element or name at a position."""
        from urdfkit.lint.editor.hover import hover

        found = self._at(uri, position)
        if found is None:
            return None
        (model, *_), cursor, path = found
        findings = self.project.findings(path)[path]
        entry = model.expanded.path
        pieces = hover(model, cursor, findings, lambda at, text: self.project.probe(entry, path, at, text))
        if not pieces:
            return None
        return types.Hover(types.MarkupContent(types.MarkupKind.Markdown, "\n\n---\n\n".join(pieces)))

    def definition(self, uri: str, position: types.Position) -> list[types.Location]:
        """Return the definition of the name at a position, or the file that the position names."""
        from urdfkit.lint.editor.navigation import definitions, file_at

        found = self._at(uri, position)
        if found is None:
            return []
        spans: dict[Span, None] = {}
        for model in found[0]:
            if (file := file_at(model, found[1])) is not None:
                start = types.Position(0, 0)
                return [types.Location(file.as_uri(), types.Range(start, start))]
            spans.update(dict.fromkeys(definitions(model, found[1])))
        return self._locations(spans)

    def references(self, uri: str, position: types.Position, *, with_definition: bool) -> list[types.Location]:
        """Return every reference to the name at a position."""
        from urdfkit.lint.editor.navigation import references

        found = self._at(uri, position)
        if found is None:
            return []
        return self._locations(references(found[0], found[1], with_definition=with_definition))

    def renamable(self, uri: str, position: types.Position) -> types.PrepareRenamePlaceholder | None:
        """Return the text under the cursor that can be renamed, and the name that it stands for."""
        from urdfkit.lint.editor.renaming import renamable

        found = self._at(uri, position)
        one = renamable(found[0][0], found[1]) if found is not None else None
        if found is None or one is None:
            return None
        return types.PrepareRenamePlaceholder(range_of(found[1].document.source, one[0]), one[1])

    def rename(self, uri: str, position: types.Position, name: str) -> types.WorkspaceEdit:
        """Return the edits that rename the name at a position."""
        from pygls.exceptions import JsonRpcInvalidParams

        from urdfkit.lint.editor.renaming import rename

        found = self._at(uri, position)
        if found is None:
            raise JsonRpcInvalidParams("no robot description to rename in")
        try:
            return self._edit(rename(found[0], found[1], name, self.project.expanded_with))
        except UrdfkitError as error:
            raise JsonRpcInvalidParams(str(error)) from None

    def completion(self, uri: str, position: types.Position) -> list[types.CompletionItem]:
        """Return the completions at a position."""
        from urdfkit.lint.editor.completion import fits

        found = self._at(uri, position)
        if found is None:
            return []
        models, cursor, path = found
        readable = (each.last_readable for each in self.project.analyses(path) if each.model is models[0])
        model = next(readable) or models[0]
        items: dict[tuple[str, str], types.CompletionItem] = {}
        for fit in fits(model, cursor):
            start = position_of(cursor.document.source, cursor.offset - fit.typed)
            edit = types.TextEdit(types.Range(start, position), fit.label)
            items.setdefault(
                (fit.label, fit.detail),
                types.CompletionItem(fit.label, kind=_KINDS[fit.kind], detail=fit.detail or None, text_edit=edit),
            )
        return list(items.values())

    def actions(self, uri: str, within: types.Range) -> list[types.CodeAction]:
        """Return the fixes of the findings in a range."""
        path = self.update(uri)
        if path is None:
            return []
        source = self.source(path)
        found = []
        for finding in self.project.findings(path)[path]:
            shown = diagnostic(finding, source)
            span = shown.range
            if finding.fix is None or span.end < within.start or within.end < span.start:
                continue
            guess = "" if finding.fix.safety == "safe" else " (a guess)"
            found.append(
                types.CodeAction(
                    f"{finding.fix.title}{guess} [{finding.code}]",
                    kind=types.CodeActionKind.QuickFix,
                    diagnostics=[shown],
                    is_preferred=finding.fix.safety == "safe",
                    edit=self._edit(finding.fix.edits),
                )
            )
        return found

    def _locations(self, spans: Iterable[Span]) -> list[types.Location]:
        found = []
        for span in spans:
            file = Path.cwd() / span.file
            found.append(types.Location(file.as_uri(), range_of(self.source(file), span)))
        return found

    def _edit(self, edits: Iterable[Edit]) -> types.WorkspaceEdit:
        changes: dict[str, list[Any]] = {}
        for edit in edits:
            file = Path.cwd() / edit.span.file
            change = types.TextEdit(range_of(self.source(file), edit.span), edit.text)
            changes.setdefault(file.as_uri(), []).append(change)
        return types.WorkspaceEdit(changes=changes)
