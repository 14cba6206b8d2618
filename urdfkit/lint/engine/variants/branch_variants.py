"""Variants of a robot that expand branches of conditions: one for each branch that no other variant expands."""

from __future__ import annotations

import re
from pathlib import PurePath

from urdfkit.lint.finding import EntryResult, Finding
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from urdfkit.description.xml.source import Position, Source
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Tag

    Check = Callable[[Mapping[str, str]], tuple[EntryResult, Model]]
    Branch = tuple[str, int, int]
    Place = tuple[str, int]

MOST = 4
"""Maximum number of variants of one robot for its branches."""

_CONDITIONS = ("xacro:if", "xacro:unless")
_EQUAL = re.compile(r"[\"']?(\$\(arg\s+\w+\s*\)|\w+)[\"']?\s*([!=]=)\s*[\"']?(\$\(arg\s+\w+\s*\)|[\w.-]*)[\"']?")
_ARGUMENT = re.compile(r"\$\(arg\s+(\w+)\s*\)")
_EXPRESSION = re.compile(r"\$\{([^{}]*)\}|\$\(eval\s+(.*)\)")
_NEGATED = re.compile(r"not\s*\(?\s*(.*?)\s*\)?")
_TRUE = ("true", "1", "True")

_NOT_INSTALLED = ("X113",)
"""Codes of findings on packages that only a variant needs; robots support hardware that is optional."""


@record(eq=False)
class _Condition:
    """A condition that another value of one argument changes.

    Attributes:
        branch: file, first and last line.
        argument: name of the argument.
        value: the value that selects the branch.
    """

    branch: Branch
    argument: str
    value: str


def with_branches(
    found: EntryResult, model: Model, others: list[Model], check: Check, arguments: Mapping[str, str]
) -> tuple[EntryResult, list[Model]]:
    """Return the result of a robot with the findings in branches that no variant expands yet, and their models.

    Findings outside of these branches, and of macros and files that only these branches use, are left out.

    Args:
        found: the result with the default arguments and the variants of launch files.
        model: the robot with the default arguments.
        others: the variants of launch files.
        check: lints the robot with other arguments.
        arguments: arguments of the command line, which are never overridden.
    """
    if model.expanded.root is None or not any(map(_has_condition, model.expanded.sources.values())):
        return found, []
    expanded: set[Place] = set()
    expanded.update(*(_places(each) for each in (model, *others)))
    conditions = [each for each in _conditions(model, expanded) if each.argument not in arguments]
    findings = list(found.findings)
    models: list[Model] = []
    files, used = dict(found.files), list(found.used)
    for condition in conditions:
        if len(models) == MOST:
            break
        if _is_expanded(condition.branch, expanded):
            continue
        result, variant = check({condition.argument: condition.value, **arguments})
        models.append(variant)
        used += result.used
        places = _places(variant)
        fresh = places - expanded
        reported = {(each.code, each.span) for each in findings}
        label = f"{condition.argument}:={condition.value}"
        for one in result.findings:
            is_fresh = (one.file, one.line) in fresh or _is_in(condition.branch, one)
            if is_fresh and one.code not in _NOT_INSTALLED and (one.code, one.span) not in reported:
                findings.append(Finding(**{**one.__dict__, "variant": label, "fix": None}))
                files.update(result.files)
        expanded |= places
    details = {"findings": tuple(findings), "files": files, "used": tuple(dict.fromkeys(used))}
    return EntryResult(**{**found.__dict__, **details}), models


def _has_condition(source: Source) -> bool:
    return "xacro:if" in source.text or "xacro:unless" in source.text


def _is_in(branch: Branch, finding: Finding) -> bool:
    file, first, last = branch
    return finding.file == file and first <= finding.line <= last


def _is_expanded(branch: Branch, expanded: set[Place]) -> bool:
    file, first, last = branch
    return any((file, line) in expanded for line in range(first, last + 1))


def _places(model: Model) -> set[Place]:
    """Return file and line of each element, macro call and definition that the expansion reached."""
    found: set[Place] = set()
    positions: list[Position] = [*model.expanded.properties.values()]
    positions += [macro.position for macro in model.expanded.macros.values()]
    for element in model.robot.element.walk():
        positions.append(element.origin.position)
        positions += [call.position for call in element.origin.expansions]
    found.update((at.file, at.line) for at in positions)
    names = {PurePath(file).name for file in model.expanded.sources}
    for file in model.expanded.sources:
        document = model.document(file)
        for tag in document.walk():
            path = tag.attributes.get("filename") if tag.name == "xacro:include" else None
            if path is not None and path.value.rpartition("/")[2] in names:
                found.add((file, document.source.position(tag.start).line))
    return found


def _conditions(model: Model, expanded: set[Place]) -> Iterator[_Condition]:
    """Yield the conditions whose branch is not expanded, and the value of an argument that selects it."""
    from urdfkit.description.xacro.declared_arguments import declared_arguments

    declared = declared_arguments(model.expanded.sources.values())
    for file in model.expanded.sources if declared else ():
        document = model.document(file)
        for tag in document.walk():
            written = tag.attributes.get("value") if tag.name in _CONDITIONS and tag.children else None
            if written is None or tag.close is None:
                continue
            first, last = (document.source.position(at).line for at in (tag.end, tag.close))
            branch = (file, min(first + 1, last), last)
            if _is_expanded(branch, expanded):
                continue
            selected = _selection(written.value, tag.name == "xacro:if", declared, model)
            if selected is not None:
                yield _Condition(branch, *selected)


def _selection(text: str, is_if: bool, declared: Mapping[str, str | None], model: Model) -> tuple[str, str] | None:
    """Return an argument and the value with which a condition has the other result; None if it is not that simple."""
    inside = text.strip()
    if (expression := _EXPRESSION.fullmatch(inside)) is not None:
        inside = (expression[1] or expression[2]).strip()
    if re.search(r"\b(?:and|or)\b|[<>+]", inside):
        return None
    negated = _NEGATED.fullmatch(inside)
    rest, wanted = (negated[1], not is_if) if negated is not None else (inside, is_if)
    equal = _EQUAL.fullmatch(rest.strip())
    if equal is not None:
        sides = [_argument(each, declared, model) for each in (equal[1], equal[3])]
        name, value = (sides[0], equal[3]) if sides[0] is not None else (sides[1], equal[1])
        if name is None or wanted != (equal[2] == "==") or value == declared[name]:
            return None
        return name, value
    name = _argument(rest.strip().strip("'\""), declared, model)
    if name is None or (declared[name] in _TRUE) == wanted:
        return None
    return name, "true" if wanted else "false"


def _argument(text: str, declared: Mapping[str, str | None], model: Model) -> str | None:
    """Return the argument that a name in a condition has the value of."""
    found = _ARGUMENT.fullmatch(text)
    name = found[1] if found is not None else text
    position = model.expanded.properties.get(name) if found is None else None
    tag: Tag | None = model.tag(position) if position is not None else None
    if tag is not None and "value" in tag.attributes:
        through = _ARGUMENT.fullmatch(tag.attributes["value"].value.strip())
        name = through[1] if through is not None else ""
    return name if declared.get(name) is not None else None
