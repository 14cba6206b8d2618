"""Budget: the steps that the expressions of one file may take, and the operators whose result can grow.

A step is an operation, an element of a container, or 8 characters of a text. A result that could be far larger than
its operands is measured before it is computed.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterable, Iterator

from urdfkit.description.xacro.evaluation.expressions.limits import (
    MAX_BITS,
    MAX_CHARACTERS,
    MAX_ELEMENTS,
    MAX_STEPS,
    excess,
    too_many_steps,
)
from urdfkit.description.xacro.evaluation.expressions.value_size import (
    CONTAINERS,
    TEXTS,
    check_characters,
    check_widths,
    steps_of,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_SMALL = 1 << 62
SIZED: tuple[type, ...] = (*TEXTS, *CONTAINERS, range)
"""The kinds of values whose size counts."""
_FIELD = r"%(?:\([^)]*\))?[-+ #0]*(\*|\d*)(?:\.(\*|\d*))?"


class Budget:
    """Counts steps, and computes what can grow.

    Attributes:
        left: the remaining steps.
    """

    def __init__(self, steps: int = MAX_STEPS) -> None:
        self.left = steps
        self.operators: dict[str, Callable[[Any, Any], Any]] = {
            "Add": self.add,
            "Sub": self._container_operator(operator.sub),
            "Mult": self.multiply,
            "Div": operator.truediv,
            "FloorDiv": operator.floordiv,
            "Mod": self.modulo,
            "Pow": self.power,
            "LShift": self.shift_left,
            "RShift": operator.rshift,
            "BitOr": self._container_operator(operator.or_),
            "BitAnd": self._container_operator(operator.and_),
            "BitXor": self._container_operator(operator.xor),
            "MatMult": operator.matmul,
        }

    def spend(self, steps: int) -> None:
        """Count steps.

        Raises:
            TooLarge: none are left.
        """
        self.left -= steps
        if self.left < 0:
            raise too_many_steps()

    def spend_on(self, value: Any) -> None:
        """Count an argument that a function reads once."""
        if isinstance(value, SIZED):
            self.spend(len(value) >> 3)  # type: ignore[arg-type]

    def checked(self, value: Any) -> Any:
        """Return a value whose size is within the limits, and count its size.

        Raises:
            TooLarge: it is not.
        """
        kind = type(value)
        if kind is float or kind is bool:
            return value
        if kind is int:
            if not -_SMALL < value < _SMALL and value.bit_length() > MAX_BITS:
                raise excess("an integer", MAX_BITS, "bits")
        elif kind is str:
            if len(value) > MAX_CHARACTERS:
                raise excess("a string", MAX_CHARACTERS, "characters")
            self.spend(len(value) >> 3)
        elif isinstance(value, SIZED):
            self.spend(steps_of(value))
        return value

    def each(self, items: Iterable[Any]) -> Iterator[Any]:
        """Yield the items and count each as a step."""
        for item in items:
            self.spend(1)
            yield item

    def add(self, a: Any, b: Any) -> Any:
        """Return a + b."""
        return self.checked(a + b)

    def multiply(self, a: Any, b: Any) -> Any:
        """Return a * b."""
        if type(a) is float or type(b) is float:
            return a * b
        if isinstance(a, int) and isinstance(b, int):
            if a.bit_length() + b.bit_length() > MAX_BITS:
                raise excess("an integer", MAX_BITS, "bits")
        elif isinstance(b, int):
            self._check_repetition(a, b)
        elif isinstance(a, int):
            self._check_repetition(b, a)
        return a * b

    def _check_repetition(self, value: Any, count: int) -> None:
        if count > 0 and isinstance(value, TEXTS):
            check_characters(len(value) * count)
            self.spend(len(value) * count >> 3)
        elif count > 0 and isinstance(value, CONTAINERS):
            steps = steps_of(value) * count
            if steps > MAX_ELEMENTS:
                raise excess("lists", MAX_ELEMENTS, "elements in total")
            self.spend(steps)

    def power(self, a: Any, b: Any) -> Any:
        """Return a ** b."""
        if isinstance(a, int) and isinstance(b, int) and abs(a) > 1 and a.bit_length() * abs(b) > MAX_BITS:
            raise excess("an integer", MAX_BITS, "bits")
        return a**b

    def shift_left(self, a: Any, b: Any) -> Any:
        """Return a << b."""
        if isinstance(a, int) and isinstance(b, int) and a and a.bit_length() + b > MAX_BITS:
            raise excess("an integer", MAX_BITS, "bits")
        return a << b

    def modulo(self, a: Any, b: Any) -> Any:
        """Return a % b, where a may be a format."""
        if not isinstance(a, (str, bytes)):
            return a % b
        text = a if isinstance(a, str) else a.decode("latin-1")
        fields = re.findall(_FIELD, text)
        check_widths(" ".join(f"{width} {precision}" for width, precision in fields))
        if any("*" in field for field in fields):
            check_characters(
                sum(abs(value) for value in (b if isinstance(b, tuple) else (b,)) if isinstance(value, int))
            )
        self.check_text(steps_of(b) * (len(fields) if isinstance(b, dict) else 1))
        return self.checked(a % b)

    def check_text(self, steps: int) -> None:
        """Count values that become text.

        Raises:
            TooLarge: the text would be far too long.
        """
        if steps > MAX_ELEMENTS:
            raise excess("a string", MAX_CHARACTERS, "characters")
        self.spend(1 + steps)

    def _container_operator(self, operation: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
        def compute(a: Any, b: Any) -> Any:
            if isinstance(a, (int, float)):
                return operation(a, b)
            return self.checked(operation(self.checked(a), self.checked(b)))

        return compute
