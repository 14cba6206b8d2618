"""Functions, methods and operators of expressions give what Python gives, for values of every kind."""

from __future__ import annotations

import builtins
import math
import random
import warnings
from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import pytest

from urdfkit.description.xacro.evaluation.expressions import attributes, functions
from urdfkit.description.xacro.evaluation.expressions.budget import Budget
from urdfkit.description.xacro.evaluation.expressions.functions import Functions
from urdfkit.description.xacro.evaluation.expressions.interpreter import Expressions

CASES = 1200
"""Number of random expressions of a kind."""
WANTED = 120
"""At least so many have a value."""
REFUSED = ("vars(", "hash(len)", "type(len", "type[", "type(3, ", "slice(")
"""What is refused, or differs, on purpose."""
VALUES = {
    "int": ["3", "-2", "True"],
    "float": ["2.5", "-0.0"],
    "complex": ["2j"],
    "str": ["'ab b'", "'A\\t{0:>4}'", "'12'", "'b'", "''"],
    "bytes": ["'a b'.encode()"],
    "list": ["[3, 1, 2]", "['a', 'b']", "[(1, 2), (3, 4)]", "[]"],
    "tuple": ["(1, 'a')", "()"],
    "range": ["range(1, 9, 3)"],
    "dict": ["{'a': 1, 'b': 2}", "{97: 'x'}"],
    "set": ["{1, 2}"],
    "frozenset": ["frozenset([2, 3])"],
    "slice": ["slice(1, None, 2)"],
    "type": ["int", "(int, list)", "type(True)", "type"],
    "function": ["len", "(lambda x: -x)", "None"],
}
ALL = [value for values in VALUES.values() for value in values]
OPERATORS = "+ - * / // % ** @ << >> & | ^ == != < <= > >= in and or".split()  # noqa: SIM905
NAMED = ["key=(lambda x: -x)", "reverse=True", "default=7", "start=3", "sep='b'", "maxsplit=1", "strict=True"]


def calls() -> Iterator[str]:
    """Return calls of each function with up to two arguments of each kind."""
    values = [VALUES[kind][0] for kind in ("int", "str", "list", "dict", "type", "function")] + ["(int, list)", "2.5"]
    for name in functions._PYTHON.split():
        pairs = [f"{one}, {other}" for one, other in product(values, values)]
        given = ["", *values, "None", "range(3)", *pairs, *(f"[3, 1, 2], {each}" for each in NAMED)]
        yield from (f"{name}({inside})" for inside in given)
    numbers = ["3", "-2", "0", "2.5", "[3, 2]", "'a'"]
    for name in (name for name, value in vars(math).items() if callable(value) and name[0] != "_"):
        yield from (f"{name}({inside})" for inside in (*numbers, *map(", ".join, product(numbers[:3], numbers))))


def methods() -> Iterator[str]:
    """Return random calls of methods, with the value that they may change."""
    draw = random.Random(0)
    for _ in range(CASES):
        kind = draw.choice(list(attributes._METHODS))
        names = f"{attributes._METHODS[kind]} {attributes._DATA.get(kind, '')} {'format' * (kind is str)}"
        name, owner = draw.choice(names.split()), draw.choice(VALUES[kind.__name__])
        near = draw.choice([ALL, VALUES[kind.__name__] + VALUES["int"]])
        inside = draw.choices(near, k=draw.choice((0, 1, 1, 2, 3))) + draw.choices(NAMED, k=draw.random() < 0.1)
        if name in attributes._DATA.get(kind, ""):
            yield f"({owner}).{name}"
        elif draw.random() < 0.2 and kind is not bytes:
            yield f"{kind.__name__}.{name}({', '.join([owner, *inside])})"
        else:
            yield f"[(owner.{name}({', '.join(inside)}), owner) for owner in [{owner}]]"
    yield from ("dict.fromkeys('ab')", "dict.fromkeys([1], 2)", "str.maketrans('a', 'b')", "float.fromhex('0x1p2')")
    yield from ("','.join('ab')", "','.join('ab', 'c')")


def operations() -> Iterator[str]:
    """Return random operations, parts of values, loops and formatted texts."""
    draw = random.Random(0)
    for _ in range(CASES):
        left, right, third = draw.choices(ALL, k=3)
        number = draw.choice(VALUES["int"])
        yield draw.choice(
            [
                *[f"{left} {operator} {right}" for operator in draw.choices(OPERATORS, k=4)],
                f"{draw.choice(['-', '+', '~', 'not '])}{left}",
                f"{left}[{draw.choice([number, right])}]",
                f"[{left}[{number}:], {right}[:{number}:{draw.choice(VALUES['int'])}]]",
                f"{left} < {right} <= {third}",
                f"{left} if {right} else {third}",
                f'f"{{{number}!r:>5}}|{{2.5:{{{number}}}.1f}}"',
                f"'%s %5.1f' % ({left}, {right})",
                f"[(x, y) for x in {left} if x for y in {right} if x != y]",
                f"{{x: y for x, y in {left}}}",
                f"[*{left}, {right}]",
                f"(lambda x, y: (x, y))({right}, {draw.choice(['', '*'])}{third})",
            ]
        )


def outcome(compute: Callable[[], Any]) -> str:
    """Return a text of the value, with the items of iterators; or the error."""

    def shown(value: Any) -> Any:
        if isinstance(value, (list, tuple)):
            return type(value)(map(shown, value))
        is_iterator = hasattr(value, "__next__") or isinstance(value, (type({}.keys()), type({}.items())))
        return [shown(item) for item in value] if is_iterator else repr(value)

    try:
        return str(shown(compute()))
    except Exception as error:
        return type(error).__name__


@pytest.mark.parametrize("expressions_of", [calls, methods, operations])
def test_the_value_is_that_of_python(expressions_of: Callable[[], Iterator[str]]) -> None:
    budget = Budget()
    expressions = Expressions(budget)
    symbols = functions.mathematics(budget) | Functions(budget, expressions.callable_of).builtins(functions._PYTHON)
    names = vars(math) | {name: getattr(builtins, name) for name in functions._PYTHON.split()}
    different, values = {}, 0
    for text in dict.fromkeys(expressions_of()):
        if any(refused in text for refused in REFUSED):
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            expected = outcome(lambda text=text: eval(text, names))
            found = outcome(lambda text=text: expressions.evaluate(text, symbols))
        values += not expected.endswith(("Error", "Exception"))
        if found != expected and " at 0x" not in expected:
            different[text] = f"{found} instead of {expected}"
    assert not different
    assert values > WANTED
