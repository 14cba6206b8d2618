"""Expanded: a file after xacro; every element has the position of its source."""

from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.faults import Fault, MacroDefinition, Unprefixed, Warned
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position, Source
from urdfkit.record import field, record


@record(eq=False)
class Expanded:
    """The outcome of `expand` and `expand_leniently`.

    Attributes:
        path: the file that was expanded.
        root: the document element after expansion; None only when the entry file could not be read as XML (lenient).
        files: every file that was read, absolute, the entry first.
        sources: the text of every XML file that was read, by `Position.file`.
        packages: resolved its ``$(find …)``, and resolves the URIs of its meshes.
        faults: what went wrong (empty after a strict expansion); one per place *and* chain of macro calls.
        unprefixed: directives and calls that were read as if they had the ``xacro:`` prefix (lenient only).
        unresolved: (position, attribute) of expressions that could not be evaluated and remain in the output;
            attribute is None for text. Rules about values skip them because a fault reports them.
        macros: every macro that was defined, by name (the last definition).
        properties: every property that was defined: name → position of the last definition.
        warnings: the warnings and messages of xacro.
    """

    path: Path
    root: Element | None
    files: tuple[Path, ...]
    sources: dict[str, Source]
    packages: Packages
    faults: tuple[Fault, ...] = ()
    unprefixed: tuple[Unprefixed, ...] = ()
    unresolved: frozenset[tuple[Position, str | None]] = frozenset()
    macros: Mapping[str, MacroDefinition] = MappingProxyType({})
    properties: Mapping[str, Position] = MappingProxyType({})
    warnings: tuple[Warned, ...] = ()
    _print: Callable[[], str] = field(default=str, repr=False)

    @cached_property
    def xml(self) -> str:
        """The expanded document, byte for byte what stock xacro prints."""
        return self._print()

    @cached_property
    def documents(self) -> dict[str, Element]:
        """The unexpanded tree of every well-formed file that was read, by `Position.file`."""
        from urdfkit.description.xml.reader import document_of
        from urdfkit.errors import XmlError

        found: dict[str, Element] = {}
        for file, source in self.sources.items():
            try:
                found[file] = document_of(source)
            except XmlError:
                continue
        return found
