"""Validation of arguments from callers of the library: numbers, vectors and entity names."""

from collections.abc import Sequence
from math import isfinite
from typing import Any, TypeVar

from urdfkit.errors import SimulationError, UnknownNameError, did_you_mean

Found = TypeVar("Found")

LARGEST = 1e9
"""Largest number of a pose, velocity or command [m, m/s, rad, N, …]: products of larger ones overflow, and the
simulation diverges."""

COUNTS = {2: "two", 3: "three", 4: "four", 6: "six", 7: "seven"}


def number(value: Any, what: str, unit: str) -> float:
    """Return a number, finite or not.

    Raises:
        SimulationError: `value` is not a number.
    """
    try:
        return float(value)
    except (TypeError, ValueError):
        raise SimulationError(f"{what} is {value!r}; it must be a number [{unit}]") from None


def vector(values: Any, length: int, what: str, unit: str, *, finite: bool = True) -> tuple[float, ...]:
    """Return `length` numbers, by default finite ones.

    Raises:
        SimulationError: `values` has another length or contains something else.
    """
    try:
        found = tuple(float(value) for value in values)
    except (TypeError, ValueError):
        found = ()
    if len(found) != length or (finite and not all(map(isfinite, found))):
        kind = "finite numbers" if finite else "numbers"
        raise SimulationError(f"{what} is {values!r}; it must be {COUNTS[length]} {kind} [{unit}]")
    return found


def check_size(values: Sequence[float], what: str, unit: str) -> None:
    """Refuse numbers whose products overflow.

    Raises:
        SimulationError: a number is larger than `LARGEST`.
    """
    largest = max(values, key=abs)
    if abs(largest) > LARGEST:
        raise SimulationError(f"{what} contains {largest:g}; at most {LARGEST:g} can be simulated [{unit}]")


class ByName(dict[str, Found]):
    """Entities of a simulation by name.

    Args:
        kind: kind of the entities, for the error message.
        entities: the entities by name.
    """

    def __init__(self, kind: str, entities: dict[str, Found]) -> None:
        super().__init__(entities)
        self._kind = kind

    def __missing__(self, name: str) -> Found:
        """Raise an error that suggests the nearest name.

        Raises:
            UnknownNameError: always.
        """
        raise UnknownNameError(f"no {self._kind} `{name}` in the simulation{nearest(str(name), self)}")


def nearest(name: str, candidates: Any, *, most: int = 12) -> str:
    """Return ``; did you mean …`` with the nearest of the candidates; a list of the candidates if none is near."""
    names = list(dict.fromkeys(candidates))
    if hint := did_you_mean(name, names):
        return hint
    inside = [other for other in names if name and name.lower() in other.lower()]
    if inside:
        return f"; did you mean `{min(inside, key=len)}`?"
    if not names:
        return "; none exists"
    return f" (available: {', '.join(names[:most])}{', …' * (len(names) > most)})"
