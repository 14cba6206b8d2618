"""Calls of macros that are misspelt, lack the prefix ``xacro:``, or come before the definition."""

from __future__ import annotations

from urdfkit.description.xacro.evaluation.evaluator import Evaluator
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope
from urdfkit.description.xacro.evaluation.failures import Failure
from urdfkit.description.xacro.evaluation.macros import Macro, found_macro
from urdfkit.description.xacro.evaluation.tree import Tag
from urdfkit.description.xacro.faults import Fault, Unprefixed
from urdfkit.description.xacro.recovery.call_repairs import fit, is_call_of, near_macros
from urdfkit.description.xacro.recovery.missing_prefix import looks_like_a_call, rename
from urdfkit.description.xacro.recovery.unknown_values import Recorded
from urdfkit.description.xml.known_tags import TAGS
from urdfkit.description.xml.source import Position
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.xacro.evaluation.evaluator import Steps


class LateDefinitions:
    """What earlier passes found defined after its use.

    Attributes:
        properties: name → value and place of the definition.
        macros: name → macro.
    """

    def __init__(self) -> None:
        self.properties: dict[str, tuple[Any, Position | None]] = {}
        self.macros: dict[str, Macro] = {}


class RecoveringCalls(Evaluator):
    """Expands calls of the meant macros, and records each as a fault."""

    _late: LateDefinitions
    _adds_prefixes: bool
    _unprefixed: dict[Unprefixed, None]
    _loops: set[str]
    _uncalled: set[str]
    _exceeded: set[str]
    _faults: dict[Any, Fault]

    def _record(self, failure: Failure | XmlError) -> None:
        raise NotImplementedError

    def _child(self, node: Tag, macros: Scope, scope: Scope) -> Steps:
        if self._adds_prefixes and node.tag not in TAGS and not node.tag.startswith("xacro:"):
            macro = self._macro_named(node.tag, macros, scope)
            if macro is None:
                self._uncalled.add(node.tag)
            elif looks_like_a_call(node, [parameter.name for parameter in macro.parameters]):
                self.untraced += 1
                self._unprefixed.setdefault(Unprefixed("call", node.tag, node.position, node.chain))
                rename(node)
        return super()._child(node, macros, scope)

    def _macro_named(self, name: str, macros: Scope, scope: Scope) -> Macro | None:
        try:
            return found_macro(name, macros, scope)[2]
        except KeyError:
            return self._late.macros.get(name)

    def _found(self, name: str, node: Tag, macros: Scope, scope: Scope) -> tuple[str, Scope, Scope, Macro]:
        """Return the macro that an element calls, also if it is misspelt or defined later; fit the call to it."""
        if name in self._loops or "elements" in self._exceeded or "$" in name:  # a computed name whose value is unknown
            raise Recorded
        try:
            found = super()._found(name, node, macros, scope)
        except Failure as failure:
            found = self._meant(failure, name, node, macros, scope)
        for wrong in fit(node, found[3]):
            self._record(wrong)
        return found

    def _meant(
        self, failure: Failure, name: str, node: Tag, macros: Scope, scope: Scope
    ) -> tuple[str, Scope, Scope, Macro]:
        macro = self._late.macros.get(name)
        if macro is not None and macro.body is not None:
            mark_late(failure, "macro", name, macro.body.position)
            self._record(failure)
            return name, self.top_macros, self.top_scope, macro
        is_broken = any(each.kind == "xml" for each in self._faults.values())  # and that file may define the macro
        for near in near_macros(name, failure.facts.get("candidates", ())) if not is_broken else ():
            try:
                inner_macros, inner_scope, macro = found_macro(near, macros, scope)
            except KeyError:
                continue
            if is_call_of(node, macro):
                failure.facts["details"] = {"meant": near}
                self._record(failure)
                return near, inner_macros, inner_scope, macro
        raise failure


def mark_late(failure: Failure, what: str, name: str, place: Position | None) -> None:
    """Add to the failure of an undefined name the place of its later definition."""
    failure.message = f"{what} `{name}` is used before it is defined{f', at {place}' if place else ''}"
    failure.facts["defined_at"] = place
