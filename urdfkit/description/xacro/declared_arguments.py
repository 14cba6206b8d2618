"""Arguments that the files of a description declare with ``<xacro:arg>``, also where a condition excludes them."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import XmlError, did_you_mean, shortened


def declared_arguments(sources: Iterable[Source]) -> dict[str, str | None]:
    """Return name → default of the declared arguments; the default is None without one. Other files have none.

    Args:
        sources: the files; the first declaration of an argument applies.
    """
    declared: dict[str, str | None] = {}
    for element in _elements("arg", sources):
        if name := element.get("name"):
            declared.setdefault(name, element.get("default"))
    return declared


def _elements(tag: str, sources: Iterable[Source]) -> Iterator[Element]:
    """Yield the elements with a tag, in any namespace, of the files that are XML."""
    for source in sources:
        with suppress(XmlError):
            yield from (each for each in document_of(source).walk() if each.tag.rpartition(":")[2] == tag)


def is_used(name: str, sources: Iterable[Source]) -> bool:
    """Return whether an expression in one of the files uses an argument."""
    import re

    own = re.escape(name)
    use = re.compile(rf"\$\(arg\s+{own}\s*\)|\$\(eval\b[^<\"]*?\b{own}\b|\bxacro\.arg\(.{own}.\)")
    return any(use.search(source.text) for source in sources)


def macro_parameters(macro: str, sources: Iterable[Source]) -> list[str]:
    """Return the parameters of a macro that take a value, not a block, in all of its definitions.

    Args:
        macro: name of the macro.
        sources: the files.
    """
    from urdfkit.description.xacro.evaluation.parameters import parameters

    found: dict[str, None] = {}
    for element in _elements("macro", sources):
        if (element.get("name") or "").rpartition(":")[2] == macro:
            with suppress(ValueError):
                found.update((each.name, None) for each in parameters(element.get("params") or ""))
    return [name for name in found if not name.startswith("*")]


def unused_arguments(arguments: Mapping[str, str], sources: Iterable[Source], macro: str | None = None) -> list[str]:
    """Return one line per argument that is neither declared nor used, with the nearest declared name.

    xacro ignores such arguments, and with them misspelt names.

    Args:
        arguments: the arguments passed to xacro.
        sources: all files of the robot.
        macro: the instantiated macro, whose parameters are declared, too.
    """
    sources = list(sources)
    declared = [*declared_arguments(sources), *(macro_parameters(macro, sources) if macro else ())]
    lines = []
    for name in arguments:
        if name not in declared and not is_used(name, sources):
            available = f" (declared: {', '.join(declared)})" if declared else "; the robot declares none"
            lines.append(shortened(f"no file uses the argument `{name}`" + (did_you_mean(name, declared) or available)))
    return lines
