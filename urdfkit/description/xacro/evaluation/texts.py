"""Texts: attributes and character data with ``${…}`` and ``$(…)`` in them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import cached_property
from keyword import iskeyword

from urdfkit.description.packages.resolver import OUTSIDE
from urdfkit.description.packages.similar_names import near_path
from urdfkit.description.xacro.evaluation.commands import Commands
from urdfkit.description.xacro.evaluation.expressions.budget import Budget
from urdfkit.description.xacro.evaluation.expressions.limits import (
    MAX_CHARACTERS,
    MAX_EXPRESSION,
    MAX_EXPRESSIONS,
    MAX_PROPERTY_DEPTH,
    TooLarge,
    excess,
)
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope, symbol_of
from urdfkit.description.xacro.evaluation.failures import (
    Failure,
    Place,
    circular_property,
    short,
    undefined_in_command,
    undefined_property,
)
from urdfkit.description.xml.reader import shown_path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path
    from typing import Any

    from urdfkit.description.xacro.evaluation.expressions.interpreter import Expressions

MAX_CANDIDATES = 200_000
"""Names that are collected for suggestions in one expansion, so that many undefined names take linear time."""
_TOKEN = re.compile(r"(\$\$+[{(])|\$\{([^}]*)\}|\$\(([^)]*)\)|([^$]+|\$[^{($]+|\$$)").match
ESCAPED, EXPRESSION, COMMAND, PLAIN, INVALID = 1, 2, 3, 4, 5


class Texts:
    """Evaluates the texts of one file.

    Args:
        arguments: values of ``$(arg …)``.
        find: returns the folder of a package.
        variable: returns the value of an environment variable; None if it is not set.

    Attributes:
        at: the element and attribute being evaluated.
        resolving: how many properties are being evaluated, each because the one before uses it.
    """

    def __init__(
        self, arguments: Mapping[str, str], find: Callable[[str], str], variable: Callable[[str], str | None]
    ) -> None:
        self.budget = Budget()
        self.commands = Commands(lambda: self.expressions, dict(arguments), find, variable)
        self.at: Place = (None, None)
        self._tokens: dict[str, list[tuple[int, str]]] = {}
        self._names: dict[str, str] = {}
        self._evaluated = self.resolving = self._candidates = 0

    @cached_property
    def expressions(self) -> Expressions:
        """The interpreter, loaded at the first expression that is not one name; `ast` takes 3 ms to load."""
        from urdfkit.description.xacro.evaluation.expressions.interpreter import Expressions

        made = Expressions(self.budget)
        made.symbol = self._symbol
        return made

    def place(self) -> Place:
        """Return the element and attribute being evaluated."""
        return self.at

    def text(self, text: Any, scope: Scope) -> Any:
        """Return the value of a text: that of its expression if it is only one, else a text.

        Raises:
            Failure: it cannot be evaluated.
        """
        if not isinstance(text, str):
            if text:
                raise self.placed(Failure("other", f"`{short(str(text))}` is not text"))
            return ""
        if "$" not in text:
            return text
        tokens = self._tokens.get(text)
        if tokens is None:
            tokens = self._tokens[text] = _tokens(text)
        self._evaluated += len(tokens)
        if self._evaluated > MAX_EXPRESSIONS:
            raise self.placed(
                Failure("too-large", f"too large: the file has more than {MAX_EXPRESSIONS:,} expressions")
            )
        if len(tokens) == 1:
            return self._value(*tokens[0], scope)
        value = self._value
        return self._joined([part if kind == PLAIN else value(kind, part, scope) for kind, part in tokens], text)

    def _joined(self, parts: list[Any], text: str) -> str:
        length, found = 0, []
        for part in parts:
            found.append(str(part))
            length += len(found[-1])
            if length > MAX_CHARACTERS:
                raise self._too_large(excess("a string", MAX_CHARACTERS, "characters"), PLAIN, text)
        return "".join(found)

    def resolve(self, scope: Scope, name: str) -> Any:
        """Evaluate the text of a property at its first use.

        Raises:
            Failure: it cannot be evaluated.
        """
        if name in scope.open_names:
            self.at = scope.pending.get(name, self.at)
            raise self.placed(circular_property((*scope.open_names, name)))
        if self.resolving >= MAX_PROPERTY_DEPTH:
            raise self.placed(Failure("recursion", f"properties use each other more than {MAX_PROPERTY_DEPTH} deep"))
        self.resolving += 1
        scope.open_names.append(name)
        outer, self.at = self.at, scope.pending[name]
        try:
            scope.assign(name, self.text(scope.values[name], scope))
        finally:
            self.at = outer
            scope.open_names.pop()
            self.resolving -= 1
        return scope.values[name]

    def placed(self, failure: Failure) -> Failure:
        """Return a failure with the place that is being evaluated, unless it has one."""
        if failure.place is None:
            failure.place = self.at
        return failure

    def _value(self, kind: int, content: str, scope: Scope) -> Any:
        if kind in (PLAIN, ESCAPED):
            return content
        if kind == INVALID:
            raise self.placed(Failure("other", short(f"invalid expression: {content}")))
        return self._computed(kind, self.text(content, scope) if "$" in content else content, scope)

    def _computed(self, kind: int, content: Any, scope: Scope) -> Any:
        inner = str(content)
        try:
            if kind == COMMAND:
                return self.commands.evaluate(inner)
            name = self._names.get(inner)
            if name is None:
                name = self._names[inner] = _name(inner)
            if name:
                return self.budget.checked(self._symbol(scope, name))
            return self.expressions.evaluate(inner, scope)
        except Failure as failure:
            failure.is_missing_file = False
            raise self.placed(failure) from None
        except Exception as error:
            raise self._failure(error, kind, inner, scope) from None

    def _symbol(self, symbols: Any, name: str) -> Any:
        return symbol_of(symbols, name)

    def _failure(self, error: Exception, kind: int, source: str, scope: Scope) -> Failure:
        if isinstance(error, TooLarge):
            return self._too_large(error, kind, source)
        if isinstance(error, RecursionError):
            message = "calls of macros, includes and properties are nested too deeply"
            return self.placed(Failure("recursion", message))
        expression = source if kind == EXPRESSION else None
        if isinstance(error, NameError) and error.name is not None and kind == EXPRESSION:
            failure = undefined_property(error.name, self.visible(scope))
            failure.facts["expression"] = expression
        elif isinstance(error, NameError) and error.name is not None:
            failure = undefined_in_command(error.name, tuple(self.commands.arguments))
        elif isinstance(error, OSError):
            failure = unreadable(error, is_include=False)
            failure.is_missing_file = True
        else:
            text = error.msg if isinstance(error, SyntaxError) else str(error)
            if isinstance(error, KeyError):
                text = f"no key {text}"
            message = f"cannot evaluate `{_shown(kind, source)}`: {short(text)}"
            failure = Failure("bad-expression", message, expression=expression)
        return self.placed(failure)

    def visible(self, scope: Scope) -> list[str]:
        """Return the names that a scope has for suggestions; none after `MAX_CANDIDATES` names in all."""
        if self._candidates > MAX_CANDIDATES:
            return []
        names = list(dict.fromkeys(name for name in scope.names() if not name.startswith(("*", "__"))))
        self._candidates += len(names)
        return names

    def _too_large(self, error: TooLarge, kind: int, source: str) -> Failure:
        expression = source if kind == EXPRESSION and len(source) <= MAX_EXPRESSION else None
        message = f"`{_shown(kind, source)}` is too large: {error}"
        return self.placed(Failure("too-large", message, expression=expression))


def _name(expression: str) -> str:
    """Return the name that an expression consists of; empty if it is more, or is refused."""
    name = expression.strip()
    is_name = name.isascii() and name.isidentifier() and not iskeyword(name) and not name.startswith("__")
    return name if is_name and len(expression) <= MAX_EXPRESSION else ""


def _shown(kind: int, source: str) -> str:
    """Return a part of a text as it is written, in one line."""
    return {EXPRESSION: "${%s}", COMMAND: "$(%s)"}.get(kind, "%s") % short(source)


def unreadable(error: OSError, *, is_include: bool, user: Path | None = None) -> Failure:
    """Return the failure for a file that cannot be read."""
    import errno
    from pathlib import Path

    path = Path(str(error.filename or ""))
    if error.errno == errno.ENAMETOOLONG:
        why = "has a name that is too long"
    elif error.strerror == OUTSIDE:
        why = f"is {OUTSIDE}"
    else:
        try:
            if path.is_dir():
                why = "is a folder"
            elif path.is_symlink() and not path.exists():
                why = f"is a symbolic link to {path.readlink()}, which does not exist or leads back to the link"
            else:
                why = ("cannot be read" if path.is_file() else "does not exist") + near_path(path, user=user)
        except PermissionError:  # of a folder above it
            why = "cannot be read"
    kind = "include-not-found" if is_include else "other"
    shown = shown_path(path)
    named = short(shown) if "\n" in shown else shown
    message = f"{'included ' if is_include else ''}file {named} " + why
    return Failure(kind, message, name=shown, details={"path": str(path)})


def _tokens(text: str) -> list[tuple[int, str]]:
    """Return the parts of a text, each with its kind."""
    found: list[tuple[int, str]] = []
    at = 0
    while at < len(text):
        match = _TOKEN(text, at)
        if match is None:
            # Stock xacro reads one part ahead of the part it evaluates.
            found.insert(max(len(found) - 1, 0), (INVALID, text[at:]))
            break
        kind = match.lastindex or PLAIN
        content = match[kind]
        found.append((kind, content[1:] if kind == ESCAPED else content))
        at = match.end()
    return found
