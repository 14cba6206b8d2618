"""Hover text: findings with their rule pages, values of expressions, masses and inertia."""

from collections.abc import Callable, Iterable

from urdfkit.description.urdf.robot import Link
from urdfkit.lint.editor.cursor import Cursor
from urdfkit.lint.editor.navigation import at
from urdfkit.lint.editor.plugin_parameters import described, plugin_around
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.model import Model

_SHOWN = 5
_MASSES = frozenset(("link", "inertial", "mass", "inertia"))


def hover(
    model: Model, cursor: Cursor, findings: Iterable[Finding], probe: Callable[[int, str], list[str]]
) -> list[str]:
    """Return the hover text at a cursor, as pieces of Markdown.

    Args:
        model: the model that the file belongs to.
        cursor: the position in the file.
        findings: the findings of the file.
        probe: returns the values of a text inserted at an offset, one for each expansion.
    """
    pieces = [*_value(model, cursor, probe), *_macro(model, cursor), *_parameter(cursor), *_masses(model, cursor)]
    return [*pieces, *_rules(cursor, findings)]


def _value(model: Model, cursor: Cursor, probe: Callable[[int, str], list[str]]) -> list[str]:
    """Return the value of the expression, property or attribute under the cursor."""
    within, tag, attribute = cursor.expression, cursor.tag, cursor.attribute
    if tag is None:
        return []
    named = [one for one in at(model, cursor) if one.kind in ("property", "argument")]
    if named and named[0].kind == "property" and named[0].defines:
        written, place = f"${{{named[0].name}}}", tag.close_end
    elif named and within is not None and within[0].startswith("${"):
        written, place = f"${{{named[0].name}}}", tag.start
    elif within is not None:
        written, place = within[0], tag.start
    else:
        return []
    values = probe(place, written)
    if within is not None and named and within[0] != written:
        whole = probe(place, within[0])
        more = [_listed(within[0], whole)] if whole else []
    else:
        more = []
    if within is not None and attribute is not None and attribute.value != within[0]:
        text = probe(place, attribute.value)
        more += [_listed(attribute.value, text)] if text else []
    return ([_listed(written, values)] if values else []) + more


def _listed(written: str, values: list[str]) -> str:
    shown = ", ".join(f"`{value}`" for value in values[:_SHOWN])
    rest = f" and {len(values) - _SHOWN} more" if len(values) > _SHOWN else ""
    return f"`{written}` = {shown}{rest}"


def _parameter(cursor: Cursor) -> list[str]:
    """Return the documentation of the plugin parameter under the cursor, from the plugin tables."""
    tag = cursor.tag
    if tag is None or tag.parent is None:
        return []
    found = []
    for spec in plugin_around(tag.parent):
        parameter = spec.parameter(tag.name)
        if parameter is not None:
            found.append(f"`<{tag.name}>` of {spec.kind} ({spec.generation}): {described(parameter)}")
    return found


def _macro(model: Model, cursor: Cursor) -> list[str]:
    """Return the signature of the macro called under the cursor, and the position of its definition."""
    tag = cursor.tag
    called = [one for one in at(model, cursor) if one.kind == "macro"] if tag is not None and cursor.in_name else []
    macro = model.expanded.macros.get(called[0].name) if called else None
    if macro is None:
        return []
    head = model.tag(macro.position)
    params = head.attributes.get("params") if head is not None else None
    needed = " ".join(f"`{name}`" for name in macro.parameters if name not in macro.defaults and name[:1] != "*")
    lines = [f"**macro `{macro.name}`**, {model.shown(macro.position)}"]
    if params is not None and params.value.strip():
        lines.append(f'`params="{" ".join(params.value.split())}"`')
    lines.append(f"needs {needed}" if needed else "needs nothing")
    return ["  \n".join(lines)]


def _masses(model: Model, cursor: Cursor) -> list[str]:
    tag = cursor.tag
    while tag is not None and tag.name != "link":
        if tag.name not in _MASSES:
            return []
        tag = tag.parent
    if tag is None or cursor.expression is not None:
        return []
    links = [link for link in model.robot.links if model.tag(link.element.origin.position) is tag]
    return [piece for link in links[:_SHOWN] for piece in _mass(model, link)]


def _mass(model: Model, link: Link) -> list[str]:
    from urdfkit.description.urdf.principal_moments import principal_moments
    from urdfkit.errors import UrdfkitError
    from urdfkit.lint.fixes.inertia_edits import compute_inertial

    inertial = link.inertial
    lines = [f"**link `{link.name}`**"]
    if inertial is None:
        lines.append("no mass")
    else:
        centre = " ".join(f"{value:g}" for value in inertial.origin.xyz)
        lines.append(f"mass {inertial.mass:g} kg, centre at {centre} m" if inertial.mass is not None else "no mass")
        for moments, _ in list(principal_moments(link))[:1]:
            lines.append(f"principal moments {', '.join(f'{moment:.4g}' for moment in moments)} kg·m²")
    try:
        value = compute_inertial(model, link)
        tensor = ", ".join(f"{part:.4g}" for part in value.tensor)
        lines.append(f"its {value.kind} shapes, filled evenly: {value.volume:.4g} m³, tensor {tensor} kg·m²")
    except (UrdfkitError, ImportError):
        pass
    return ["  \n".join(lines)]


def _rules(cursor: Cursor, findings: Iterable[Finding]) -> list[str]:
    from urdfkit.lint.catalogue import page, rules

    source = cursor.document.source
    codes: dict[str, str] = {}
    for finding in findings:
        span = finding.span
        start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
        if start <= cursor.offset <= end:
            codes.setdefault(finding.code, finding.message)
    pages = {rule.code: page(rule) for rule in rules() if rule.code in codes}
    return [f"**{code}** {message}\n\n{pages.get(code, '')}" for code, message in codes.items()]
