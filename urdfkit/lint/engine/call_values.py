"""Findings on a value that a macro only hands on, at the macro call where a person wrote it."""

import re

from urdfkit.description.xml.source import Span
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.model import Model

_HANDED_ON = r"[\s0]*\$\{\s*([A-Za-z_]\w*)\s*\}[\s0]*"
"""Matches a parameter, perhaps between zeros: ``0 0 ${yaw}``."""

_ATTRIBUTE = rf"[\w:.-]+\s*=\s*[\"']{_HANDED_ON}[\"']"
_TAG = rf"<[\w:.-]+\s+{_ATTRIBUTE}\s*/?>"
"""Matches a tag with one attribute."""

_TEXT = rf"<[\w:.-]+(?:\s[^<>]*)?>{_HANDED_ON}</"
"""Matches an element whose text is a parameter."""


def at_calls(findings: list[Finding], model: Model) -> list[Finding]:
    """Return the findings; those on ``${parameter}`` in a macro are moved to the value in the macro call.

    A finding on more than the attribute stays where it is if its message does not name the value. All findings stay if
    several values cause them, perhaps by one slip in the macro, or if the file of the macro suppresses findings by
    comments. The help names the place in the macro. With urdfkit as the target all stay, since the repairs of the
    simulator and viewer are reported there.
    """
    groups: dict[tuple[str, Span], list[Span | None]] = {}
    written = [_written(finding, model) if finding.chains else None for finding in findings]
    for finding, span in zip(findings, written, strict=True):
        groups.setdefault((finding.code, finding.span), []).append(span)
    return [
        finding if span is None or len(set(groups[finding.code, finding.span])) > 1 else _moved(finding, span)
        for finding, span in zip(findings, written, strict=True)
    ]


def _moved(finding: Finding, span: Span) -> Finding:
    used = f"macro `{finding.chains[0][0].macro}` uses it at {finding.file}:{finding.line}:{finding.column}"
    help = f"{finding.help}; {used}" if finding.help else used
    return type(finding)(**{**finding.__dict__, "span": span, "help": help})


def _written(finding: Finding, model: Model) -> Span | None:
    """Return the span of the attribute whose literal value a finding is about: of a macro call, or of a property.

    Only the macro call uses the property.
    """
    from urdfkit.lint.facts.root_cause import value_of

    if finding.file not in model.expanded.sources or len(finding.chains) != 1:
        return None
    document, calls, span = model.document(finding.file), finding.chains[0], finding.span
    if "urdfkit:" in document.source.text:
        return None
    start, end = (document.source.offset(*at) for at in ((span.line, span.column), (span.end_line, span.end_column)))
    text = document.source.text
    whole = re.fullmatch(_ATTRIBUTE, text[start:end])
    handed_on = whole or re.fullmatch(_TAG, text[start:end]) or re.match(_TEXT, text[start:])
    found: Span | None = None
    while handed_on is not None:
        value, place, outer = value_of(model, handed_on[1], calls)
        is_property = place is not None and (not calls or place[0] != calls[0].position)
        if place is None or (is_property and not (_is_used_once(handed_on[1], model) and value.strip() and not outer)):
            return None  # a default value, or a property of several uses
        handed_on = re.fullmatch(_HANDED_ON, value)
        is_named = handed_on is None and "$" not in value and _is_named(value.strip(), finding.message)
        if is_named or (whole and not is_property):
            found = model.span(*place)
        if is_property:
            break
        calls = tuple(outer)
    return found


def _is_used_once(name: str, model: Model) -> bool:
    """Return whether expressions of the description name a property once."""
    pattern = rf"\$\{{[^{{}}]*?(?<!\w){name}(?!\w)[^{{}}]*\}}"
    return sum(len(re.findall(pattern, source.text)) for source in model.expanded.sources.values()) == 1


def _is_named(value: str, message: str) -> bool:
    """Return whether a message contains a name, or a number as text or rounded."""
    from urdfkit.description.xml.numbers import number

    value_read = number(value)
    forms = {value} if value_read is None else {value, f"{value_read:g}"}
    return any(re.search(rf"(?<![\w.-]){re.escape(form)}(?![\w-]|\.\d)", message) for form in forms if form)
