"""Numbers by chance that are the same on every machine and in every version of Python."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import TypeVar

T = TypeVar("T")


class Chance:
    """Only `random()` of the standard library is promised to give the same numbers for a seed for ever.

    Args:
        seed: any whole number.
    """

    def __init__(self, seed: int) -> None:
        self._random = Random(seed)

    def between(self, low: float, high: float) -> float:
        """Return a number between two."""
        return low + (high - low) * self._random.random()

    def one_of(self, choices: Sequence[T]) -> T:
        """Return one of several."""
        return choices[min(int(self._random.random() * len(choices)), len(choices) - 1)]
