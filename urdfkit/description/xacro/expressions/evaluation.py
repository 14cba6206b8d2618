"""The Python that xacro evaluates in ``${…}`` and ``$(eval …)``, kept from reaching the machine.

xacro refuses names that start with two underscores, but looks only at the outermost code object, so that
``${[x.__class__ for x in [1]]}`` passes; frames (``gi_frame.f_back``) and ``vars`` lead out as well; and
``$(eval …)`` runs with every builtin. Here nested code is checked too, and the rest is not there.
"""

from __future__ import annotations

from types import CodeType

from urdfkit.description.xacro.expressions.excess import MAX_EXPRESSION, MAX_EXPRESSIONS, TooLarge
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.xacro.expressions.limits import Bounds

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


_SMALL = 1 << 62
"""Integers between its negative and this need no guard."""

_PLAIN = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-. \t\r\n/>='\"")
"""Expressions in which nothing can grow: names, numbers, texts, division, differences, comparisons."""


@record
class Code:
    """An expression that was looked at.

    Attributes:
        code: what Python evaluates.
        names: the names it uses and does not give a value itself, in order.
        form: ``plain``, with ``guards`` as the parameters of a function, or with guards as ``builtins``.
    """

    code: CodeType
    names: tuple[str, ...]
    form: str


class Evaluator:
    """Compiles, checks and evaluates expressions; an expression that is met again is not compiled again.

    Args:
        refused: makes the exception for an expression that is refused, from a message.
    """

    def __init__(self, refused: type[Exception]) -> None:
        self._refused = refused
        self._compiled: dict[tuple[str, bool], Code] = {}
        self._bounds: Bounds | None = None
        self._evaluated = 0

    @property
    def is_exhausted(self) -> bool:
        """Whether the expressions of this run have taken all the steps they may."""
        return self._evaluated > MAX_EXPRESSIONS or (self._bounds is not None and self._bounds.is_exhausted)

    @property
    def bounds(self) -> Bounds:
        """What counts the steps; made when the first expression needs it."""
        if self._bounds is None:
            from urdfkit.description.xacro.expressions.limits import Bounds

            self._bounds = Bounds()
        return self._bounds

    def names(self, expression: str) -> tuple[str, ...]:
        """Return the names an expression uses, in order.

        Raises:
            SyntaxError: it is not an expression.
        """
        return self.compile(expression).names

    def compile(self, expression: str, *, is_command: bool = False) -> Code:
        """Return the code of an expression.

        Args:
            expression: Python, as written between the braces.
            is_command: whether its names are not in a dictionary (``$(eval …)``).

        Raises:
            SyntaxError: it is not an expression.
            TooLarge: it is too long, or nested too deep.
        """
        code = self._compiled.get((expression, is_command))
        if code is None:
            code = self._compile(expression.strip(), is_command)
            self._compiled[expression, is_command] = code
        return code

    def _compile(self, expression: str, is_command: bool) -> Code:
        if len(expression) > MAX_EXPRESSION:
            raise TooLarge(f"it has {len(expression):,} characters; at most {MAX_EXPRESSION:,} are evaluated")
        if len(expression) <= 200 and _PLAIN.issuperset(expression):
            code = compile(expression, "<expression>", "eval")
            self._check_names(code.co_names)
            return Code(code, code.co_names, "plain")
        import ast

        from urdfkit.description.xacro.expressions.guards import Guarding, bound_in, names_in, with_parameters

        try:
            tree = ast.parse(expression, "<expression>", "eval")
            names = tuple(dict.fromkeys(names_in(tree)))
            self._check_names(names)
            bound = bound_in(tree)
            guarding = Guarding()
            tree.body = guarding.visit(tree.body)
            form = "builtins" if is_command or guarding.stores else "guards"
            if form == "guards":
                tree.body = with_parameters(tree.body, list(self.bounds.guards))
            code = compile(ast.fix_missing_locations(tree), "<expression>", "eval")
        except (RecursionError, MemoryError) as error:
            raise TooLarge("it is nested too deep") from error
        return Code(code, tuple(name for name in names if name not in bound), form)

    def _check_names(self, names: tuple[str, ...]) -> None:
        if invalid := [name for name in names if name.startswith("__") or name in _FRAMES]:
            raise self._refused(f"use of invalid name(s): {', '.join(invalid)}")

    def safe_eval(self, expression: str, symbols: dict[str, Any], local: Any = None) -> Any:
        """Evaluate ``${expression}`` as ``xacro.safe_eval`` does.

        Raises:
            TooLarge: it makes too much.
        """
        found = self.compile(expression)
        code, form = found.code, found.form
        symbols.update(__builtins__=self.bounds.guards if form == "builtins" else {})
        value = eval(code, symbols, local)
        if form == "guards":
            value = value(*self.bounds.guards.values())
        kind = type(value)
        # Most of what comes out is a number or a name.
        is_small = kind is float or kind is bool or (kind is str and len(value) < 64)
        is_small = is_small or (kind is int and -_SMALL < value < _SMALL)
        return value if is_small else self.bounds.checked(value)

    def has_room(self, expressions: int) -> bool:
        """Return whether so many more may be evaluated."""
        return not self.is_exhausted and self._evaluated + expressions <= MAX_EXPRESSIONS

    def count(self, expressions: int) -> None:
        """Count expressions that are to be evaluated.

        Raises:
            TooLarge: the run has evaluated too many.
        """
        self._evaluated += expressions
        if self._evaluated > MAX_EXPRESSIONS:
            raise TooLarge(f"the file has more than {MAX_EXPRESSIONS:,} expressions")

    def eval_command(self, expression: str, names: Any) -> str:
        """Evaluate ``$(eval expression)``, with harmless builtins only.

        Raises:
            TooLarge: it makes too much.
        """
        code = self.compile(expression, is_command=True).code
        value = eval(code, {"__builtins__": {**harmless_builtins(), **self.bounds.guards}}, names)
        return str(self.bounds.checked(value))


def harmless_builtins() -> dict[str, Any]:
    """Return the builtins that neither import, nor open, nor look inside."""
    import builtins

    return {name: getattr(builtins, name) for name in _HARMLESS}
