"""Singular values of a Jacobian, and the direction of motion that a chain loses in a singular configuration."""

import math
from dataclasses import dataclass

import numpy as np

from urdfkit.linear_algebra import Array

SINGULAR = 1e-3
"""Smallest singular value, relative to the largest, below which a configuration is singular."""
PART = 0.1
"""Smallest part of a direction, relative to its largest, that is put in words."""


@dataclass(frozen=True, slots=True)
class JacobianAnalysis:
    """Singular values of a Jacobian; lengths [m] and angles [rad] have the same weight.

    Attributes:
        singular_values: the largest first; six, or one per joint of a chain with fewer joints.
        rank: number of singular values above `SINGULAR` times the largest.
        is_singular: whether the rank is smaller than the number of singular values.
        manipulability: Yoshikawa's measure, the product of the singular values.
        condition: ratio of the largest singular value to the smallest; infinite if that is zero.
        lost: twists of the tip that the joints cannot cause, but do in neighbouring configurations, linear first;
            shape (k, 6). Empty unless singular.
    """

    singular_values: Array
    rank: int
    is_singular: bool
    manipulability: float
    condition: float
    lost: Array


def analyse(jacobian: Array) -> JacobianAnalysis:
    """Return the analysis of a Jacobian; shape (6, n).

    The singular vectors of values below the threshold are the lost directions.
    """
    directions, values, _ = np.linalg.svd(jacobian, full_matrices=False)
    largest, smallest = float(values[0]), float(values[-1])
    rank = int(np.count_nonzero(values > SINGULAR * largest)) if largest > 0.0 else 0
    lost = directions[:, rank:].T.copy()
    for direction in lost:  # the sign is arbitrary: the largest part is positive
        direction *= math.copysign(1.0, direction[np.argmax(np.abs(direction).round(9))])
    return JacobianAnalysis(
        values,
        rank,
        rank < len(values),
        float(np.prod(values)),
        largest / smallest if smallest > 0.0 else math.inf,
        lost,
    )


def direction_in_words(twist: Array, base: str) -> str:
    """Return a twist of the tip in words, such as ``translation along x of `base_link```.

    Args:
        twist: linear and angular part in the axes of the base; shape (6,).
        base: name of the base link.
    """
    largest = float(np.abs(twist).max())
    parts = []
    for name, vector in (("translation along", twist[:3]), ("rotation about", twist[3:])):
        if np.abs(vector).max() > PART * largest:
            parts.append(f"{name} {_axis(vector)}")
    return f"{' with '.join(parts)} of `{base}`"


def _axis(vector: Array) -> str:
    """Return a vector as the name of an axis, or its unit vector."""
    unit = vector / math.sqrt(float((vector * vector).sum()))
    index = int(np.argmax(np.abs(unit)))
    if abs(unit[index]) > 0.999:
        return f"{'-' if unit[index] < 0.0 else ''}{'xyz'[index]}"
    return f"({', '.join(f'{number + 0.0:.3g}' for number in unit.round(3))})"
