"""Findings as SARIF 2.1.0, for GitHub code scanning and editors.

https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html; numbers in comments refer to its sections.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from urdfkit.description.xml.source import Position, Span
from urdfkit.lint.finding import Finding, Fix
from urdfkit.lint.rule import Rule

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
"""URL of the SARIF schema."""

_LEVELS = {"error": "error", "warning": "warning", "note": "note"}
_ROOT = "SRCROOT"


def as_sarif(findings: Sequence[Finding]) -> str:
    """Return one log with one run.

    Raises:
        ResourceError: a third-party rule cannot be imported.
    """
    import json

    from urdfkit import __version__
    from urdfkit.lint.catalogue import rules

    found = {finding.code for finding in findings}
    described = [rule for rule in rules() if rule.code in found]
    order = {rule.code: index for index, rule in enumerate(described)}
    run = {
        "tool": {
            "driver": {"name": "urdfkit", "semanticVersion": __version__, "rules": [_rule(rule) for rule in described]}
        },
        "originalUriBaseIds": {_ROOT: {"uri": f"{Path.cwd().as_uri()}/"}},
        "columnKind": "unicodeCodePoints",  # 3.14.27: columns count characters
        "results": [_result(finding, order) for finding in findings],
    }
    return json.dumps({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}, indent=1, ensure_ascii=False)


def _rule(rule: type[Rule]) -> dict[str, Any]:
    from urdfkit.lint.catalogue import address, page, title

    link = address(rule.code) if rule.__module__.startswith("urdfkit.") else ""
    return {
        "id": rule.code,
        "name": "".join(word.capitalize() for word in rule.name.split("-")),
        "shortDescription": {"text": title(rule)},
        "help": {"text": f"urdfkit rule {rule.code}", "markdown": page(rule)},
        **({"helpUri": link} if link else {}),
        "defaultConfiguration": {"level": _LEVELS[rule.severity]},
    }


def _result(finding: Finding, order: Mapping[str, int]) -> dict[str, Any]:
    result: dict[str, Any] = {
        "ruleId": finding.code,
        "level": _LEVELS[finding.severity],
        "message": {"text": finding.text},
        "locations": [{"physicalLocation": _place(finding.span)}],
    }
    if finding.code in order:
        result["ruleIndex"] = order[finding.code]
    named = [(finding.link, "link"), (finding.joint, "joint")]
    logical = [{"name": name, "kind": kind} for name, kind in named if name]
    if logical:
        result["locations"][0]["logicalLocations"] = logical
    calls = [
        {"message": {"text": f"call of macro {call.macro}"}, "physicalLocation": _at(call.position)}
        for call in finding.expansions
    ]
    related = [{"message": {"text": one.message}, "physicalLocation": _place(one.span)} for one in finding.related]
    if calls or related:
        result["relatedLocations"] = [*calls, *related]
    fixes = [one.fix for one in (finding, *finding.related) if one.fix is not None]
    if fixes:
        result["fixes"] = [_fix(fix) for fix in fixes]
    return result


def _fix(fix: Fix) -> dict[str, Any]:
    changes: dict[str, list[dict[str, Any]]] = {}
    for edit in fix.edits:
        replaced = {"deletedRegion": _region(edit.span), "insertedContent": {"text": edit.text}}
        changes.setdefault(edit.span.file, []).append(replaced)
    return {
        "description": {"text": fix.title if fix.safety == "safe" else f"{fix.title} (a guess)"},
        "artifactChanges": [
            {"artifactLocation": _file(file), "replacements": replacements} for file, replacements in changes.items()
        ],
    }


def _place(span: Span) -> dict[str, Any]:
    return {"artifactLocation": _file(span.file), "region": _region(span)}


def _at(position: Position) -> dict[str, Any]:
    region = {"startLine": position.line, "startColumn": position.column}
    return {"artifactLocation": _file(position.file), "region": region}


def _region(span: Span) -> dict[str, int]:
    """Return a region; the end column is exclusive, as in `Span` (3.30.8)."""
    return {"startLine": span.line, "startColumn": span.column, "endLine": span.end_line, "endColumn": span.end_column}


def _file(file: str) -> dict[str, str]:
    path = Path(file)
    if path.is_absolute():
        return {"uri": path.as_uri()}
    return {"uri": quote(path.as_posix()), "uriBaseId": _ROOT}
