"""Findings on names and values that xacro lacks, at the place from which the definition is missing."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.description.xml.source import Span
from urdfkit.errors import nearest
from urdfkit.lint.finding import Finding

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.facts.values.value_sources import ValueSources
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Document, Tag

_CODES = ("X103", "X104", "X124")


def at_missing_definitions(findings: list[Finding], model: Model) -> list[Finding]:
    """Return the findings; those with one missing definition become one finding where it is missing.

    Parameters of a macro without a value are left out, because the value in the call is a finding itself.
    """
    if not any(finding.code in _CODES for finding in findings):
        return findings
    from urdfkit.lint.facts.values.value_sources import ValueSources

    causes = _Causes(model, ValueSources(model))
    found: list[Finding] = []
    places: dict[tuple[str, Span | str | None], int] = {}
    has_cause = {each.names[:1] for each in findings if each.code in _CODES and not _is_parameter(each, model)}
    for finding in findings:
        if finding.code not in _CODES:
            found.append(finding)
            continue
        if has_cause and _is_parameter(finding, model):
            continue
        span, help = causes.of(finding)
        key = (finding.code, finding.names[0] if finding.code == "X104" and finding.names else span)
        first = places.get(key)
        if span is None and not (finding.code == "X104" and finding.names):
            found.append(finding)
        elif first is None:
            places[key] = len(found)
            found.append(_moved(finding, span, help) if span is not None else finding)
        else:
            one = found[first]
            found[first] = Finding(**{**one.__dict__, "related": (*one.related, finding)})
    return found


def _moved(finding: Finding, span: Span, help: str) -> Finding:
    used = f"{help}; it is used at {finding.file}:{finding.line}:{finding.column}"
    details = {"span": span, "help": used, "fix": None, "chains": (), "related": (finding,)}
    if finding.code == "X103" and help.startswith("add ns"):
        details["message"] = f"namespace `{finding.names[0].rpartition('.')[0]}` of macros is not defined"
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

    def of(self, finding: Finding) -> tuple[Span | None, str]:
        """Return the place where a definition is missing, and what to do there; None if it is unknown."""
        name = finding.names[0] if finding.names else ""
        if finding.code == "X124":
            return self._in_yaml(finding)
        if finding.code == "X103":
            return self._namespace(name) if "." in name else self._include_of_macro(name)
        for place in (self._local_property(name), self._namespace(f"{name}."), self._property_of_twin(finding, name)):
            if place[0] is not None:
                return place
        return None, ""

    def _in_yaml(self, finding: Finding) -> tuple[Span | None, str]:
        """Return the list in a YAML file that lacks an item, or the misspelt key."""
        source, span = self._model.document(finding.file).source, finding.span
        text = source.text[source.offset(span.line, span.column) : source.offset(span.end_line, span.end_column)]
        found = [self._sources.lacking(text, span, chain) for chain in finding.chains or ((),)]
        if found[0] is None or any(each != found[0] for each in found):
            return None, ""
        group, key = found[0]
        misspelt = self._misspelt(key, list(group.children)) if isinstance(key, str) else None
        if isinstance(key, str) and misspelt is None:
            return None, ""
        at, length = (group.children[misspelt].place, len(misspelt)) if misspelt else (group.place, len(group.name))
        help = f"write `{key}`" if misspelt else f"write item {int(key) + 1} of `{group.name}`"
        return Span(at.file, at.line, at.column, at.line, at.column + max(length, 1)), help

    def _misspelt(self, key: str, keys: list[str]) -> str | None:
        """Return the key of a dictionary that no expression uses and that resembles the right one."""
        other = next((each for each in keys if sorted(each) == sorted(key)), None) or nearest(key, keys, cutoff=0.75)
        texts = [source.text for source in self._model.expanded.sources.values()]
        is_used = other is not None and any(re.search(rf"(?<!\w){re.escape(other)}(?!\w)", text) for text in texts)
        return None if is_used else other

    def _local_property(self, name: str) -> tuple[Span | None, str]:
        """Return the property of a macro that its caller uses, without a scope."""
        position = self._model.expanded.properties.get(name)
        tag = self._model.tag(position) if position is not None else None
        if position is None or tag is None or "scope" in tag.attributes:
            return None, ""
        is_local = any(above.name == "xacro:macro" for above in tag.ancestors())
        return (self._model.span(position), 'add scope="parent"') if is_local else (None, "")

    def _namespace(self, name: str) -> tuple[Span | None, str]:
        """Return the include of a file without the namespace of a name."""
        space, _, rest = name.rpartition(".")
        includes = list(self._includes())
        if any("ns" in tag.attributes and tag.attributes["ns"].value == space for _, tag in includes):
            return None, ""
        macro = self._model.expanded.macros.get(rest)
        for document, tag in includes:
            path = tag.attributes["filename"].value if "filename" in tag.attributes else ""
            stem = Path(path).name.split(".")[0]
            is_meant = macro.position.file.endswith(Path(path).name) if macro is not None else stem == space
            if path and "ns" not in tag.attributes and is_meant:
                return document.span_of(tag), f'add ns="{space}"'
        return None, ""

    def _include_of_macro(self, name: str) -> tuple[Span | None, str]:
        """Return an include of a file in the same folder as the only file that defines a macro."""
        files = self._model.neighbouring_macros.get(name, [])
        if len(files) != 1:
            return None, ""
        beside = [
            (document, tag)
            for document, tag in self._includes()
            if "filename" in tag.attributes
            and str(files[0].parent).endswith(
                re.sub(r".*\)|^\.*/", "", tag.attributes["filename"].value).rpartition("/")[0]
            )
        ]
        if len(beside) < 2:
            return None, ""
        document, tag = beside[-1]
        return document.span_of(tag), f"include {files[0].name}, which defines `{name}`"

    def _property_of_twin(self, finding: Finding, name: str) -> tuple[Span | None, str]:
        """Return the include of a file that uses a property, which other robots define before they include it."""
        from urdfkit.lint.project.description_files import near_descriptions

        model, file = self._model, Path(finding.file).name
        read = {str(Path(each).absolute()) for each in model.expanded.sources}
        defines = rf"<xacro:property\s[^<>]*\bname\s*=\s*[\"']{re.escape(name)}[\"']"
        others = near_descriptions(model.package, model.expanded.path)
        is_defined = any(
            f"{file}" in text and re.search(defines, text) for path, text in others if str(path.absolute()) not in read
        )
        for document, tag in self._includes() if is_defined else ():
            if "filename" in tag.attributes and Path(tag.attributes["filename"].value).name == file:
                return document.span_of(tag), f"define `{name}` before, as other robots do"
        return None, ""

    def _includes(self) -> Iterator[tuple[Document, Tag]]:
        """Yield the includes of all files."""
        for file in self._model.expanded.sources:
            document = self._model.document(file)
            yield from ((document, tag) for tag in document.walk() if tag.name == "xacro:include")
