"""Commands: ``$(find …)``, ``$(arg …)``, ``$(env …)``, ``$(optenv …)``, ``$(cwd)`` and ``$(eval …)``."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from urdfkit.description.xacro.evaluation.expressions.budget import Budget
from urdfkit.description.xacro.evaluation.expressions.functions import Functions, mathematics
from urdfkit.description.xacro.evaluation.expressions.limits import MAX_CHARACTERS, excess
from urdfkit.description.xacro.evaluation.expressions.values import Function
from urdfkit.description.xacro.evaluation.failures import Failure
from urdfkit.errors import did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.xacro.evaluation.expressions.interpreter import Expressions

_BUILTINS = (
    "abs all any bool complex dict divmod enumerate filter float frozenset hash int isinstance issubclass len list map "
    "max min ord range repr reversed round set slice sorted str sum tuple zip"
)
_COMMANDS = ("find", "env", "optenv", "dirname", "arg")


class Commands:
    """Evaluates the commands of one file.

    Args:
        expressions: returns what evaluates ``$(eval …)``.
        arguments: values of ``$(arg …)``; ``<xacro:arg>`` adds defaults to it.
        find: returns the folder of a package.
        variable: returns the value of an environment variable; None if it is not set.

    Attributes:
        unset: why an environment variable has no value, for messages.
        log: evaluated command → its value, None if the command has no value or a value that may change.
    """

    def __init__(
        self,
        expressions: Callable[[], Expressions],
        arguments: dict[str, str],
        find: Callable[[str], str],
        variable: Callable[[str], str | None],
    ) -> None:
        self._expressions, self.arguments, self._find, self._read_variable = expressions, arguments, find, variable
        self.unset = "is not set"
        self.log: dict[str, Any] = {}
        self._names: dict[str, Any] | None = None
        self._builtins: dict[str, Any] = {}

    def evaluate(self, command: str) -> str:
        """Return the text that ``$(command)`` stands for.

        Raises:
            Failure: an argument has no value.
            ValueError: it is not a command.
        """
        if command == "cwd" or command.startswith("eval "):
            self.log[command] = None
        if command == "cwd":
            return str(Path.cwd())
        text = f"$({command})"
        if command.startswith("eval "):
            return self._evaluate(command[5:])
        for commands in (_COMMANDS, ("find",)):
            resolved = text
            for content in _contents(text):
                words = [word for word in content.split(" ") if word]
                if words[0] not in _COMMANDS:
                    raise ValueError(f"Unknown substitution command [{content}]. Valid commands are {list(_COMMANDS)}")
                if words[0] in commands:
                    resolved = resolved.replace(f"$({content})", str(self.value(content)))
                    if len(resolved) > MAX_CHARACTERS:
                        raise excess("a string", MAX_CHARACTERS, "characters")
            text = resolved
        return text

    def value(self, content: str) -> Any:
        """Return the value of ``find …``, ``arg …`` and the like.

        Raises:
            Failure: it has none.
            ValueError: its words are not those of such a command.
        """
        command, *words = [word for word in content.split(" ") if word]
        self.log[content] = None
        value = self.log[content] = self._value(content, command, words)
        return value

    def _value(self, content: str, command: str, words: list[str]) -> Any:
        if command == "dirname":
            raise ValueError("Cannot substitute $(dirname), no file/directory information available.")
        if not words or (len(words) > 1 and command != "optenv"):
            raise ValueError(f"$({command} …) needs exactly one name [{content}]")
        if command == "find":
            return self._find(words[0])
        if command == "env":
            return self._variable(words[0])
        if command == "optenv":
            return self._optional(words[0], " ".join(words[1:]))
        return self.argument(words[0])

    def _variable(self, name: str) -> str:
        value = self._read_variable(name)
        if value is None:
            raise ValueError(f"environment variable '{name}' {self.unset}")
        return value

    def _optional(self, name: str, default: str = "") -> str:
        value = self._read_variable(name)
        return default if value is None else value

    def argument(self, name: str) -> str:
        """Return the value of an argument.

        Raises:
            Failure: it has none.
        """
        try:
            return self.arguments[name]
        except KeyError:
            candidates = tuple(self.arguments)
            hint = did_you_mean(name, candidates) or f"; pass {name}:=value, or declare a default with <xacro:arg>"
            raise Failure(
                "undefined-arg", f"argument `{name}` has no value" + hint, name=name, candidates=candidates
            ) from None

    def _evaluate(self, expression: str) -> str:
        if "__" in expression:
            raise ValueError("$(eval ...) may not contain double underscore expressions")
        return str(self._expressions().evaluate(expression, _Names(self._functions(), self.arguments, self._builtins)))

    def _functions(self) -> dict[str, Any]:
        if self._names is None:
            budget: Budget = self._expressions().budget
            functions: dict[str, Callable[..., Any]] = {
                "env": self._variable,
                "optenv": self._optional,
                "find": self._find,
                "arg": lambda name: converted(self.argument(name)),
                "dirname": lambda: self._value("dirname", "dirname", []),
            }
            self._names = {name: Function(name, call) for name, call in functions.items()}
            self._names |= {"true": True, "false": False, **mathematics(budget)}
            self._builtins = Functions(budget, self._expressions().callable_of).builtins(_BUILTINS)
        return self._names


class _Names:
    """The names that ``$(eval …)`` can use: functions, then arguments, then functions of Python."""

    def __init__(self, functions: dict[str, Any], arguments: dict[str, str], builtins: dict[str, Any]) -> None:
        self._functions, self._arguments, self._builtins = functions, arguments, builtins

    def __getitem__(self, name: str) -> Any:
        if name in self._functions:
            return self._functions[name]
        if name in self._arguments:
            return converted(self._arguments[name])
        return self._builtins[name]


def converted(value: Any) -> Any:
    """Return the number or boolean that the text of an argument is, or the text."""
    try:
        return float(value) if "." in value else int(value)
    except ValueError:
        return {"true": True, "false": False}.get(value.lower(), value)


def _contents(text: str) -> Iterator[str]:
    """Yield the contents of each ``$(…)`` of a text, which do not nest.

    Raises:
        ValueError: they nest.
    """
    state, start = "outside", 0
    for at, character in enumerate(text):
        if character == "$":
            if state not in ("outside", "dollar"):
                raise ValueError(f'Dollar signs "$" cannot be inside of substitution args [{text}]')
            state = "dollar"
        elif character == "(":
            if state not in ("outside", "dollar"):
                raise ValueError(f'Invalid left parenthesis "(" in substitution args [{text}]')
            state = "open" if state == "dollar" else state
        elif character == ")":
            if state == "inside":
                yield text[start:at]
            state = "outside"
        elif state == "dollar":
            state = "outside"
        elif state == "open":
            state, start = "inside", at
