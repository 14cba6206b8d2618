"""Findings on names and values that xacro lacks, at the place from which the definition is missing."""

from __future__ import annotations

import re
from functools import cached_property
from pathlib import Path, PurePath

from urdfkit.description.xml.source import Span
from urdfkit.errors import ResourceError, nearest
from urdfkit.lint.finding import Finding
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.xml.source import Position
    from urdfkit.lint.facts.values.renamed_definitions import RenamedDefinitions
    from urdfkit.lint.facts.values.value_sources import ValueSources
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Document, Tag

_CODES = ("X103", "X104", "X124")
_CALL = "X107"
"""Code of findings on calls, whose macro may have a renamed parameter."""

_FIND = re.compile(r"\$\(find\s+([^\s()]+)\s*\)")
_EXPRESSION = re.compile(r"\$\{[^{}]*\}|\$\([^()]*\)")
_PROPERTY = re.compile(r"<xacro:property\s[^<>]*\bname\s*=\s*[\"']([^\"']*)[\"']")


def at_missing_definitions(findings: list[Finding], model: Model) -> list[Finding]:
    """Return the findings; those with one missing definition become one finding where it is missing.

    Parameters of a macro without a value are left out, because the value in the call is a finding itself.
    """
    if not any(finding.code in (*_CODES, _CALL) for finding in findings):
        return findings
    from urdfkit.lint.facts.values.value_sources import ValueSources

    causes = _Causes(model, ValueSources(model))
    found: list[Finding] = []
    places: dict[tuple[str, Span | str | None], int] = {}
    is_parameter = [each.code in _CODES and _is_parameter(each, model) for each in findings]
    has_cause = any(each.code in _CODES and not of_macro for each, of_macro in zip(findings, is_parameter, strict=True))
    for finding, of_macro in zip(findings, is_parameter, strict=True):
        if finding.code not in (*_CODES, _CALL):
            found.append(finding)
            continue
        if has_cause and of_macro:
            continue
        cause = causes.of(finding)
        named = finding.names[0] if finding.code == "X104" and finding.names else None
        at = cause.span if cause is not None else None
        is_renamed = cause is not None and cause.is_renamed
        key = ("renamed", at) if is_renamed else (finding.code, named or at)
        first = places.get(key)
        if cause is None and named is None:
            found.append(finding)
        elif first is None:
            places[key] = len(found)
            found.append(_moved(finding, cause) if cause is not None else finding)
        else:
            one = found[first]
            found[first] = Finding(**{**one.__dict__, "related": (*one.related, finding)})
    return found


@record
class _Cause:
    """Place where a definition is missing.

    Attributes:
        span: the place.
        help: what to do there.
        namespace: the namespace that an include lacks.
        message: the defect at that place; empty for the message of the finding.
        is_renamed: whether the definition there has another name than its uses.
    """

    span: Span
    help: str
    namespace: str = ""
    message: str = ""
    is_renamed: bool = False


@record(eq=False)
class _Include:
    """Include of a file.

    Attributes:
        document: the file with the include.
        tag: the include.
        path: the path of the included file, as written.
        name: the name of the included file.
        namespace: the namespace of its macros and properties.
    """

    document: Document
    tag: Tag
    path: str
    name: str
    namespace: str | None


def _moved(finding: Finding, cause: _Cause) -> Finding:
    used = f"{cause.help}; it is used at {finding.file}:{finding.line}:{finding.column}"
    details = {"span": cause.span, "help": used, "fix": None, "chains": (), "related": (finding,)}
    if finding.code == "X103" and cause.namespace:
        details["message"] = f"namespace `{cause.namespace}` of macros is not defined"
    elif cause.message:
        details["message"] = cause.message
    return Finding(**{**finding.__dict__, **details})


def _is_parameter(finding: Finding, model: Model) -> bool:
    """Return whether a name is a parameter of the macro that the finding is in."""
    macros = [model.expanded.macros.get(chain[0].macro.rpartition(".")[2]) for chain in finding.chains]
    names = finding.names[:1]
    return bool(names) and any(macro is not None and names[0] in macro.parameters for macro in macros)


class _Causes:
    """Finds where definitions are missing."""

    def __init__(self, model: Model, sources: ValueSources) -> None:
        self._model, self._sources = model, sources
        self._found: dict[tuple[str, str, str], _Cause | None] = {}

    def of(self, finding: Finding) -> _Cause | None:
        """Return the place where a definition is missing; None if it is unknown."""
        if finding.code == "X124":
            return self._in_yaml(finding)
        renamed = self._renamed(finding)
        if renamed is not None or finding.code == _CALL:
            return renamed
        key = (finding.code, finding.names[0] if finding.names else "", finding.file)
        if key not in self._found:
            self._found[key] = self._of_name(*key)
        return self._found[key]

    def _renamed(self, finding: Finding) -> _Cause | None:
        """Return the definition of a macro, property or parameter that has another name than its uses."""
        expanded, name = self._model.expanded, finding.names[0] if finding.names else ""
        if finding.code != _CALL:
            macro = expanded.macros.get(finding.meant) if finding.code == "X103" else None
            at = macro.position if macro is not None else expanded.properties.get(finding.meant)
            if at is None or not name or not self._definitions.is_wrong(finding.meant, name, (at.file, at.line)):
                return self._renamed_parameter(finding, name) if finding.code == "X104" else None
            what = f"{'macro' if finding.code == 'X103' else 'property'} `{finding.meant}`"
            return self._at_definition(at, "name", what, name)
        return self._renamed_parameter(finding, name)

    def _renamed_parameter(self, finding: Finding, name: str) -> _Cause | None:
        """Return the parameters of the macro that a finding is in, or calls, if its body uses another name."""
        around = [chain[0].macro.rpartition(".")[2] for chain in finding.chains if chain]
        macros = finding.names[1:] if finding.code == _CALL else around
        macro = self._model.expanded.macros.get(macros[0] or "") if macros else None
        tag = self._model.tag(macro.position) if macro is not None else None
        if macro is None or tag is None or not name or name in macro.parameters:
            return None
        text = self._model.document(macro.position.file).source.text[tag.end : tag.close_end]
        words = re.findall(r"\w+", " ".join(each[0] for each in _EXPRESSION.finditer(text)))
        unused = [each for each in macro.parameters if each not in words and each not in text]
        calls = (each for each in self._model.expanded.faults if each.kind == "macro-arguments")
        is_passed = any(each.name == macros[0] and name in each.details.get("unknown", ()) for each in calls)
        if name not in words or len(unused) != 1 or not is_passed:
            return None
        return self._at_definition(macro.position, "params", f"parameter `{unused[0]}` of macro `{macros[0]}`", name)

    def _at_definition(self, at: Position, attribute: str, what: str, name: str) -> _Cause:
        message = f"{what} is not used; did you mean `{name}`, which is used but undefined?"
        return _Cause(self._model.span(at, attribute), f"write `{name}`", "", message, is_renamed=True)

    @cached_property
    def _definitions(self) -> RenamedDefinitions:
        from urdfkit.lint.facts.values.renamed_definitions import RenamedDefinitions

        return RenamedDefinitions(self._model)

    def _of_name(self, code: str, name: str, file: str) -> _Cause | None:
        if code == "X103":
            return self._namespace(name) if "." in name else self._include_of_macro(name)
        return self._local_property(name) or self._namespace(f"{name}.") or self._property_of_twin(file, name)

    def _in_yaml(self, finding: Finding) -> _Cause | None:
        """Return the list in a YAML file that lacks an item, or the misspelt key."""
        source, span = self._model.document(finding.file).source, finding.span
        text = source.text[source.offset(span.line, span.column) : source.offset(span.end_line, span.end_column)]
        found = [self._sources.lacking(text, span, chain) for chain in finding.chains or ((),)]
        if found[0] is None or any(each != found[0] for each in found):
            return None
        group, key = found[0]
        misspelt = self._misspelt(key, list(group.children)) if isinstance(key, str) else None
        if isinstance(key, str) and misspelt is None:
            return None
        at, length = (group.children[misspelt].place, len(misspelt)) if misspelt else (group.place, len(group.name))
        help = f"write `{key}`" if misspelt else f"write item {int(key) + 1} of `{group.name}`"
        return _Cause(Span(at.file, at.line, at.column, at.line, at.column + max(length, 1)), help)

    def _misspelt(self, key: str, keys: list[str]) -> str | None:
        """Return the key of a dictionary that no expression uses and that resembles the right one."""
        other = next((each for each in keys if sorted(each) == sorted(key)), None) or nearest(key, keys, cutoff=0.75)
        return None if other is None or self._words.issuperset(re.findall(r"\w+", other)) else other

    @cached_property
    def _words(self) -> set[str]:
        """The words of all files."""
        return {word for source in self._model.expanded.sources.values() for word in re.findall(r"\w+", source.text)}

    def _local_property(self, name: str) -> _Cause | None:
        """Return the property of a macro that its caller uses, without a scope."""
        position = self._model.expanded.properties.get(name)
        tag = self._model.tag(position) if position is not None else None
        if position is None or tag is None or "scope" in tag.attributes:
            return None
        is_local = any(above.name == "xacro:macro" for above in tag.ancestors())
        return _Cause(self._model.span(position), 'add scope="parent"') if is_local else None

    def _namespace(self, name: str) -> _Cause | None:
        """Return the include of a file without the namespace of a name."""
        space, _, rest = name.rpartition(".")
        if any(each.namespace == space for each in self._includes):
            return None
        macro = self._model.expanded.macros.get(rest)
        file = PurePath(macro.position.file).name if macro is not None else None
        for each in self._includes:
            is_meant = each.name == file if file is not None else each.name.partition(".")[0] == space
            if each.name and each.namespace is None and is_meant:
                return _Cause(each.document.span_of(each.tag), f'add ns="{space}"', space)
        return None

    def _include_of_macro(self, name: str) -> _Cause | None:
        """Return an include of a file in the same folder as the only file that defines a macro."""
        files = self._model.neighbouring_macros.get(name, [])
        if len(files) != 1:
            return None
        of_folder = self._folders.get(files[0].parent.resolve(), [])
        if len(of_folder) < 2:
            return None
        place = of_folder[-1].document.span_of(of_folder[-1].tag)
        return _Cause(place, f"include {files[0].name}, which defines `{name}`")

    @cached_property
    def _folders(self) -> dict[Path, list[_Include]]:
        """Folder → the includes of its files, without those whose folder an expression computes."""
        found: dict[Path, list[_Include]] = {}
        packages = self._model.expanded.packages
        for each in self._includes:
            try:
                written = _FIND.sub(lambda part: str(packages.find(part[1])), each.path.rpartition("/")[0])
                folder = (Path(each.document.source.file).parent / written).resolve()
            except (ResourceError, OSError, ValueError):  # ValueError: the path has a character that no file has
                continue
            if each.path and "$" not in written:
                found.setdefault(folder, []).append(each)
        return found

    def _property_of_twin(self, file: str, name: str) -> _Cause | None:
        """Return the include of a file that uses a property, which other robots define before they include it."""
        used = PurePath(file).name
        if not any(name in names and used in text for text, names in self._other_robots):
            return None
        for each in self._includes:
            if each.name == used:
                return _Cause(each.document.span_of(each.tag), f"define `{name}` before, as other robots do")
        return None

    @cached_property
    def _other_robots(self) -> list[tuple[str, set[str]]]:
        """The text of each file nearby that is not included, and the names of its properties."""
        from urdfkit.lint.project.description_files import SUFFIXES, near_descriptions

        model = self._model
        model.watch(*SUFFIXES)
        read = {str(Path(each).absolute()) for each in model.expanded.sources}
        others = near_descriptions(model.package, model.expanded.path)
        return [(text, set(_PROPERTY.findall(text))) for path, text in others if str(path.absolute()) not in read]

    @cached_property
    def _includes(self) -> list[_Include]:
        """The includes of all files."""
        found = []
        for file in self._model.expanded.sources:
            document = self._model.document(file)
            for tag in document.walk():
                if tag.name == "xacro:include":
                    path, space = (tag.attributes.get(each) for each in ("filename", "ns"))
                    written = path.value if path is not None else ""
                    name = written.rpartition("/")[2]
                    found.append(_Include(document, tag, written, name, space.value if space is not None else None))
        return found
