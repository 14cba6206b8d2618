"""One run of xacro: the functions and variables it is lent, and the notes it takes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from urdfkit.description.xacro.dom_edits import replace
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xacro.expressions.evaluation import Evaluator
from urdfkit.description.xacro.expressions.excess import (
    MAX_CHARACTERS,
    MAX_EXPANDED,
    MAX_INCLUDES,
    MAX_MACRO_CALLS,
    TooLarge,
    TooMany,
    check_length,
    excess,
)
from urdfkit.description.xacro.faults import Fault, MacroDefinition, Warned
from urdfkit.description.xacro.recursion import MAX_INCLUDE_DEPTH, MAX_MACRO_DEPTH, Endless, cycle
from urdfkit.description.xacro.substitution import Substitution
from urdfkit.description.xml.element import Element, Stamp, stamp_of
from urdfkit.description.xml.reader import absolute, element_of, read_source, shown_path, stamped_document
from urdfkit.description.xml.source import Expansion, Position, Source
from urdfkit.errors import ResourceError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Any
    from xml.dom import minidom

    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xacro.xacro_frames import Place


class Run(Substitution):
    """One expansion of one file.

    Args:
        path: as the user named it; appears in the banner of the output.
        arguments: values for ``$(arg …)``.
        packages: resolves ``$(find …)``.
        texts: contents to read instead of those on disk, by absolute path.
    """

    HOOKS: tuple[str, ...] = (
        "abs_filename_spec",
        "eval_extension",
        "eval_text",
        "grab_macro",
        "grab_property",
        "handle_macro_call",
        "parse",
        "print_location",
        "replace_node",
        "resolve_macro",
        "safe_eval",
        "warning",
    )
    """The functions of xacro that the methods of the same name stand in for."""

    def __init__(
        self, path: str, arguments: Mapping[str, str], packages: Packages, *, texts: Mapping[str, str] | None = None
    ) -> None:
        self.path = path
        self.arguments = arguments
        self.packages = packages
        self.texts = texts
        self.sources: dict[str, Source] = {}
        self.files: dict[Path, None] = {}
        self.macros: dict[str, MacroDefinition] = {}
        self.properties: dict[str, Position] = {}
        self.warnings: list[Warned] = []
        self.faults: dict[Any, Fault] = {}
        self.document: minidom.Document | None = None
        self.root: Element | None = None
        self.missing_package: str | None = None
        self._written: dict[tuple[str, str], Stamp] = {}
        self._calling: minidom.Element | None = None
        self.body: minidom.Element | None = None
        self.chain: tuple[Expansion, ...] | None = None
        self._calls = self._parsed = self._expanded = 0

    def take(self, xacro: ModuleType) -> dict[str, Any]:
        """Take stock of xacro and return what its globals shall be during this run."""
        from xml.dom import minidom

        self.xacro: Any = xacro
        self.evaluator = Evaluator(xacro.XacroException)
        hooks = {name: getattr(self, name) for name in self.HOOKS}
        self.stock = {name: getattr(xacro, name) for name in hooks}
        symbols = xacro.create_global_symbols()
        dict.__setitem__(symbols["python"], "vars", self._refuse_vars)
        for level in ("message", "warning", "error"):
            dict.__setitem__(symbols["xacro"], level, self._speaker(level))
        dict.__setitem__(symbols["xacro"], "tokenize", self._tokenize)
        dict.__setitem__(symbols["xacro"], "print_location", lambda *_, **__: "")
        empty = minidom.Text()
        empty.data = "\n\n"
        empty.ownerDocument = xacro._empty_text_node.ownerDocument
        return {
            "filestack": [self.path],
            "macrostack": [],
            "root_dir": os.curdir,
            "all_includes": [],
            "verbosity": 1,
            "substitution_args_context": {"arg": {}},
            "_empty_text_node": empty,
            "_global_symbols": symbols,
            **hooks,
        }

    def expand(self) -> None:
        """Expand the file; xacro's globals have to be lent.

        Raises:
            ResourceError: the file cannot be read.
            XmlError: it is no safe XML.
        """
        self.document = self.stamped(self._read(Path(self.path)))
        self.xacro.process_doc(self.document, mappings=dict(self.arguments), verbosity=1)
        for included in self.xacro.all_includes:
            self.files.setdefault(absolute(included))
        # Here and not in `outcome`: macros may nest deeper than Python allows outside.
        document_element = self.document.documentElement
        self.root = element_of(document_element) if document_element is not None else None

    def outcome(self) -> Expanded:
        """Return what came of it."""
        return Expanded(
            path=Path(self.path),
            root=self.root,
            files=tuple(self.files),
            sources=self.sources,
            packages=self.packages,
            faults=tuple(self.faults.values()),
            macros=MappingProxyType(self.macros),
            properties=MappingProxyType(self.properties),
            warnings=tuple(self.warnings),
            _print=self.printed,
        )

    def printed(self) -> str:
        """Return the document as stock xacro prints it, under its banner."""
        from urdfkit.description.xml.printing import printed

        return printed(self.document, self.path) if self.document is not None else ""

    def position_of(self, node: minidom.Element | None) -> tuple[Position, tuple[Expansion, ...]]:
        """Return where an element was written and its chain of calls; the top of the file when there is no element."""
        if node is None:
            return Position(shown_path(self.path), 1, 1), ()
        stamp = stamp_of(node)
        return Position(*stamp[:3]), stamp[3]

    def where(self, place: Place) -> tuple[Position, tuple[Expansion, ...], str | None]:
        """Return position, chain of calls and attribute of what xacro was at; a property's value is at the property."""
        if place.property is not None:
            name, table = place.property
            if (stamp := self._written.get((name, str(dict.get(table, name))))) is not None:
                return Position(*stamp[:3]), stamp[3], "value"
        return (*self.position_of(place.node), place.attribute)

    def stamped(self, source: Source) -> minidom.Document:
        """Read a file into the document that xacro works on."""
        return self.read_document(source)

    def read_document(self, source: Source) -> minidom.Document:
        """Read a well-formed file."""
        return stamped_document(source, self)

    # What xacro calls instead of its own functions of the same name.

    def parse(self, inp: Any, filename: str | None = None) -> Any:
        """Parse an included file with the stamping builder."""
        if inp is not None or filename is None:
            return self.stock["parse"](inp, filename)
        stack = self.xacro.filestack
        if len(stack) > MAX_INCLUDE_DEPTH:
            raise Endless(cycle([shown_path(name) for name in stack]), "file")
        self._parsed += 1
        if self._parsed > MAX_INCLUDES:
            stack.pop()
            raise TooMany(f"more than {MAX_INCLUDES:,} files are included: do they multiply each other?")
        try:
            source = self._read(Path(filename))
        except (OSError, ResourceError) as error:
            stack.pop()
            missing = OSError(str(error))
            missing.filename = filename
            raise self.xacro.XacroException(f"No such file or directory: {filename}", exc=missing) from error
        return self.stamped(source)

    def abs_filename_spec(self, filename_spec: str) -> str:
        """Find an included or YAML file, also in a source folder that only its installation puts in place."""
        found: str = self.stock["abs_filename_spec"](filename_spec)
        check_length(found)
        if not Path(found).exists() and (moved := self.packages.relocate(found)) is not None:
            return str(moved)
        return found

    def eval_text(self, text: str, symbols: Any) -> Any:
        """Spare the lexer what holds no expression."""
        if type(text) is str:
            if "$" not in text:
                return text
            self.evaluator.count(text.count("$"))
        value = self.stock["eval_text"](text, symbols)
        if type(value) is str and len(value) > MAX_CHARACTERS:
            raise excess("a text", MAX_CHARACTERS, "characters")
        return value

    def safe_eval(self, expr: str, globals: Any, locals: Any = None) -> Any:
        """Evaluate ``${…}``, kept from reaching the machine."""
        return self.evaluator.safe_eval(expr, globals, locals)

    def resolve_macro(self, fullname: str, macros: Any, symbols: Any) -> Any:
        """Resolve a macro; its body is cloned next."""
        found = self.stock["resolve_macro"](fullname, macros, symbols)
        self._begin_call(fullname, found[2])
        return found

    def handle_macro_call(self, node: minidom.Element, macros: Any, symbols: Any) -> Any:
        """Expand a macro call and keep the chain of calls."""
        if not node.tagName.startswith("xacro:"):
            return False
        if node.tagName == "xacro:call":
            return self.stock["handle_macro_call"](node, macros, symbols)
        self._calls += 1
        stack = self.xacro.macrostack
        if len(stack) >= MAX_MACRO_DEPTH:
            raise Endless(cycle([macro.body.getAttribute("name") for macro in stack]), "macro")
        if self._calls > MAX_MACRO_CALLS:
            raise TooMany(
                f"with this call, there are more than {MAX_MACRO_CALLS:,} calls: do macros multiply each other?"
            )
        outer, self._calling = self._calling, node
        try:
            return self.stock["handle_macro_call"](node, macros, symbols)
        finally:
            self._calling = outer

    def handle(self, _: int, key: str, stamp: Stamp, node: Any, clone: Any) -> None:
        """Stamp a clone: DOM user data handler of the stamps."""
        self.count(1 + len(node._attrs or ()))
        if self.chain is None:
            clone.setUserData(key, stamp, self)
            return
        clone.setUserData(key, (*stamp[:3], self.chain), self)
        # minidom tells of an element after all below it, so with the body itself its clone is complete.
        if node is self.body:
            self.end_call()

    def count(self, cloned: int) -> None:
        """Count the elements and attributes that are cloned.

        Raises:
            TooMany: there are too many by now.
        """
        self._expanded += cloned
        if self._expanded > MAX_EXPANDED:
            what = f"more than {MAX_EXPANDED:,} elements and attributes"
            raise TooMany(f"with this, macros, blocks and includes make {what}: do they multiply each other?")

    def end_call(self) -> None:
        """Note that the body of the macro that is called has been cloned."""
        self.chain = self.body = None

    def replace_node(self, node: minidom.Element, by: Any, content_only: bool = False) -> None:
        """Put what is in elements in the place of another: all at once, where minidom looks for the place of each."""
        if by is None or not content_only:
            self.stock["replace_node"](node, by, content_only)
            return
        replace(node, by if isinstance(by, list) else [by])

    def grab_macro(self, elt: minidom.Element, macros: Any) -> None:
        """Note where a macro is defined."""
        self.stock["grab_macro"](elt, macros)
        name = elt.getAttribute("name").removeprefix("xacro:")
        macro = macros[name]
        self.macros[name] = MacroDefinition(
            name, self.position_of(elt)[0], tuple(macro.params), frozenset(macro.defaultmap)
        )

    def grab_property(self, elt: minidom.Element, table: Any) -> None:
        """Note where a property is defined."""
        name, stamp = elt.getAttribute("name"), stamp_of(elt)
        self.properties[name] = Position(*stamp[:3])
        for attribute in ("value", "default"):
            if elt.hasAttribute(attribute):
                self._written[(name, elt.getAttribute(attribute))] = stamp
        self.stock["grab_property"](elt, table)

    def warning(self, *words: object, **_: object) -> None:
        """Note a warning."""
        self._speak("warning", words)

    def print_location(self) -> None:
        """Keep silent: a warning has its position."""

    def _read(self, path: Path) -> Source:
        if path.is_dir():
            raise ResourceError(f"{path} is a folder, not a description")
        shown = shown_path(path)
        self.files.setdefault(absolute(path))
        source = self.sources.get(shown)
        if source is None:
            source = read_source(path, shown_as=shown, texts=self.texts)
            self.sources[shown] = source
        return source

    def _begin_call(self, name: str, macro: Any) -> None:
        if self._calling is not None:
            position, outer = self.position_of(self._calling)
            self.chain, self.body = (Expansion(name, position), *outer), macro.body

    def _refuse_vars(self, *_: object) -> None:
        raise self.xacro.XacroException("vars() is not available: it looks inside Python's own objects")

    def _tokenize(self, s: str, sep: str = ",; ", skip_empty: bool = True) -> Any:
        # xacro puts the separators into a regular expression between brackets.
        if "]" in sep[1:]:
            raise TooLarge("a `]` among the separators of tokenize() makes any regular expression of them")
        return self.xacro.tokenize(s, sep, skip_empty)

    def _speaker(self, level: str) -> Any:
        def speak(*words: object, **_: object) -> str:
            self._speak(level, words)
            return ""

        return speak

    def _speak(self, level: Any, words: tuple[object, ...]) -> None:
        import sys

        from urdfkit.description.xacro.xacro_frames import place_of_call

        place = place_of_call(sys._getframe(1))
        position, expansions = self.position_of(place.node)
        self.warnings.append(Warned(" ".join(map(str, words)), position, expansions, level))
