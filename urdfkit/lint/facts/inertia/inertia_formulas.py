"""Inertia formulas in macros, compared numerically with the closed forms of solid bodies."""

from __future__ import annotations

import ast
import re
from itertools import permutations

from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from urdfkit.description.xml.element import Element
    from urdfkit.lint.model.model import Model

    Formula = Callable[[Mapping[str, float]], float]

_ALLOWED = (ast.Expression, ast.BinOp, ast.UnaryOp, ast.Constant, ast.Name, ast.Load)
_OPERATORS = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Pow, ast.USub, ast.UAdd)
_SAMPLES = ((1.3, 0.7, 2.9, 1.9, 0.4, 2.2), (0.9, 3.1, 1.7, 0.6, 2.4, 1.1), (2.1, 1.2, 0.8, 3.3, 1.5, 0.5))
_MOMENTS = ("ixx", "iyy", "izz")
_TOLERANCE = 2e-3
"""Relative tolerance; accepts rounded constants such as 0.083 for 1/12."""


@record
class Slip:
    """One wrong moment of inertia, if the other two are those of a solid body.

    Attributes:
        shape: ``box``, ``cylinder`` or ``sphere``.
        component: ``ixx``, ``iyy`` or ``izz``.
        right: the correct expression, without ``${`` and ``}``.
    """

    shape: str
    component: str
    right: str


def has_slip(model: Model, element: Element) -> bool:
    """Return whether rule X119 reports one wrong moment in the formulas of an ``<inertia>``."""
    tag = model.tag(element.origin.position)
    return tag is not None and slip({name: attribute.value for name, attribute in tag.attributes.items()}) is not None


def slip(formulas: Mapping[str, str]) -> Slip | None:
    """Return the wrong moment, if the other two are those of a solid box, cylinder or sphere.

    Args:
        formulas: source text of ixx, iyy and izz, each a single ``${…}``.
    """
    functions, names = {}, set()
    for component in _MOMENTS:
        parsed = _parsed(formulas.get(component, ""))
        if parsed is None:
            return None
        functions[component] = parsed[0]
        names |= parsed[1]
    if not 2 <= len(names) <= 5:
        return None
    wrong: Slip | None = None
    for shape, moments in _candidates(sorted(names)):
        matches = [name for name in _MOMENTS if _agree(functions[name], moments[name][0], names)]
        if len(matches) == 3:
            return None
        if len(matches) == 2 and wrong is None:
            (component,) = set(functions) - set(matches)
            wrong = Slip(shape, component, moments[component][1])
    return wrong


def _candidates(names: Sequence[str]) -> Iterator[tuple[str, dict[str, tuple[Formula, str]]]]:
    """Yield each assignment of the names to mass and sizes: the shape, and its moments as functions and as text."""
    for m, a, b, c in permutations(names, 4):
        yield "box", {"ixx": _box(m, b, c), "iyy": _box(m, a, c), "izz": _box(m, a, b)}
    for m, r, h in permutations(names, 3):
        across, along = _across(m, r, h), _round(m, r, 2, 1)
        for axis in reversed(_MOMENTS):
            yield "cylinder", {name: along if name == axis else across for name in _MOMENTS}
    for m, r in permutations(names, 2):
        yield "sphere", dict.fromkeys(_MOMENTS, _round(m, r, 5, 2))


def _box(m: str, a: str, b: str) -> tuple[Formula, str]:
    return lambda v: v[m] * (v[a] ** 2 + v[b] ** 2) / 12.0, f"{m}*({a}*{a}+{b}*{b})/12"


def _across(m: str, r: str, h: str) -> tuple[Formula, str]:
    return lambda v: v[m] * (3.0 * v[r] ** 2 + v[h] ** 2) / 12.0, f"{m}*(3*{r}*{r}+{h}*{h})/12"


def _round(m: str, r: str, divisor: int, factor: int) -> tuple[Formula, str]:
    written = f"{f'{factor}*' if factor > 1 else ''}{m}*{r}*{r}/{divisor}"
    return lambda v: factor * v[m] * v[r] ** 2 / divisor, written


def _parsed(text: str) -> tuple[Formula, set[str]] | None:
    """Return a formula as a function of its names, and the names; None if it is not plain arithmetic."""
    written = re.fullmatch(r"\s*\$\{([^{}]*)\}\s*", text)
    return _compiled(written[1].strip()) if written else None


def _compiled(text: str) -> tuple[Formula, set[str]] | None:
    try:
        tree = ast.parse(text, mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            names.add(node.id)
        elif isinstance(node, ast.Constant):
            if not isinstance(node.value, (int, float)):
                return None
        elif not isinstance(node, (*_ALLOWED, *_OPERATORS)):
            return None
    return (lambda values: _value(tree.body, values)), names


def _value(node: ast.expr, values: Mapping[str, float]) -> float:
    if isinstance(node, ast.Name):
        return values[node.id]
    if isinstance(node, ast.Constant):
        return float(str(node.value))
    if isinstance(node, ast.UnaryOp):
        inner = _value(node.operand, values)
        return -inner if isinstance(node.op, ast.USub) else inner
    assert isinstance(node, ast.BinOp)
    left, right = _value(node.left, values), _value(node.right, values)
    if isinstance(node.op, ast.Add):
        return left + right
    if isinstance(node.op, ast.Sub):
        return left - right
    if isinstance(node.op, ast.Mult):
        return left * right
    return left / right if isinstance(node.op, ast.Div) else float(left**right)


def _agree(first: Formula, second: Formula, names: set[str]) -> bool:
    for sample in _SAMPLES:
        values = dict(zip(sorted(names), sample, strict=False))
        try:
            one, other = first(values), second(values)
        except (ArithmeticError, TypeError, ValueError):
            return False
        if not isinstance(one, float) or abs(one - other) > _TOLERANCE * abs(other):
            return False
    return True
