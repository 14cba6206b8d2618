"""Solutions of inverse kinematics, one per target."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

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
    """

    q: Array
    reached: NDArray[np.bool_]
    position_error: Array
    rotation_error: Array
    restarts: Array
