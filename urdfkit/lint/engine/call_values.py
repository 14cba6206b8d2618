"""Findings on a value that a macro only hands on, at the macro call where a person wrote it."""

from __future__ import annotations

import re
from collections.abc import Sequence

from urdfkit.description.xml.numbers import number
from urdfkit.description.xml.source import Expansion, Span
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.model import Model

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.facts.values.value_sources import ValueSource, ValueSources

Trail = tuple[Span, ...]
"""Places of a value after its use: the expression that computes it if the use only names it, and the literal."""

_HANDED_ON = r"[\s0]*\$\{\s*([A-Za-z_]\w*)\s*\}[\s0]*"
"""Matches a parameter, perhaps between zeros: ``0 0 ${yaw}``."""

_ALL_HANDED_ON = r"[\s0]*(?:\$\{\s*[A-Za-z_]\w*\s*\}[\s0]*){2,}"
"""Matches several parameters and zeros, and nothing else: ``${x} 0 ${z}``."""

_ATTRIBUTE = rf"[\w:.-]+\s*=\s*[\"']{_HANDED_ON}[\"']"
_TAG = rf"<[\w:.-]+\s+{_ATTRIBUTE}\s*/?>"
"""Matches a tag with one attribute."""

_NUMBER = r"(?<![\w.])-?\d+\.?\d*(?:[eE][-+]?\d+)?(?![\w.])"
_TEXT = rf"<[\w:.-]+(?:\s[^<>]*)?>(?:[\w~/]+:=)?{_HANDED_ON}</"
"""Matches an element whose text is a parameter, perhaps as the new name of a remapping."""


_OF_VALUES = re.compile("C719|G61[149]|I50[14]|I514|I518|J40[5-9]|J41[019]|J42[01235]|J429|S91[46]|Z823")
"""Matches codes of findings on a value that is wrong by itself: its unit, sign or size."""

_UNIT = r"\*\s*(?:10+(?:\.0*)?|1\.?0*e\+?\d+)(?![\w.])|/\s*(?:0?\.0+1|1\.?0*e-\d+)(?![\w.])"
"""Matches a factor that converts a length to a smaller unit."""

_MOST = 2000
"""Length of the content of an element that is searched for expressions [characters]."""

_FACTOR = 4.0
"""A coordinate is the cause of a distance if it is larger than all other coordinates by this factor."""


def at_calls(findings: list[Finding], model: Model) -> list[Finding]:
    """Return the findings; those on ``${parameter}`` in a macro are moved to the value in the macro call.

    Values behind dictionaries and formulas are found where they are written too, such as in a YAML file.

    A finding on more than the attribute stays where it is if its message does not name the value. All findings stay if
    several values cause them, perhaps by one slip in the macro, or if the file of the macro suppresses findings by
    comments. The help names the place in the macro. With urdfkit as the target all stay, since the repairs of the
    simulator and viewer are reported there.
    """
    formulas = {(each.file, each.line) for each in findings if each.code == "X119"}
    groups: dict[tuple[str, Span], list[Trail]] = {}
    calls: dict[tuple[str, Span], set[Expansion]] = {}
    for finding in findings:
        calls.setdefault((finding.code, finding.span), set())
        if (finding.file, finding.line) not in formulas:  # which the macro itself has wrong
            calls[finding.code, finding.span].update(chain[0] for chain in finding.chains)
    sources: list[ValueSources] = []
    trails = [
        _literal(finding, model, sources)
        or _trail(_written(finding, model) if finding.chains else None)
        or _trail(_only_call(finding, calls[finding.code, finding.span], model) if finding.chains else None)
        if finding.kind != "swapped"  # Two values are right, but in each other's place.
        else ()
        for finding in findings
    ]
    for finding, trail in zip(findings, trails, strict=True):
        groups.setdefault((finding.code, finding.span), []).append(trail)
    found: list[Finding] = []
    at_literals: dict[tuple[str, Span], int] = {}
    for finding in findings:
        trail = common_trail(groups[finding.code, finding.span])
        key = (finding.code, trail[-1]) if trail else None
        if key is None or not _OF_VALUES.fullmatch(finding.code) or key not in at_literals:
            if key is not None:
                at_literals[key] = len(found)
            found.append(_moved(finding, trail) if trail else finding)
        else:  # one value causes several findings
            first = found[at_literals[key]]
            chains = tuple(dict.fromkeys((*first.chains, *finding.chains)))
            names = (*first.names, *(name for name in (finding.link, finding.joint) if name))
            found[at_literals[key]] = Finding(**{**first.__dict__, "chains": chains, "names": names})
    return found


def common_trail(trails: Sequence[Trail]) -> Trail:
    """Return the places that several values have in common, from the use on; all places if the last is the same."""
    if len({each[-1:] for each in trails}) == 1:
        return trails[0]
    shared = 0
    while all(len(each) > shared and each[shared] == trails[0][shared] for each in trails):
        shared += 1
    return trails[0][:shared]


def _trail(span: Span | None) -> Trail:
    return () if span is None else (span,)


def _literal(finding: Finding, model: Model, sources: list[ValueSources]) -> Trail:
    """Return the places up to the literal that makes a value wrong; empty if several literals may be the cause."""
    text = _text(finding, model) if _OF_VALUES.fullmatch(finding.code) else ""
    if text and "${" not in text:
        text += _content(finding, model)
    is_unit = finding.code == "J422" and re.search(_UNIT, text) is not None
    if is_unit or finding.kind == "argument":  # The factor or the whole argument is wrong, not a value in it.
        return ()
    if "${" not in text or "urdfkit:" in model.document(finding.file).source.text:
        return ()
    if not sources:
        from urdfkit.lint.facts.values.value_sources import ValueSources

        sources.append(ValueSources(model))
    trails: list[Trail] = []
    for chain in finding.chains or ((),):
        found = sources[0].of_text(text, finding.span, chain)
        cause = _cause(found, text, finding) if found is not None else None
        if cause is None:
            return ()
        is_computed = re.sub(r"\$\{\s*\w+\s*\}", "", text).count("${") > 0
        trails.append((*(() if is_computed else cause.trail[:1]), cause.span))
    return common_trail(trails)


def _cause(found: set[ValueSource], text: str, finding: Finding) -> ValueSource | None:
    """Return the one literal that is not a sign, that the message names, or that exceeds all others."""
    signs = ("0", "1", "-1", "true", "false", "True", "False", "")
    values = list({each.span: each for each in found if each.text not in signs}.values()) or list(found)
    outside = [float(each) for each in re.findall(_NUMBER, re.sub(r"\$\{[^{}]*\}", " ", text))]
    if len(values) == 1 and not any(outside):
        return values[0]
    named = [each for each in values if _is_named(each.text, finding.message)]
    if len(named) == 1:
        return named[0]
    sizes = sorted((abs(size), each) for each in values if (size := number(each.text)) is not None)
    if len(sizes) == len(values) > 0 and values[0].text not in signs:
        others = max([*(size for size, _ in sizes[:-1]), *map(abs, outside)], default=0.0)
        return sizes[-1][1] if sizes[-1][0] > _FACTOR * others else None
    return None


def _moved(finding: Finding, trail: Trail) -> Finding:
    name = f"macro `{finding.chains[0][0].macro}` uses the value" if finding.chains else "the value is used"
    used = f"{name} at {finding.file}:{finding.line}:{finding.column}"
    help = f"{finding.help}; {used}" if finding.help else used
    return type(finding)(**{**finding.__dict__, "span": trail[-1], "help": help, "trail": (finding.span, *trail)})


def _written(finding: Finding, model: Model) -> Span | None:
    """Return the span of the attribute whose literal value a finding is about: of a macro call, or of a property.

    Only the macro call uses the property.
    """
    from urdfkit.lint.facts.root_cause import value_of

    if finding.file not in model.expanded.sources:
        return None
    calls, is_of_twins = _shared(finding.chains), len(finding.chains) > 1
    document, span = model.document(finding.file), finding.span
    if "urdfkit:" in document.source.text:
        return None
    if not is_of_twins and (call := _call_with_all(finding, model)) is not None:
        return call
    start, end = (document.source.offset(*at) for at in ((span.line, span.column), (span.end_line, span.end_column)))
    text = document.source.text
    whole = re.fullmatch(_ATTRIBUTE, text[start:end])
    handed_on = whole or re.fullmatch(_TAG, text[start:end]) or re.match(_TEXT, text[start:])
    found: Span | None = None
    while handed_on is not None and (calls or not is_of_twins):
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


def _only_call(finding: Finding, calls: set[Expansion], model: Model) -> Span | None:
    """Return the one macro call whose arguments give a wrong inertia, while the other calls give correct inertias.

    Where the macro writes numbers instead of expressions, no call is wrong.
    """
    text = _text(finding, model)
    is_computed = (finding.code.startswith("I") and "${" in text) or (finding.code == "J414" and "rpy" in text)
    if not is_computed or len(calls) != 1 or finding.file not in model.expanded.sources:
        return None
    if "urdfkit:" in model.document(finding.file).source.text:
        return None
    start = finding.span.start
    before = {each.origin.position for each in model.elements if each.origin.position.file == finding.file}
    tag = max((each for each in before if (each.line, each.column) <= (start.line, start.column)), default=None)
    of_tag = [each.origin for each in model.elements if each.origin.position == tag]
    others = {origin.expansions[0] for origin in of_tag if origin.expansions} - calls
    if not others:
        return None
    call = model.tag(next(iter(calls)).position)
    origin = next((each for each in call.children if each.name == "origin"), None) if call is not None else None
    if origin is not None and finding.code == "I519" and finding.kind == "turned":  # the block that turns the moments
        return model.document(next(iter(calls)).position.file).source.span(origin.start, origin.end)
    return model.span(next(iter(calls)).position)


def _text(finding: Finding, model: Model) -> str:
    """Return the text that a finding marks; empty outside of the description."""
    if finding.file not in model.expanded.sources:
        return ""
    source, span = model.document(finding.file).source, finding.span
    return source.text[source.offset(span.line, span.column) : source.offset(span.end_line, span.end_column)]


def _content(finding: Finding, model: Model) -> str:
    """Return the text after a start tag that a finding marks, up to the end tag; without parsing the whole file."""
    source, span = model.document(finding.file).source, finding.span
    start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
    name = re.match(r"<([\w:.-]+)[^<>]*(?<!/)>$", source.text[start:end])
    close = source.text.find(f"</{name[1]}>", end, end + _MOST) if name is not None else -1
    return source.text[end:close] if close > 0 else ""


def _shared(chains: Sequence[tuple[Expansion, ...]]) -> tuple[Expansion, ...]:
    """Return the innermost calls that are the same in all chains, such as those of one joint in both of two legs."""
    first, count = chains[0], 0
    while all(len(each) > count and each[count] == first[count] for each in chains):
        count += 1
    return first[:count]


def _call_with_all(finding: Finding, model: Model) -> Span | None:
    """Return the macro call whose arguments are all values of the attribute that a finding is about.

    Other calls of the macro pass other values, so the macro itself is right.
    """
    from urdfkit.lint.facts.root_cause import value_of

    document, calls, span = model.document(finding.file), finding.chains[0], finding.span
    start, end = (document.source.offset(*at) for at in ((span.line, span.column), (span.end_line, span.end_column)))
    written = re.search(rf"=\s*[\"']({_ALL_HANDED_ON})[\"']", document.source.text[start:end])
    if written is None:
        return None
    found = [value_of(model, name, calls) for name in re.findall(r"\{\s*(\w+)\s*\}", written[1])]
    is_call = all(place is not None and place[0] == calls[0].position for _, place, _ in found)
    return model.span(calls[0].position) if is_call else None


def _is_used_once(name: str, model: Model) -> bool:
    """Return whether expressions of the description name a property once."""
    pattern = rf"\$\{{[^{{}}]*?(?<!\w){name}(?!\w)[^{{}}]*\}}"
    return sum(len(re.findall(pattern, source.text)) for source in model.expanded.sources.values()) == 1


def _is_named(value: str, message: str) -> bool:
    """Return whether a message contains a name, or a number as text or rounded."""
    value_read = number(value)
    forms = {value} if value_read is None else {value, f"{value_read:g}"}
    return any(re.search(rf"(?<![\w.-]){re.escape(form)}(?![\w-]|\.\d)", message) for form in forms if form)
