"""One free body of an engine: where it is, how it moves, what pushes it."""

from collections.abc import Sequence

import numpy as np

from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array, matmul
from urdfkit.sim.engine.bodies import Body
from urdfkit.sim.engine.layout.tree_arrays import place_free
from urdfkit.sim.engine.simulation_memory import Arrays


class FreeBody:
    """A free body of an engine.

    Args:
        body: as given to the engine.
        arrays: the engine's.
        tree: its number among the engine's robots and free bodies.
    """

    def __init__(self, body: Body, arrays: Arrays, tree: int) -> None:
        self.body = body
        self._arrays = arrays
        self._tree = tree
        at, first = int(arrays["tree_s"][tree]), int(arrays["tree_dof"][tree])
        self._s = arrays["s"][at : at + 7]
        self._v = arrays["v"][first : first + 6]
        self._applied = arrays["applied"][first : first + 6]

    @property
    def pose(self) -> tuple[float, ...]:
        """Where it is: x y z [m] and quaternion x y z w."""
        return tuple(self._s.tolist())

    @property
    def twist(self) -> tuple[float, ...]:
        """Velocity of its origin [m/s] and angular velocity [rad/s], along the world's axes."""
        R = self._rotation()
        return (*matmul(R, self._v[:3]).tolist(), *matmul(R, self._v[3:]).tolist())

    @property
    def asleep(self) -> bool:
        """Whether it is at rest and left alone until something happens to it."""
        return bool(self._arrays["asleep"][self._tree])

    def place(self, pose: Sequence[float], twist: Sequence[float] = (0.0,) * 6) -> None:
        """Put it somewhere, with a velocity along the world's axes.

        Raises:
            SimulationError: a number is not finite, or there is no orientation.
        """
        place_free(self._arrays, self._tree, pose)
        speed = _six(twist)
        R = self._rotation()
        self._v[:3], self._v[3:] = matmul(R.T, speed[:3]), matmul(R.T, speed[3:])
        # A body that is placed is not at rest.
        self._arrays["still"][self._tree] = 0.0

    def put_back(self) -> None:
        """Put it where it started, at rest, with nothing that pushes it."""
        self.place(self.body.pose)
        self._applied[:] = 0.0

    def push(self, wrench: Sequence[float]) -> None:
        """Apply a force at the origin [N] and a torque [N·m], in the body's axes, until they are changed.

        Raises:
            SimulationError: a number is not finite.
        """
        self._applied[:] = _six(wrench)

    def _rotation(self) -> Array:
        import pinocchio as pin

        return np.array(pin.Quaternion(self._s[3:7].copy()).matrix())


def _six(numbers: Sequence[float]) -> Array:
    values = np.array(numbers, dtype=float)
    if values.shape != (6,) or not np.isfinite(values).all():
        raise SimulationError(f"{tuple(numbers)} must be six finite numbers, with the linear part first")
    return values
