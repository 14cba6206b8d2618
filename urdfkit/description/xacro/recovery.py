"""A run of xacro that goes on after errors: every fault is noted, mended in memory, and the rest expanded.

What could not be evaluated becomes `Unknown`, which holds its expression and silently spoils what is computed from it,
so that one cause makes one fault. What is defined too late is known by hindsight: the file is expanded again with the
values that the first pass came to in the end.
"""

from __future__ import annotations

import sys

from urdfkit.description.xacro.diagnosis import defined_in, fault_of, undefined_macro, undefined_property
from urdfkit.description.xacro.dom_edits import child_at_fault, drop
from urdfkit.description.xacro.fault_record import NotingRun
from urdfkit.description.xacro.faults import Unprefixed
from urdfkit.description.xacro.macro_calls import LEFT_OUT, fitted, is_call_of, near_macro
from urdfkit.description.xacro.missing_prefix import looks_like_a_call, mend_directives, rename
from urdfkit.description.xacro.misspelt_directives import mend_spelling
from urdfkit.description.xacro.placeholders import FallbackSymbols, Unknown, peek
from urdfkit.description.xacro.xacro_frames import Place, place_of_call
from urdfkit.description.xml.reader import shown_path, stamped_document
from urdfkit.description.xml.source import Position, Source
from urdfkit.description.xml.vocabulary import TAGS
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Any
    from xml.dom import minidom


_MAX_DROPPED = 1_000
"""Give up on an element after so many of its children had to be dropped."""


class RecoveringRun(NotingRun):
    """One expansion that goes on after errors: what xacro calls mends what is wrong."""

    HOOKS = (*NotingRun.HOOKS, "eval_all", "get_boolean_value", "process_include")

    _included = ""
    _evaluating = _level = 0
    _found_unknown = _missed = False

    def take(self, xacro: ModuleType) -> dict[str, Any]:
        """Lend the recovering functions too."""
        lent = super().take(xacro)
        lent["_global_symbols"] = FallbackSymbols(lent["_global_symbols"], self.missing_symbol)
        return lent

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
            if error.cause != "unbound prefix":
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


def _too_late(what: str, name: str, at: Position | None) -> str:
    return f"{what} `{name}` is used before it is defined{f', at {at}' if at else ''}"
