"""Random numbers that are reproducible on every machine and with every version of Python."""

import random
from collections.abc import Sequence
from typing import TypeVar

T = TypeVar("T")


class Random:
    """Random numbers from `random.Random.random`, whose values for a seed are guaranteed not to change.

    Args:
        seed: any integer.
    """

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)

    def between(self, low: float, high: float) -> float:
        """Return a number between two numbers."""
        return low + (high - low) * self._random.random()

    def one_of(self, choices: Sequence[T]) -> T:
        """Return one of the choices."""
        return choices[min(int(self._random.random() * len(choices)), len(choices) - 1)]
