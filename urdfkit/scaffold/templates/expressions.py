"""Arithmetic expressions and comparisons in a template: ``base_width + wheel_width + 0.02``."""

import ast
import math
import operator
from collections.abc import Callable, Mapping

from urdfkit.errors import ResourceError

_BINARY: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
_COMPARISONS: dict[type[ast.cmpop], Callable[[float, float], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
_FUNCTIONS: dict[str, Callable[..., float]] = {"min": min, "max": max, "hypot": math.hypot}
# `base_width + wheel_width` and a literal of the same value may differ in the last bit.
_TOLERANCE = 1e-9


def value_of(text: str, names: Mapping[str, float]) -> float:
    """Evaluate an arithmetic expression of a template.

    Args:
        text: expression of numbers, names, ``+ - * /``, parentheses, ``min(…)``, ``max(…)`` and ``hypot(…)``.
        names: values of the names.

    Raises:
        ResourceError: the expression is invalid.
    """
    return _value(_parsed(text), names, text)


def holds(text: str, names: Mapping[str, float]) -> bool:
    """Return whether a comparison of a template holds, to nine significant digits.

    Args:
        text: two expressions with ``<``, ``<=``, ``>`` or ``>=`` between them.
        names: values of the names.

    Raises:
        ResourceError: the comparison is invalid.
    """
    node = _parsed(text)
    if not isinstance(node, ast.Compare) or len(node.ops) != 1 or type(node.ops[0]) not in _COMPARISONS:
        raise ResourceError(f"`{text}` is not a comparison of two values")
    left, right = (_value(side, names, text) for side in (node.left, node.comparators[0]))
    slack = _TOLERANCE * max(abs(left), abs(right))
    kind = type(node.ops[0])
    return _COMPARISONS[kind](left, right + slack if kind in (ast.Lt, ast.LtE) else right - slack)


def names_in(text: str, *, comparison: bool = False) -> set[str]:
    """Return the names in an expression or a comparison of a template.

    Args:
        text: an expression for `value_of`, or a comparison for `holds`.
        comparison: whether `text` is a comparison.

    Raises:
        ResourceError: the expression or comparison is invalid.
    """
    names = {node.id for node in ast.walk(_parsed(text)) if isinstance(node, ast.Name)} - set(_FUNCTIONS)
    try:
        (holds if comparison else value_of)(text, dict.fromkeys(names, math.nan))
    except ZeroDivisionError:
        raise ResourceError(f"`{text}` divides by zero") from None
    return names


def _parsed(text: str) -> ast.expr:
    try:
        return ast.parse(text.strip(), mode="eval").body
    except SyntaxError as error:
        raise ResourceError(f"invalid expression `{text}`: {error.msg}") from error


def _value(node: ast.expr, names: Mapping[str, float], text: str) -> float:
    match node:
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.Name(id=name) if name in names:
            return names[name]
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_value(operand, names, text)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
            return _BINARY[type(op)](_value(left, names, text), _value(right, names, text))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in _FUNCTIONS and arguments:
            return _FUNCTIONS[name](*(_value(argument, names, text) for argument in arguments))
    raise ResourceError(f"cannot compute `{ast.unparse(node)}` in `{text}`")
