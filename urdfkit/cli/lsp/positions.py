"""Convert positions and findings to the Language Server Protocol: URIs, lines from 0, columns in UTF-16."""

from pathlib import Path
from urllib.parse import unquote, urlparse

from lsprotocol import types

from urdfkit.description.xml.source import Source, Span, absolute
from urdfkit.lint.finding import Finding


def path_of(uri: str) -> Path | None:
    """Return the file of a URI; None for any other URI, e.g. of an unsaved text or a web page, and for invalid URIs."""
    try:
        parsed = urlparse(uri)
    except ValueError:
        return None
    path = unquote(parsed.path)
    return absolute(path) if parsed.scheme == "file" and path.startswith("/") and "\0" not in path else None


def offset_of(source: Source, position: types.Position) -> int:
    """Return the offset of a position of the protocol, clamped to its line."""
    line = source.line(position.line + 1)
    units = 0
    for column, letter in enumerate(line):
        if units >= position.character:
            return source.offset(position.line + 1, column + 1)
        units += 2 if ord(letter) > 0xFFFF else 1
    return source.offset(position.line + 1, len(line) + 1)


def position_of(source: Source, offset: int) -> types.Position:
    """Return the position of an offset in the protocol: lines from 0, columns in UTF-16."""
    at = source.position(offset)
    line = source.line(at.line)[: at.column - 1]
    return types.Position(at.line - 1, sum(2 if ord(letter) > 0xFFFF else 1 for letter in line))


def range_of(source: Source, span: Span) -> types.Range:
    """Return a span as a range of the protocol."""
    start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
    return types.Range(position_of(source, start), position_of(source, end))


def diagnostic(finding: Finding, source: Source) -> types.Diagnostic:
    """Convert a finding to a diagnostic of the protocol."""
    severities = {
        "error": types.DiagnosticSeverity.Error,
        "warning": types.DiagnosticSeverity.Warning,
        "note": types.DiagnosticSeverity.Information,
    }
    text = f"{finding.message}\n{finding.help}" if finding.help else finding.message
    related = []
    for call in finding.expansions[:5]:
        at = types.Position(call.position.line - 1, call.position.column - 1)
        place = types.Location((Path.cwd() / call.position.file).as_uri(), types.Range(at, at))
        related.append(types.DiagnosticRelatedInformation(place, f"call of macro `{call.macro}`"))
    return types.Diagnostic(
        range_of(source, finding.span),
        text,
        severity=severities[finding.severity],
        code=finding.code,
        source="urdfkit",
        related_information=related or None,
    )


def failure(text: str) -> types.Diagnostic:
    """Return a diagnostic at the start of the file for an internal error."""
    start = types.Position(0, 0)
    return types.Diagnostic(types.Range(start, start), text, severity=types.DiagnosticSeverity.Error, source="urdfkit")
