"""A run of xacro that goes on after errors: every fault is noted, mended in memory, and the rest expanded.

What could not be evaluated becomes `Unknown`, which holds its expression and silently spoils what is computed from it,
so that one cause makes one fault. What is defined too late is known by hindsight: the file is expanded again with the
values that the first pass came to in the end.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping

from urdfkit.description.calls import LEFT_OUT, fitted, is_call_of, near_macro
from urdfkit.description.diagnosis import defined_in, fault_of, undefined_macro, undefined_property
from urdfkit.description.endless import Endless
from urdfkit.description.expanded import Expanded
from urdfkit.description.faults import Fault, Unprefixed
from urdfkit.description.frames import Place, place_of_call
from urdfkit.description.grafting import child_at_fault, drop
from urdfkit.description.prefixes import looks_like_a_call, mend_directives, rename
from urdfkit.description.reading import shown_path, stamped_document
from urdfkit.description.run import Run
from urdfkit.description.source import Position, Source
from urdfkit.description.spelling import mend_spelling
from urdfkit.description.too_large import TooMany
from urdfkit.description.unknown import FallbackSymbols, Unknown, peek
from urdfkit.description.vocabulary import TAGS
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Any
    from xml.dom import minidom

    from urdfkit.description.packages import Packages

_MAX_DROPPED = 1_000
"""Give up on an element after so many of its children had to be dropped."""


class RecoveringRun(Run):
    """One expansion that goes on after errors.

    Args:
        path: as the user named it.
        arguments: values for ``$(arg …)``.
        packages: resolves ``$(find …)``.
        mend_prefixes: read directives and macro calls without ``xacro:`` as if they had it.
        hindsight: values of properties, and macros, that an earlier run found defined too late.
        texts: contents to read instead of those on disk, by absolute path.
    """

    HOOKS = (*Run.HOOKS, "eval_all", "get_boolean_value", "process_include")

    def __init__(
        self,
        path: str,
        arguments: Mapping[str, str],
        packages: Packages,
        *,
        mend_prefixes: bool,
        hindsight: tuple[Mapping[str, Any], Mapping[str, Any]] = ({}, {}),
        texts: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(path, arguments, packages, texts=texts)
        self._mend_prefixes = mend_prefixes
        self.hindsight = self._late_properties, self._late_macros = hindsight
        self._unprefixed: dict[Unprefixed, None] = {}
        self._unresolved: set[tuple[Position, str | None]] = set()
        self._strangers: set[str] = set()
        self._included = ""
        self._endless: set[str] = set()
        self._tables: tuple[Any, Any] | None = None
        self._evaluating = 0
        self._is_full = False
        self._level = 0
        self._found_unknown = False

    def take(self, xacro: ModuleType) -> dict[str, Any]:
        """Lend the recovering functions too."""
        lent = super().take(xacro)
        lent["_global_symbols"] = FallbackSymbols(lent["_global_symbols"], self.missing_symbol)
        return lent

    def expand(self) -> None:
        """Expand the file as far as it goes; xacro's globals have to be lent.

        Raises:
            ResourceError: the file cannot be read.
        """
        try:
            super().expand()
        except XmlError as error:
            self._note(fault_of(error, self, sys._getframe()))
        self._learn()

    def with_hindsight(self) -> RecoveringRun | None:
        """Return a run that knows what this one found defined too late; None when there is nothing new."""
        properties, macros = self._learned
        if self._is_full or self.evaluator.is_exhausted:
            return None
        if properties.keys() <= self._late_properties.keys() and macros.keys() <= self._late_macros.keys():
            return None
        return RecoveringRun(
            self.path,
            self.arguments,
            self.packages,
            mend_prefixes=self._mend_prefixes,
            hindsight=({**self._late_properties, **properties}, {**self._late_macros, **macros}),
            texts=self.texts,
        )

    def outcome(self) -> Expanded:
        """Return what came of it, with the faults."""
        plain = super().outcome()
        return Expanded(
            **{**vars(plain), "unprefixed": tuple(self._unprefixed), "unresolved": frozenset(self._unresolved)}
        )

    # What xacro calls instead of its own functions of the same name.

    def abs_filename_spec(self, filename_spec: str) -> str:
        """Remember whether the path could be evaluated."""
        self._included = filename_spec
        return super().abs_filename_spec(filename_spec)

    def stamped(self, source: Source) -> minidom.Document:
        """Read a file, directives without prefix as if they had one."""
        try:
            document = super().stamped(source)
        except XmlError as error:
            if not error.message.startswith("unbound prefix"):
                raise
            self._note(fault_of(error, self))
            document = stamped_document(source, self, namespaces=False)
        if self._mend_prefixes:
            for fault in mend_spelling(document, self.position_of):
                self._note(fault)
            for element, tag in mend_directives(document):
                position, expansions = self.position_of(element)
                self._unprefixed.setdefault(Unprefixed("directive", tag, position, expansions))
        return document

    def eval_all(self, node: minidom.Element, macros: Any, symbols: Any) -> None:
        """Evaluate an element; drop the children that cannot be."""
        if self._tables is None:
            self._tables = macros, symbols
        self._level += 1
        try:
            self._eval_all(node, macros, symbols)
        finally:
            self._level -= 1

    def _eval_all(self, node: minidom.Element, macros: Any, symbols: Any) -> None:
        for _ in range(_MAX_DROPPED):
            depth = len(self.xacro.filestack), len(self.xacro.macrostack)
            try:
                self.stock["eval_all"](node, macros, symbols)
                return
            except Exception as error:
                if self._goes_up(error, depth[0], is_inside=self._level > 1):
                    raise
                child = child_at_fault(error, node)
                self._note(self._fault(error, child))
                self._unwind(depth)
                if not drop(child, node):
                    return

    def eval_text(self, text: str, symbols: Any) -> Any:
        """Evaluate text, to `Unknown` when that fails."""
        if "$" not in text:
            return Unknown(f"${{{text[len(LEFT_OUT) :]}}}") if text.startswith(LEFT_OUT) else text
        outer, self._found_unknown = self._found_unknown, False
        try:
            value = super().eval_text(text, symbols)
            if self._found_unknown and not isinstance(value, Unknown):
                value = Unknown(value)
        except Exception as error:
            if not self._found_unknown:
                self._note(fault_of(error, self, sys._getframe()))
            value = Unknown(text)
        finally:
            self._found_unknown = outer
        if isinstance(value, Unknown):
            self._found_unknown = True
            self._mark_unresolved()
        return value

    def safe_eval(self, expr: str, globals: Any, locals: Any = None) -> Any:
        """Evaluate an expression, to `Unknown` when it needs something unknown."""
        if self.evaluator.is_exhausted:
            self._found_unknown = True
            return Unknown(f"${{{expr}}}")
        names = self.evaluator.names(expr)
        for name in names:
            if isinstance(value := peek(globals, name), Unknown):
                self._found_unknown = True
                return value if len(names) == 1 and name == expr.strip() else Unknown(f"${{{expr}}}")
        missed, self._missed = self._missed, False
        self._evaluating += 1
        try:
            value = super().safe_eval(expr, globals, locals)
        except Exception:
            if not self._missed:
                raise
            value = None
        finally:
            self._evaluating -= 1
            was_missed, self._missed = self._missed, missed
        if was_missed or isinstance(value, Unknown):
            self._found_unknown = True
            return Unknown(f"${{{expr}}}")
        return value

    _missed = False

    def missing_symbol(self, name: str) -> Any:
        """Return the value of a property that is not defined (yet), and note it.

        Raises:
            KeyError: nothing is being evaluated; somebody only asks whether it is there.
        """
        if not self._evaluating or name.startswith("__"):
            raise KeyError(name)
        place = place_of_call(sys._getframe(1))
        facts = undefined_property(name, place)
        if name in self._late_properties:
            at = self.properties.get(name) or defined_in(self, "undefined-property", name)
            self._note_at(place, {**facts, "defined_at": at, "message": _too_late("property", name, at)})
            return self._late_properties[name]
        self._note_at(place, facts)
        self._missed = True
        return Unknown(f"${{{name}}}")

    def get_boolean_value(self, value: Any, condition: Any) -> bool:
        """Take an unknown condition as true."""
        if condition is not None and isinstance(value, Unknown):
            return True
        return bool(self.stock["get_boolean_value"](value, condition))

    def process_include(self, elt: minidom.Element, macros: Any, symbols: Any, func: Any) -> None:
        """Include a file, or drop the include when that fails."""
        depth = len(self.xacro.filestack), len(self.xacro.macrostack)
        parent = elt.parentNode
        if shown_path(self.xacro.filestack[-1]) in self._endless:
            drop(elt, parent)
            return
        try:
            self.stock["process_include"](elt, macros, symbols, func)
        except Exception as error:
            if self._goes_up(error, depth[0], is_inside=depth[0] > 1):
                raise
            fault = self._fault(error, elt)
            # A path that could not be evaluated has its fault already.
            if fault.kind != "include-not-found" or not isinstance(self._included, Unknown):
                self._note(fault)
            self._unwind(depth)
            drop(elt, parent)

    def handle_macro_call(self, node: minidom.Element, macros: Any, symbols: Any) -> Any:
        """Expand a macro call, mended where it does not fit its macro."""
        tag = node.tagName
        if not tag.startswith("xacro:"):
            if not self._mend_prefixes or tag in TAGS:
                return False
            macro = self._macro(tag, macros, symbols)
            if macro is None:
                self._strangers.add(tag)
            if not looks_like_a_call(node, macro):
                return False
            position, expansions = self.position_of(node)
            self._unprefixed.setdefault(Unprefixed("call", tag, position, expansions))
            tag = rename(node)
        depth = len(self.xacro.filestack), len(self.xacro.macrostack)
        parent = node.parentNode
        if tag[6:] in self._endless or self._is_full:
            return drop(node, parent)
        try:
            if tag != "xacro:call":
                macro = self._macro(tag[6:], macros, symbols)
                if macro is not None:
                    for fault in fitted(node, macro, self.position_of):
                        self._note(fault)
            return super().handle_macro_call(node, macros, symbols)
        except Exception as error:
            if self._goes_up(error, depth[0], is_inside=depth[1] > 0):
                raise  # what is dropped is the call that a person wrote
            self._note(self._fault(error, node))
            self._unwind(depth)
            drop(node, parent)
            return True

    def resolve_macro(self, fullname: str, macros: Any, symbols: Any) -> Any:
        """Resolve a macro, also one that is defined only later."""
        try:
            return super().resolve_macro(fullname, macros, symbols)
        except KeyError:
            if fullname not in self._late_macros or self._tables is None:
                return self._resolve_near(fullname, macros, symbols, place_of_call(sys._getframe(1)))
            at = self.position_of(self._late_macros[fullname].body)[0]
            place = place_of_call(sys._getframe(1))
            facts = {**undefined_macro(fullname, place), "defined_at": at, "message": _too_late("macro", fullname, at)}
            self._note_at(place, facts)
            self._begin_call(fullname, self._late_macros[fullname])
            return (*self._tables, self._late_macros[fullname])

    def _resolve_near(self, fullname: str, macros: Any, symbols: Any, place: Place) -> Any:
        """Resolve the macro that a misspelt call must mean, as its parameters are given.

        Raises:
            KeyError: there is none.
        """
        for near in near_macro(fullname, place.macro_names()):
            found = self.stock["resolve_macro"](near, macros, symbols)
            if is_call_of(found[2], self._calling):
                facts = undefined_macro(fullname, place)
                self._note_at(place, {**facts, "details": {"meant": near}})
                self._begin_call(near, found[2])
                return found
        raise KeyError(fullname)

    def _macro(self, name: str, macros: Any, symbols: Any) -> Any:
        try:
            return self.stock["resolve_macro"](name, macros, symbols)[2]
        except (KeyError, TypeError):
            return self._late_macros.get(name)

    def _learn(self) -> None:
        """Remember the values of what was undefined when used and is defined by now."""
        properties: dict[str, Any] = {}
        macros: dict[str, Any] = {}
        self._learned = properties, macros
        if self._tables is None:
            return
        table_of_macros, table = self._tables
        for kind, name in {(fault.kind, fault.name): None for fault in self.faults.values() if fault.name}:
            if kind == "undefined-property" and dict.__contains__(table, name):
                value = table[name]
                if not isinstance(value, Unknown):
                    properties[name] = value
            elif kind == "undefined-macro" and dict.__contains__(table_of_macros, name):
                macros[name] = dict.__getitem__(table_of_macros, name)
        for name in self._strangers:
            if dict.__contains__(table_of_macros, name):
                macros[name] = dict.__getitem__(table_of_macros, name)

    def _fault(self, error: Exception, node: Any) -> Fault:
        """Diagnose what was raised; which of too many elements, or rounds, was the last is of no interest."""
        if isinstance(error, TooMany) and node is not None:
            return Fault("too-many", str(error), *self.position_of(node))
        fault = fault_of(error, self, sys._getframe(1))
        if isinstance(error, Endless) and error.what == "file":
            return Fault(**{**vars(fault), "position": self.position_of(node)[0]})
        return fault

    def _goes_up(self, error: Exception, files: int, *, is_inside: bool) -> bool:
        """Return whether an error is dealt with further out: what is dropped is what a person wrote, with all it made.

        Args:
            error: what was raised.
            files: how many files include each other here; where one of them does so twice, a round has begun again.
            is_inside: whether this is inside what a person wrote.
        """
        if isinstance(error, Endless) and error.what == "file":
            open_files = [shown_path(file) for file in self.xacro.filestack[:files]]
            return len(set(open_files)) < len(open_files)
        return isinstance(error, TooMany | RecursionError) and is_inside

    def _note(self, fault: Fault) -> None:
        if fault.kind == "too-many":
            if self._is_full:
                return
            self._is_full = True
        # What calls itself twice would be tried a power of two times.
        self._endless.update(fault.details.get("cycle", ()) if fault.kind == "recursion" else ())
        key = (fault.kind, fault.position, fault.attribute, fault.name, fault.message, fault.expansions)
        self.faults.setdefault(key, fault)

    def _note_at(self, place: Place, facts: dict[str, Any]) -> None:
        position, expansions, attribute = self.where(place)
        expression = place.expression
        self._note(Fault(position=position, expansions=expansions, attribute=attribute, expression=expression, **facts))

    def _mark_unresolved(self) -> None:
        place = place_of_call(sys._getframe(2))
        if place.node is not None and place.property is None:
            self._unresolved.add((self.position_of(place.node)[0], place.attribute))

    def _unwind(self, depth: tuple[int, int]) -> None:
        """Forget the files and macros that an error left open."""
        del self.xacro.filestack[depth[0] :]
        del self.xacro.macrostack[depth[1] :]
        self.end_call()


def _too_late(what: str, name: str, at: Position | None) -> str:
    return f"{what} `{name}` is used before it is defined{f', at {at}' if at else ''}"
