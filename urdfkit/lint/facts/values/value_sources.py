"""Sources of a value: the numbers and names behind an expression, where a person wrote them.

Follows properties, arguments and defaults of macros, dictionaries, lists and YAML files.
"""

from __future__ import annotations

import ast
import re
from functools import cached_property
from itertools import islice

from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.values.expression_paths import Keys, called, item, path, path_of
from urdfkit.lint.facts.values.yaml_values import UnresolvedError, YamlValues
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from urdfkit.description.control.settings import Settings
    from urdfkit.description.xml.source import Expansion
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Tag

    Calls = tuple[Expansion, ...]

_EXPRESSION = re.compile(r"\$\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}")
_ALONE = re.compile(r"\s*\$\{\s*[A-Za-z_]\w*\s*\}\s*")
_ARGUMENT = re.compile(r"\$\(arg\s+([^\s)]+)\s*\)")
_DEFAULT = r"(?<!\S){name}:?=(?:\^\|?)?('[^']*'|\"[^\"]*\"|\$\{{[^{{}}]*\}}|\S*)"
_MAX_STEPS = 24
_MAX_SOURCES = 200
"""Values of one name; properties that add others several times would have any number of them."""


@record(order=True)
class ValueSource:
    """A literal behind an expression.

    Attributes:
        span: the attribute, default or YAML value.
        text: the literal.
        trail: the properties and arguments that compute or select the value, from the expression on.
    """

    span: Span
    text: str
    trail: tuple[Span, ...] = ()


class ValueSources:
    """Finds the sources of values of one model.

    Args:
        model: the linted model.
    """

    def __init__(self, model: Model) -> None:
        self._model = model
        self._yaml = YamlValues(model)
        self._properties: dict[tuple[str, str], list[Tag]] = {}
        self._found: dict[tuple[str, Keys, Calls], tuple[ValueSource, ...]] = {}

    def of_text(self, text: str, span: Span, calls: Sequence[Expansion]) -> set[ValueSource] | None:
        """Return the sources of the expressions in a text; None if one of them is not found.

        Numbers that an expression adds count, factors do not.

        Args:
            text: source text with expressions.
            span: place of the text.
            calls: the macro calls around the text, innermost first.
        """
        try:
            return set(self._in_text(text, span, tuple(calls), 0))
        except (UnresolvedError, SyntaxError, ValueError, RecursionError):
            return None

    def lacking(self, text: str, span: Span, calls: Sequence[Expansion]) -> tuple[Settings, str | int] | None:
        """Return the group or list of a YAML file that lacks an item which a text uses, and the key of the item."""
        try:
            list(self._in_text(text, span, tuple(calls), 0))
        except UnresolvedError as error:
            return error.lacking
        except (SyntaxError, ValueError, RecursionError):
            return None
        return None

    def _in_text(self, text: str, span: Span, calls: Calls, steps: int) -> Iterator[ValueSource]:
        if steps > _MAX_STEPS:
            raise UnresolvedError
        for expression in _EXPRESSION.findall(text):
            yield from self._in_expression(ast.parse(expression.strip(), mode="eval").body, span, calls, steps)
        for name in _ARGUMENT.findall(text):
            yield self._argument(name)

    def _in_expression(self, node: ast.expr, span: Span, calls: Calls, steps: int) -> Iterator[ValueSource]:
        """Yield the sources of an expression."""
        named = path(node)
        if named is not None:
            yield from self._of_name(*named, calls, steps + 1)
        elif isinstance(node, ast.Call):
            for argument in node.args:
                yield from self._in_expression(argument, span, calls, steps)
        else:
            is_sum = isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub))
            for child in ast.iter_child_nodes(node):
                if is_sum and isinstance(child, ast.Constant):
                    yield ValueSource(span, str(child.value))
                elif isinstance(child, ast.expr):
                    yield from self._in_expression(child, span, calls, steps)

    def _of_name(self, name: str, keys: Keys, calls: Calls, steps: int) -> tuple[ValueSource, ...]:
        """Return the sources of a name with keys: ``dims['arm']['length']``."""
        use = name, keys, calls
        if use not in self._found:
            sources = list(islice(self._search(name, keys, calls, steps), _MAX_SOURCES + 1))
            if len(sources) > _MAX_SOURCES:
                raise UnresolvedError
            self._found[use] = tuple(dict.fromkeys(sources))
        return self._found[use]

    def _search(self, name: str, keys: Keys, calls: Calls, steps: int) -> Iterator[ValueSource]:
        if name in ("pi", "tau", "e", "True", "False", "math", "xacro") and self._definition(name, calls) is None:
            return
        found = self._definition(name, calls)
        if found is None and keys and isinstance(keys[0], str):  # a namespace of an include
            found, keys = self._definition(keys[0], calls), keys[1:]
        if found is None:
            raise UnresolvedError
        text, span, outer = found
        for each in self._of_definition(text, span, outer, keys, steps):
            is_computed = not keys and each.span != span and not _ALONE.fullmatch(text)
            yield ValueSource(each.span, each.text, (span, *each.trail)) if is_computed else each

    def _of_definition(self, text: str, span: Span, outer: Calls, keys: Keys, steps: int) -> Iterator[ValueSource]:
        """Yield the sources of the text of a property or argument."""
        alone = _EXPRESSION.fullmatch(text.strip())
        if alone is not None and (keys or path_of(alone[1]) is not None):
            yield from self._of_keys(ast.parse(alone[1].strip(), mode="eval").body, keys, span, outer, steps)
        elif keys:
            yield from self._of_keys(ast.parse(text.strip(), mode="eval").body, keys, span, outer, steps)
        elif "${" in text or "$(" in text:
            yield from self._in_text(text, span, outer, steps + 1)
        else:
            yield ValueSource(span, text.strip())

    def _of_keys(self, node: ast.expr, keys: Keys, span: Span, calls: Calls, steps: int) -> Iterator[ValueSource]:
        """Yield the sources of an item of an expression."""
        if steps > _MAX_STEPS:
            raise UnresolvedError
        named = path(node)
        if named is not None:
            yield from self._of_name(named[0], (*named[1], *keys), calls, steps + 1)
            return
        while isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant):
            key = node.slice.value
            keys, node = (key if isinstance(key, int) else str(key), *keys), node.value
        if isinstance(node, ast.Call) and called(node) == "load_yaml" and node.args:
            at, value = self._yaml.value(node.args[0], keys)
            yield ValueSource(Span(at.file, at.line, at.column, at.line, at.column + len(value)), value)
            return
        part = item(node, keys[0]) if keys else node
        if part is None:
            raise UnresolvedError
        if keys[1:] or path(part) is not None:
            yield from self._of_keys(part, keys[1:], span, calls, steps + 1)
        elif isinstance(part, ast.Constant):
            yield ValueSource(span, str(part.value))
        else:
            yield from self._in_expression(part, span, calls, steps + 1)

    def _definition(self, name: str, calls: Calls) -> tuple[str, Span, Calls] | None:
        """Return the text of a parameter or property, its place and the macro calls around it."""
        model = self._model
        for depth, call in enumerate(calls):
            title = call.macro.rpartition(".")[2]
            macro = model.expanded.macros.get(title)
            body = model.tag(macro.position) if macro is not None else None
            if macro is None or body is None:
                continue
            if (name, title) not in self._properties:
                self._properties[name, title] = [each for each in body.walk() if _defines(each, name)]
            local = self._properties[name, title]
            if local:
                return _one(local, model.document(macro.position.file).source, calls[depth:])
            if name in macro.parameters:
                argument = tag.attributes.get(name) if (tag := model.tag(call.position)) is not None else None
                if argument is not None:
                    return argument.value, model.span(call.position, name), calls[depth + 1 :]
                default = self._default(name, body, model.document(macro.position.file).source)
                is_forwarded = default is None or default[2]
                outer = self._definition(name, calls[depth + 1 :]) if is_forwarded else None
                return outer or (None if default is None else (*default[:2], calls[depth + 1 :]))
        position = model.expanded.properties.get(name)
        tag = model.tag(position) if position is not None else None
        if position is None or tag is None:
            return None
        inside = next((above for above in tag.ancestors() if above.name == "xacro:macro"), None)
        return _one([tag], model.document(position.file).source, self._calls_of(inside, calls))

    def _calls_of(self, macro: Tag | None, calls: Calls) -> Calls:
        """Return the only call of a macro that defines a property for its callers."""
        if macro is None or "name" not in macro.attributes:
            return ()
        chains = self._chains.get(macro.attributes["name"].value, ())
        if len(chains) != 1:
            raise UnresolvedError
        return next(iter(chains))

    @cached_property
    def _chains(self) -> dict[str, set[Calls]]:
        """Macro → the calls around its elements, from its own call outwards."""
        found: dict[str, set[Calls]] = {}
        for chain in {each.origin.expansions for each in self._model.elements if each.origin.expansions}:
            for first, call in enumerate(chain):
                found.setdefault(call.macro.rpartition(".")[2], set()).add(chain[first:])
        return found

    def _default(self, name: str, body: Tag, source: Source) -> tuple[str, Span, bool] | None:
        """Return the default of a parameter, its place, and whether a property of the caller replaces it."""
        written = body.attributes.get("params")
        found = re.search(_DEFAULT.format(name=re.escape(name)), written.value) if written is not None else None
        if written is None or found is None:
            return None
        start = written.value_start + found.start()
        is_forwarded = "^" in found[0]
        text = found[1]
        if text[:1] in "'\"" and text:
            text = text[1:-1]
        return text, source.span(start, written.value_start + found.end()), is_forwarded

    def _argument(self, name: str) -> ValueSource:
        """Return the default of a xacro argument."""
        if name not in self._arguments:
            raise UnresolvedError
        return self._arguments[name]

    @cached_property
    def _arguments(self) -> dict[str, ValueSource]:
        """The first default of each xacro argument."""
        found: dict[str, ValueSource] = {}
        for file in self._model.expanded.sources:
            document = self._model.document(file)
            for tag in document.walk():
                written = tag.attributes if tag.name == "xacro:arg" else {}
                if "name" in written and "default" in written:
                    source = ValueSource(document.span_of(tag, "default"), written["default"].value)
                    found.setdefault(written["name"].value, source)
        return found


def _one(tags: list[Tag], source: Source, calls: Calls) -> tuple[str, Span, Calls]:
    """Return the value of the only definition of a property."""
    values = {tag.attributes["value"].value for tag in tags if "value" in tag.attributes}
    if len(values) != 1:
        raise UnresolvedError
    written = next(found for tag in tags if (found := tag.attributes.get("value")) is not None)
    return written.value, source.span(written.start, written.end), calls


def _defines(tag: Tag, name: str) -> bool:
    return tag.name == "xacro:property" and (of := tag.attributes.get("name")) is not None and of.value == name
