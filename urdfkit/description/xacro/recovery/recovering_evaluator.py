"""Expand a file and continue after failures: each is recorded, its element dropped or repaired, and the rest expanded.

A value that cannot be computed becomes `Unknown`, which holds its expression. A result computed from an unknown value
is unknown too and causes no second fault.
"""

from __future__ import annotations

from collections.abc import Mapping

from urdfkit.description.xacro.evaluation.element_conversion import element_of
from urdfkit.description.xacro.evaluation.evaluator import deep_calls
from urdfkit.description.xacro.evaluation.expressions.limits import MAX_CHARACTERS, MAX_EXPRESSIONS
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope
from urdfkit.description.xacro.evaluation.failures import Failure, definition, undefined_property
from urdfkit.description.xacro.evaluation.macros import Macro
from urdfkit.description.xacro.evaluation.texts import EXPRESSION
from urdfkit.description.xacro.evaluation.tree import Tag
from urdfkit.description.xacro.evaluation.tree_reader import read_tree
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xacro.faults import Fault, Unprefixed
from urdfkit.description.xacro.memory import Memory
from urdfkit.description.xacro.recovery.missing_prefix import add_missing_prefixes
from urdfkit.description.xacro.recovery.misspelt_directives import repair_spelling
from urdfkit.description.xacro.recovery.recovering_calls import LateDefinitions, RecoveringCalls, mark_late
from urdfkit.description.xacro.recovery.unknown_values import Arguments, Recorded, Unknown
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Position, Source
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xacro.evaluation.evaluator import Steps


class RecoveringEvaluator(RecoveringCalls):
    """One pass over a file that continues after failures.

    Args:
        path: as the user named it.
        arguments: values of ``$(arg …)``.
        packages: resolves ``$(find …)``.
        late: definitions that earlier passes found.
        add_prefixes: read directives and macro calls without ``xacro:`` as if they had it.
        texts: contents to read instead of those on disk, by absolute path.
        memory: what earlier expansions of the file read.
    """

    _collections = (*RecoveringCalls._collections, "_uncalled")

    def __init__(
        self,
        path: str,
        arguments: Mapping[str, str],
        packages: Packages,
        late: LateDefinitions,
        *,
        add_prefixes: bool,
        texts: Mapping[str, str] | None = None,
        memory: Memory | None = None,
    ) -> None:
        super().__init__(path, arguments, packages, texts=texts, memory=memory)
        self._late, self._adds_prefixes = late, add_prefixes
        self.commands.arguments = Arguments(arguments)
        self._faults: dict[Any, Fault] = {}
        self._unprefixed: dict[Unprefixed, None] = {}
        self._unresolved: set[tuple[Position, str | None]] = set()
        self._loops: set[str] = set()
        self._uncalled: set[str] = set()
        self._exceeded: set[str] = set()
        self._expression = ""
        self._expanded_tree: tuple[Tag, Tag] | None = None

    def run_all(self) -> None:
        """Expand the file.

        Raises:
            ResourceError: it cannot be read.
        """
        try:
            self._expanded_tree = self._expand_all()
        except XmlError as error:
            self._record(error)

    def learn(self) -> bool:
        """Find names that were undefined when used and are defined by now; return whether new names are found."""
        if self._exceeded or self._is_exhausted:
            return False
        late = self._late
        properties, macros = len(late.properties), len(late.macros)
        undefined = {(fault.kind, fault.name): None for fault in self._faults.values() if fault.name}
        for kind, name in (*undefined, *(("undefined-macro", name) for name in sorted(self._uncalled))):
            assert name is not None
            if kind == "undefined-property" and name in self.top_scope.values and name not in late.properties:
                with deep_calls():
                    value = self.top_scope[name]
                if type(value) is not Unknown:
                    place = definition(self.sources.values(), "property", name) or self.properties.get(name)
                    late.properties[name] = value, place
            elif kind == "undefined-macro":
                macro = self.top_macros.values.get(name)
                if isinstance(macro, Macro):
                    late.macros.setdefault(name, macro)
        return len(late.properties) > properties or len(late.macros) > macros

    def outcome(self) -> Expanded:
        """Return the result of the pass."""
        document, root = Tag("", {}, Position(self.path, 1, 1), ()), None
        if self._expanded_tree is not None:
            document, tag = self._expanded_tree
            try:
                root = element_of(tag)
            except XmlError as error:
                self._record(error)
        return self._outcome(
            document,
            root,
            faults=tuple(fault for fault in self._faults.values() if not self._repeats(fault)),
            unprefixed=tuple(self._unprefixed),
            unresolved=frozenset(self._unresolved),
        )

    # Failures

    def _repeats(self, fault: Fault) -> bool:
        """Whether a fault is in the second or a later round of macros that call each other without end."""
        if not self._loops or fault.kind == "recursion":
            return False
        calls = [call for call in fault.expansions if call.macro in self._loops]
        return len(set(calls)) < len(calls)

    def _record(self, failure: Failure | XmlError) -> None:
        if isinstance(failure, XmlError):
            assert failure.position is not None
            self._keep(Fault("xml", failure.message, failure.position, details={"cause": failure.cause}))
        elif not isinstance(failure, Recorded):
            if failure.kind == "too-many" or (failure.kind == "too-large" and self._is_exhausted):
                limit = "elements" if failure.kind == "too-many" else "expressions"
                if limit in self._exceeded:
                    return
                self._exceeded.add(limit)
            fault = self.placed(failure).fault()
            if failure.loop in ("macro", "file"):  # otherwise two calls in each round double the work of each round
                self._loops.update(fault.details["cycle"])
            self._keep(fault)

    def _keep(self, fault: Fault) -> None:
        self.untraced += 1
        key = (fault.kind, fault.position, fault.attribute, fault.name, fault.message, fault.expansions)
        self._faults.setdefault(key, fault)

    def _recovers(self, failure: Failure | XmlError, node: Tag) -> bool:
        """Record a failure and drop its element, unless the element that a person wrote is further out."""
        self.untraced += 1
        if isinstance(failure, Failure):
            if failure.loop == "file":
                files = [shown_path(file) for file in self.file_stack]
                if len(set(files)) < len(files):
                    return False
                failure.place = node, None
            elif failure.kind == "too-many" or failure.loop == "block":
                if self._stack or self.open_blocks or len(self.file_stack) > 1:
                    return False
                failure.place = node, None
        is_consequence = isinstance(failure, Failure) and failure.kind == "other" and self._has_unknown_attribute(node)
        if not is_consequence:
            self._record(failure)
        node.remove()
        return True

    def _has_unknown_attribute(self, node: Tag) -> bool:
        return any((node.position, name) in self._unresolved for name in node.attributes)

    # Reuse

    def _can_repeat(self) -> bool:
        late = self._late
        return not (late.properties or late.macros or self._loops or self._exceeded or self._is_exhausted)

    def _is_clean(self, document: Tag) -> bool:
        return not (self._adds_prefixes and (any(repair_spelling(document)) or any(add_missing_prefixes(document))))

    # Values

    def _argument(self, node: Tag, macros: Scope, scope: Scope) -> None:
        name = node.attributes.get("name")
        if isinstance(name, str) and "default" not in node.attributes:  # a failure, not another one at each use
            self.commands.arguments.setdefault(name, Unknown(f"$(arg {name})"))
        super()._argument(node, macros, scope)

    @property
    def _is_exhausted(self) -> bool:
        return self._evaluated > MAX_EXPRESSIONS or self.budget.left < 0

    def text(self, text: Any, scope: Scope) -> Any:
        """Return the value of a text, `Unknown` if it cannot be computed."""
        if type(text) is Unknown:
            return text
        if self._evaluated > MAX_EXPRESSIONS:
            return Unknown(text) if "$" in text else text
        try:
            value = super().text(text, scope)
        except Failure as failure:
            self._record(failure)
            value = Unknown(text)
        if type(value) is Unknown and not self.resolving:
            tag, attribute = self.at
            if tag is not None:
                self.untraced += 1
                self._unresolved.add((tag.position, attribute))
        return value

    def resolve(self, scope: Scope, name: str) -> Any:
        """Evaluate the text of a property at its first use."""
        try:
            return super().resolve(scope, name)
        except Failure as failure:
            self._record(failure)
            return Unknown(f"${{{name}}}")

    def _joined(self, parts: list[Any], text: str) -> str:
        if Unknown not in map(type, parts):
            return super()._joined(parts, text)
        shown = list(map(str, parts))
        return Unknown("".join(shown) if sum(map(len, shown)) <= MAX_CHARACTERS else text)

    def _computed(self, kind: int, content: Any, scope: Scope) -> Any:
        if type(content) is Unknown or self.budget.left < 0:
            return _as_written(kind, content)
        outer, self._expression = self._expression, content
        try:
            return super()._computed(kind, content, scope)
        except Recorded as failure:
            return failure.value if failure.name == content.strip() else _as_written(kind, content)
        except Failure as failure:
            self._record(failure)
            if failure.kind == "undefined-property":
                for name in _names(content):
                    if name not in scope:
                        self._record_undefined(name, scope)
            return _as_written(kind, content)
        finally:
            self._expression = outer

    def _symbol(self, symbols: Any, name: str) -> Any:
        try:
            value = symbols[name]
        except KeyError:
            is_property = isinstance(symbols, Scope) and symbols.root is self.globals
            if not (is_property and name in self._late.properties):
                raise NameError(f"name '{name}' is not defined", name=name) from None
            value = self._late.properties[name][0]
            self._record_undefined(name, symbols)
        if type(value) is Unknown:
            raise Recorded(name, value)
        return value

    def _record_undefined(self, name: str, scope: Scope) -> None:
        failure = undefined_property(name, self.visible(scope))
        failure.facts["expression"] = self._expression
        if name in self._late.properties:
            mark_late(failure, "property", name, self._late.properties[name][1])
        self._record(failure)

    def _boolean(self, value: Any, condition: Any) -> bool:
        """Return whether a condition holds; an unknown one does."""
        if condition is not None and type(value) is Unknown:
            return True
        return super()._boolean(value, condition)

    # Files

    def _read(self, source: Source) -> Tag:
        try:
            document = read_tree(source)
        except XmlError as error:
            if error.cause != "unbound prefix":
                raise
            self._record(error)
            document = read_tree(source, namespaces=False)
        if self._adds_prefixes:
            for fault in repair_spelling(document):
                self._keep(fault)
            for unprefixed in add_missing_prefixes(document):
                self.untraced += 1
                self._unprefixed.setdefault(unprefixed)
        return document

    def _absolute(self, name: str) -> str:
        if type(name) is Unknown:
            raise Recorded
        return super()._absolute(name)

    def _in_any_case(self, path: str, name: str) -> str:
        return path  # a fault

    def _include(self, node: Tag, macros: Scope, scope: Scope) -> Steps:
        if shown_path(self.file_stack[-1]) in self._loops:
            raise Recorded
        return super()._include(node, macros, scope)


def _as_written(kind: int, content: str) -> Unknown:
    return Unknown(f"${{{content}}}" if kind == EXPRESSION else f"$({content})")


def _names(expression: str) -> list[str]:
    """Return the names that an expression reads and does not define itself, in order."""
    import ast

    nodes = list(ast.walk(ast.parse(expression.strip(), mode="eval")))
    names = [node for node in nodes if isinstance(node, ast.Name)]
    defined = {node.arg for node in nodes if isinstance(node, ast.arg)}
    defined |= {node.id for node in names if isinstance(node.ctx, ast.Store)}
    names.sort(key=lambda node: (node.lineno, node.col_offset))
    return list(dict.fromkeys(node.id for node in names if node.id not in defined))
