"""Macros: their definitions and calls."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xacro.evaluation.directive_base import Elements
from urdfkit.description.xacro.evaluation.expressions.limits import MAX_MACRO_CALLS, MAX_MACRO_DEPTH
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope
from urdfkit.description.xacro.evaluation.failures import (
    Failure,
    cycle,
    macro_arguments,
    recursive_macro,
    undefined_default,
    undefined_macro,
)
from urdfkit.description.xacro.evaluation.parameters import MacroParameter, parameters
from urdfkit.description.xacro.evaluation.tree import Tag
from urdfkit.description.xacro.faults import MacroDefinition
from urdfkit.description.xml.source import Expansion

TYPE_CHECKING = False
if TYPE_CHECKING:
    Steps = Iterator["Steps"]


class Macro:
    """A macro.

    Attributes:
        body: its ``<xacro:macro>`` element.
        parameters: by name, in order.
    """

    def __init__(self) -> None:
        self.body: Tag | None = None
        self.parameters: list[MacroParameter] = []


class Calls(Elements):
    """Defines and calls macros.

    Attributes:
        macros: every macro that was defined, by name (the last definition).
    """

    macros: dict[str, MacroDefinition]
    _stack: list[Macro]
    _calls = 0

    def _element(self, tag: Tag, macros: Scope, scope: Scope) -> Steps:
        raise NotImplementedError

    def _macro(self, node: Tag, macros: Scope, scope: Scope) -> None:
        self._remove_comments_before(node)
        name, text = self._checked(node, ("name",), ("params",))
        if name == "call":
            raise self.placed(Failure("other", "Invalid use of macro name 'call'"))
        if "." in name:
            message = f"macro names must not contain '.' (reserved for namespaces): {name}"
            raise self.placed(Failure("other", message))
        if name.startswith("xacro:"):
            self.warn(f"macro names must not contain prefix 'xacro:': {name}")
            name = name[6:]
        macro = macros.values.get(name)
        if not isinstance(macro, Macro):
            macro = Macro()
        macro.body = node
        try:
            macro.parameters = list(parameters(text or ""))
        except ValueError as error:
            raise self.placed(Failure("other", str(error))) from None
        macros.set(name, macro, is_lazy=False)
        node.remove()
        names = tuple(parameter.name for parameter in macro.parameters)
        optional = frozenset(parameter.name for parameter in macro.parameters if parameter.has_default)
        self.macros[name] = MacroDefinition(name, node.position, names, optional)

    def _call(self, node: Tag, macros: Scope, scope: Scope) -> Steps:
        while node.tag == "xacro:call":
            name = self._required(node, "macro")
            if not name:
                raise self.placed(Failure("other", "xacro:call is missing the 'macro' attribute"))
            self.at = (node, "macro")
            node.tag = f"xacro:{self.text(name, scope)}"
            del node.attributes["macro"]
            self.at = (node, None)
        name, outer_macros, outer_scope, macro = self._found(node.tag[6:], node, macros, scope)
        self._calls += 1
        if len(self._stack) >= MAX_MACRO_DEPTH:
            names = [str(macro.body.attributes.get("name", "")) for macro in self._stack if macro.body is not None]
            raise self.placed(recursive_macro(cycle(names)))
        if self._calls > MAX_MACRO_CALLS:
            what = f"this call exceeds the limit of {MAX_MACRO_CALLS:,} macro calls; check for nested macro calls"
            raise self.placed(Failure("too-many", what))
        assert macro.body is not None
        body = macro.body.copy((Expansion(name, node.position), *node.chain), self.count)
        title = str(macro.body.attributes.get("name", ""))
        inner_scope, inner_macros = Scope(outer_scope), Scope(outer_macros)
        names = [parameter.name for parameter in macro.parameters]
        candidates = list(names)
        self._stack.append(macro)
        try:
            for parameter, value in list(node.attributes.items()):
                if parameter not in names:
                    self.at = (node, None)
                    raise self.placed(macro_arguments(title, (), (parameter,), candidates))
                names.remove(parameter)
                self.at = (node, parameter)
                inner_scope.set(parameter, self.text(value, scope), is_lazy=False)
                node.attributes[parameter] = ""
            yield self._element(node, macros, scope)
            self.at = (node, None)
            self._take_blocks(node, names, inner_scope, title)
            self._take_defaults(macro, names, inner_scope, scope, node)
            if names:
                raise self.placed(macro_arguments(title, tuple(names), (), candidates))
            yield self._element(body, inner_macros, inner_scope)
        finally:
            self._stack.pop()
        self.at = (node, None)
        self._remove_comments_before(node)
        self._import_namespaces(node.parent, body)
        node.replace([body])

    def _found(self, name: str, node: Tag, macros: Scope, scope: Scope) -> tuple[str, Scope, Scope, Macro]:
        """Return the name of the macro that an element calls, the names that its body can use, and the macro.

        Raises:
            Failure: it is not defined.
        """
        try:
            return name, *found_macro(name, macros, scope)
        except KeyError:
            raise self.placed(undefined_macro(name, self.visible(macros))) from None

    def _take_blocks(self, node: Tag, names: list[str], scope: Scope, title: str) -> None:
        blocks = node.tags()
        for name in [name for name in names if name.startswith("*")]:
            block = next(blocks, None)
            if block is None:
                message = f"macro `{title}` needs more blocks inside its call"
                raise self.placed(Failure("macro-arguments", message, name=title))
            names.remove(name)
            scope.set(name, block, is_lazy=False)
        if (unused := next(blocks, None)) is not None:
            message = f"macro `{title}` accepts no further block `<{unused.tag}>`"
            raise self.placed(Failure("macro-arguments", message, name=title))

    def _take_defaults(self, macro: Macro, names: list[str], inner: Scope, scope: Scope, node: Tag) -> None:
        defaults = {parameter.name: parameter for parameter in macro.parameters if parameter.has_default}
        for name in [name for name in names if not name.startswith("*")]:
            self.at = (macro.body, "params")
            parameter = defaults.get(name)
            if parameter is None or not (parameter.is_forwarded or parameter.default is not None):
                continue
            if parameter.is_forwarded and name in scope:
                value = scope[name]
            elif parameter.default is not None:
                value = self.text(parameter.default, scope)
            else:
                self.at = (node, None)
                title = str(node.tag).removeprefix("xacro:")
                raise self.placed(undefined_default(name, title, self.visible(scope)))
            self.at = (node, None)
            inner.set(name, value, is_lazy=False)
            names.remove(name)
        self.at = (node, None)


def found_macro(name: str, macros: Scope, scope: Scope) -> tuple[Scope, Scope, Macro]:
    """Return a macro, and the names that its body can use.

    Raises:
        KeyError: it is not defined.
    """
    *spaces, last = [name] if name in macros else name.split(".")
    for space in spaces:
        inner, values = macros[space], scope[space]
        if not isinstance(inner, Scope) or not isinstance(values, Scope):
            raise KeyError(name)
        macros, scope = inner, values
    macro = macros[last]
    if not isinstance(macro, Macro):
        raise KeyError(name)
    return macros, scope, macro
