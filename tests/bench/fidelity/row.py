"""A row of the table: a closed form, and how far an engine is from it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from fidelity.scene import Run


class UnsupportedError(Exception):
    """An engine does not have what a scene needs."""


@dataclass(frozen=True)
class Row:
    """A check.

    Attributes:
        name: what is looked at.
        form: the closed form, with the numbers of the scene.
        unit: of the error; empty for a share of the closed form.
        error: of an engine.
        bound: what ours may be off at 1 ms, …
        coarse: … and at 5 ms; None: it is not held to anything.
        negligible: below this, two engines are as good as each other.
        bullet: whether PyBullet can be asked.
    """

    name: str
    form: str
    unit: str
    error: Callable[[Run], float]
    bound: float
    coarse: float | None
    negligible: float = 1e-9
    bullet: bool = True


def distance(a: Iterable[float], b: Iterable[float]) -> float:
    """Return how far apart two points are; infinite where one is no point."""
    far = math.dist(tuple(a), tuple(b))
    return far if math.isfinite(far) else math.inf


def elliptic_k(m: float) -> float:
    """Return the complete elliptic integral of the first kind of the parameter m, by the arithmetic-geometric mean."""
    a, b = 1.0, math.sqrt(1.0 - m)
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (a + b)
