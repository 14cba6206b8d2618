"""``urdfkit lsp``: a language server for URDF and xacro, on standard input and output.

Requests of an editor go in; diagnostics, hovers, completions and edits of `urdfkit.lint.editor` come out.
"""

from __future__ import annotations

import argparse
import gc
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.cli.parser import add_package_path, add_time_limit
from urdfkit.errors import MissingDependencyError

if TYPE_CHECKING:
    from collections.abc import Callable

    from pygls.lsp.server import LanguageServer

    from urdfkit.lint.project.options import Options


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.epilog = "examples:\n  urdfkit lsp\n  urdfkit lsp --target ros2"
    parser.add_argument(
        "--target",
        metavar="NAME",
        help="program that reads the robot, as for `urdfkit lint` (default: guessed from package.xml)",
    )
    add_package_path(parser)
    add_time_limit(parser)
    parser.add_argument("--stdio", action="store_true", help="use standard input and output (the default)")


def run(arguments: argparse.Namespace) -> int:
    """Serve until the editor closes the connection.

    Raises:
        MissingDependencyError: pygls is not installed.
        UsageError: the target is unknown, or a setting is invalid.
    """
    try:
        import pygls.lsp.server  # noqa: F401
    except ImportError as error:
        raise MissingDependencyError("lsp needs pygls: pip install 'urdfkit[lsp]'") from error
    from urdfkit.cli.lsp.rejected_requests import log_in_one_line

    if not arguments.verbose:
        log_in_one_line()
    gc.disable()  # see Session
    server_for(_options(arguments)).start_io()
    return 0


def _options(arguments: argparse.Namespace) -> Options:
    from urdfkit.lint.engine.settings import find
    from urdfkit.lint.project.options import Options
    from urdfkit.lint.project.target_platform import parse_target

    settings = find(Path.cwd())
    target = arguments.target or settings.target
    named = None if target == "any" else parse_target(target)
    folders = (*map(Path, arguments.package_path), *settings.package_path)
    return Options(
        settings.select,
        settings.ignore,
        named,
        settings.arguments,
        folders,
        guess_target=target is None,
        time_limit=arguments.time_limit,
    )


def server_for(options: Options) -> LanguageServer:
    """Return the server, ready to be started."""
    from lsprotocol import types
    from pygls.lsp.server import LanguageServer

    from urdfkit import __version__
    from urdfkit.cli.lsp.document_features import DocumentFeatures
    from urdfkit.cli.lsp.rejected_requests import Protocol
    from urdfkit.cli.lsp.session import EditorSession
    from urdfkit.lint.editor.open_files import Project
    from urdfkit.lint.editor.semantic_tokens import TYPES

    kind = types.TextDocumentSyncKind.Incremental
    server = LanguageServer("urdfkit", __version__, text_document_sync_kind=kind, protocol_cls=Protocol)
    session = EditorSession(server, Project(options))
    features = DocumentFeatures(session)

    @server.feature(types.INITIALIZED)
    def initialized(_: types.InitializedParams) -> None:
        session.load_rules()

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: types.DidSaveTextDocumentParams) -> None:
        session.project.forget()
        session.changed(params.text_document.uri)

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def watched(_: types.DidChangeWatchedFilesParams) -> None:
        session.project.forget()
        session.publish_all()

    @server.feature(types.TEXT_DOCUMENT_REFERENCES)
    def references(params: types.ReferenceParams) -> list[types.Location]:
        own = params.context.include_declaration
        return session.references(params.text_document.uri, params.position, with_definition=own)

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    def rename(params: types.RenameParams) -> types.WorkspaceEdit:
        return session.rename(params.text_document.uri, params.position, params.new_name)

    @server.feature(types.WORKSPACE_SYMBOL)
    def workspace_symbols(params: types.WorkspaceSymbolParams) -> list[types.WorkspaceSymbol]:
        return features.workspace_symbols(params.query)

    def answer(request: str, by: Callable[..., Any], *fields: str, options: Any = None) -> None:
        """Answer a request by a method of its document and further fields of its parameters."""
        server.feature(request, options)(
            lambda params: by(params.text_document.uri, *(getattr(params, field) for field in fields))
        )

    triggers = types.CompletionOptions(trigger_characters=["<", '"', "'", " ", "{", "/", ":"])
    fixes = types.CodeActionOptions(code_action_kinds=[types.CodeActionKind.QuickFix])
    answer(types.TEXT_DOCUMENT_DID_OPEN, session.changed)
    answer(types.TEXT_DOCUMENT_DID_CHANGE, session.changed)
    answer(types.TEXT_DOCUMENT_DID_CLOSE, session.closed)
    answer(types.TEXT_DOCUMENT_HOVER, session.hover, "position")
    answer(types.TEXT_DOCUMENT_DEFINITION, session.definition, "position")
    answer(types.TEXT_DOCUMENT_PREPARE_RENAME, session.renamable, "position")
    answer(types.TEXT_DOCUMENT_COMPLETION, session.completion, "position", options=triggers)
    answer(types.TEXT_DOCUMENT_CODE_ACTION, session.actions, "range", options=fixes)
    answer(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL, features.symbols)
    answer(types.TEXT_DOCUMENT_FOLDING_RANGE, features.folds)
    answer(types.TEXT_DOCUMENT_FORMATTING, features.format)
    legend = types.SemanticTokensLegend(TYPES, ())
    answer(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, features.tokens, options=legend)
    answer(types.TEXT_DOCUMENT_INLAY_HINT, features.hints, "range")
    return server
