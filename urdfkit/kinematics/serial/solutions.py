"""Solutions of inverse kinematics, one per target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from urdfkit.kinematics.serial.serial_solver import Solution
from urdfkit.linear_algebra import Array


@dataclass(slots=True)
class Solutions:
    """Configurations for targets; for one target without the first axis.

    Attributes:
        q: the configurations, those nearest to targets that cannot be reached included; shape (N, n).
        reached: whether both errors are within the tolerance; shape (N,).
        position_error: distance from the tip to the target [m]; shape (N,).
        rotation_error: angle from the tip to the target [rad]; shape (N,).
        restarts: number of random starts that were needed; shape (N,).
        collisions: pairs of links that collide, of each target in order; None if they were not checked.

    Examples:
        >>> from urdfkit.kinematics import Chain
        >>> arm = Chain("seven_dof_arm", None, "grasping_frame")
        >>> far = arm.solve([9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
        >>> bool(far.reached), far.q.shape, float(far.position_error) > 8.0
        (False, (7,), True)
        >>> [solution.reached for solution in far.listed()]
        [False]
    """

    q: Array
    reached: NDArray[np.bool_]
    position_error: Array
    rotation_error: Array
    restarts: Array
    collisions: list[tuple[tuple[str, str], ...]] | None = None

    def listed(self) -> list[Solution]:
        """Return the solutions one by one."""
        q = np.atleast_2d(self.q)
        errors = np.atleast_1d(self.position_error).tolist(), np.atleast_1d(self.rotation_error).tolist()
        fields = np.atleast_1d(self.reached).tolist(), *errors, np.atleast_1d(self.restarts).astype(int).tolist()
        collisions: Sequence[tuple[tuple[str, str], ...] | None] = self.collisions or [None] * len(q)
        return [Solution(tuple(row), *values) for row, *values in zip(q.tolist(), *fields, collisions, strict=True)]
