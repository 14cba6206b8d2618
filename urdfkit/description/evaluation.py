"""The Python that xacro evaluates in ``${…}`` and ``$(eval …)``, kept from reaching the machine.

xacro refuses names that start with two underscores, but looks only at the outermost code object, so that
``${[x.__class__ for x in [1]]}`` passes; frames (``gi_frame.f_back``) and ``vars`` lead out as well; and
``$(eval …)`` runs with every builtin. Here nested code is checked too, and the rest is not there.
"""

from __future__ import annotations

from collections.abc import Iterator
from types import CodeType

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_FRAMES = frozenset(
    f"{kind}_{part}"
    for kind, parts in {
        "gi": ("frame", "code", "yieldfrom"),
        "cr": ("frame", "code", "await", "origin"),
        "ag": ("frame", "code", "await"),
        "f": ("back", "builtins", "code", "globals", "locals", "trace"),
        "tb": ("frame", "next"),
    }.items()
    for part in parts
)
"""Attributes by which generators, coroutines and tracebacks lead to frames, and frames to everything."""

_HARMLESS = (  # noqa: SIM905
    "abs all any bool complex dict divmod enumerate filter float frozenset hash int isinstance issubclass len list "
    "map max min ord range repr reversed round set slice sorted str sum tuple zip True False None"
).split()


class Evaluator:
    """Compiles, checks and evaluates expressions; an expression that is met again is not compiled again.

    Args:
        refused: makes the exception for an expression that is refused, from a message.
    """

    def __init__(self, refused: type[Exception]) -> None:
        self._refused = refused
        self._compiled: dict[str, CodeType] = {}

    def compile(self, expression: str) -> CodeType:
        """Return the code of an expression.

        Args:
            expression: Python, as written between the braces.

        Raises:
            SyntaxError: it is not an expression.
        """
        code = self._compiled.get(expression)
        if code is None:
            code = compile(expression.strip(), "<expression>", "eval")
            invalid = [name for name in names_in(code) if name.startswith("__") or name in _FRAMES]
            if invalid:
                raise self._refused(f"use of invalid name(s): {', '.join(invalid)}")
            self._compiled[expression] = code
        return code

    def safe_eval(self, expression: str, symbols: dict[str, Any], local: Any = None) -> Any:
        """Evaluate ``${expression}`` as ``xacro.safe_eval`` does."""
        code = self.compile(expression)
        symbols.update(__builtins__={})
        return eval(code, symbols, local)

    def eval_command(self, expression: str, names: Any) -> str:
        """Evaluate ``$(eval expression)``, with harmless builtins only."""
        return str(eval(self.compile(expression), {"__builtins__": harmless_builtins()}, names))


def names_in(code: CodeType) -> Iterator[str]:
    """Yield the names that code uses, nested functions and comprehensions included."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from names_in(constant)


def harmless_builtins() -> dict[str, Any]:
    """Return the builtins that neither import, nor open, nor look inside."""
    import builtins

    return {name: getattr(builtins, name) for name in _HARMLESS}
