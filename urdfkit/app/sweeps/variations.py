"""Values of the parameters of a sweep, and the runs that combine them."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import isfinite
from typing import Any
from zlib import crc32

import numpy as np

from urdfkit.errors import UsageError

Value = float | str
"""Value of a parameter; text for worlds and xacro arguments."""

XACRO, WORLD = "xacro.", "world"
TEXTS = (XACRO, WORLD)
"""Starts of the names of parameters whose values are texts."""
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_RANGE = re.compile(rf"({_NUMBER}):({_NUMBER}):(\d+)")
_INTERVAL = re.compile(rf"({_NUMBER})\.\.({_NUMBER})")
MOST = 1_000_000
"""Largest number of runs."""


@dataclass(frozen=True)
class Interval:
    """Interval of a uniform distribution, from which each seed draws a value."""

    low: float
    high: float

    def draw(self, name: str, seed: int) -> float:
        """Return the value of a parameter for a seed: the same in each sweep."""
        random = np.random.default_rng((seed, crc32(name.encode())))
        return float(random.uniform(self.low, self.high))


Variation = tuple[Value, ...] | Interval


@dataclass(frozen=True)
class SweepRun:
    """One run: its number, its seed and the values of its parameters."""

    number: int
    seed: int
    values: Mapping[str, Value]


def parse_variation(text: str) -> tuple[str, Variation]:
    """Return name and values of ``NAME=V1,V2,…``, ``NAME=FIRST:LAST:COUNT`` or ``NAME=LOW..HIGH``.

    Raises:
        UsageError: the text is not such a variation.
    """
    name, equals, values = text.partition("=")
    name, values = name.strip(), values.strip()
    if not equals or not name or not values:
        raise UsageError(f"`{text}` is not NAME=VALUES, such as chassis.mass=1:3:9 or left_wheel.mu=0.2,0.5,1")
    if found := _RANGE.fullmatch(values):
        count = int(found[3])
        if not 0 < count <= MOST:
            raise UsageError(f"`{text}` has {count} values; use 1 to {MOST}")
        return name, variation(name, np.linspace(float(found[1]), float(found[2]), count).tolist())
    if found := _INTERVAL.fullmatch(values):
        return name, variation(name, Interval(float(found[1]), float(found[2])))
    return name, variation(name, [each.strip() for each in values.split(",")])


def variation(name: str, values: Variation | Sequence[Any]) -> Variation:
    """Return checked values of a parameter, numbers as floats.

    Raises:
        UsageError: there is no value, or it is invalid or repeated.
    """
    is_text = name.startswith(TEXTS)
    if isinstance(values, Interval):
        if is_text or not (isfinite(values.low) and isfinite(values.high) and values.low <= values.high):
            raise UsageError(f"`{name}` cannot be drawn from {values.low:g}..{values.high:g}")
        return values
    if isinstance(values, str) or not isinstance(values, Sequence):
        raise UsageError(f"`{name}` varies by {values!r}; use a list of values or an Interval")
    found = tuple(str(each) if is_text else _number(name, each) for each in values)
    if not found:
        raise UsageError(f"`{name}` has no value")
    for each in found:
        if found.count(each) > 1:
            raise UsageError(f"`{name}` has the value {each} twice")
    return found


def _number(name: str, value: Any) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise UsageError(f"`{name}` has the value `{value}`, which is not a number") from None
    if not isfinite(number):
        raise UsageError(f"`{name}` has the value {number:g}; it must be finite")
    return number


def combine(variations: Mapping[str, Variation], seeds: int) -> list[SweepRun]:
    """Return the runs: every combination of the values, with each seed from 0 on.

    Raises:
        UsageError: there are no runs, or too many.
    """
    if seeds < 1:
        raise UsageError(f"a sweep with {seeds} seeds has no runs; use 1 or more")
    lists = {name: each for name, each in variations.items() if not isinstance(each, Interval)}
    count = seeds
    for values in lists.values():
        count *= len(values)
    if count > MOST:
        raise UsageError(f"the sweep has {count} runs; the maximum is {MOST}")
    runs: list[SweepRun] = []
    for values in product(*lists.values()):
        chosen = dict(zip(lists, values, strict=True))
        for seed in range(seeds):
            drawn = {name: each.draw(name, seed) for name, each in variations.items() if isinstance(each, Interval)}
            both = {**chosen, **drawn}
            runs.append(SweepRun(len(runs), seed, {name: both[name] for name in variations}))
    return runs
