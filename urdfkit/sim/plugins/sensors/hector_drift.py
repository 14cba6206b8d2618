"""Error model of the sensors of hector_gazebo_plugins: offset, drift and noise.

The drift is a first-order Gauss-Markov process whose standard deviation is ``drift`` and whose time constant is the
inverse of ``driftFrequency``. It follows the documentation in hector_gazebo_plugins, sensor_model.h. The code there
multiplies the noise by the time step, so its drift decreases with the update rate.
"""

from math import exp

import numpy as np

from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array
from urdfkit.sim.plugins.parameters import Parameters

DRIFT_FREQUENCY = 1.0 / 3600.0
"""Default of ``driftFrequency`` [Hz]."""


class Drifting:
    """Error of one quantity.

    Args:
        offset: constant error, in the unit of the quantity; shape (n,).
        drift: standard deviation of the drift; shape (n,).
        frequency: inverse of the time constant of the drift [Hz]; shape (n,).
        noise: standard deviation of the noise; shape (n,).
        period: time between readings [s].
        key: key of its random generators.
    """

    def __init__(self, offset: Array, drift: Array, frequency: Array, noise: Array, *, period: float, key: int) -> None:
        self.offset, self.drift, self.noise = offset, drift, noise
        self._keep = np.array([exp(-each * period) for each in frequency])
        self._gain = drift * np.sqrt(1.0 - self._keep**2)
        self._key = key
        self._restart()

    def _restart(self) -> None:
        self._turn, self._drifted = 0, np.zeros(len(self.offset))
        self._random = np.random.Generator(np.random.Philox(key=[self._key, 0]))

    @property
    def variance(self) -> Array:
        """Variance of noise plus drift; shape (n,)."""
        found: Array = self.noise**2 + self.drift**2
        return found

    def at(self, turn: int) -> Array:
        """Return the error of the reading with a number; does not depend on earlier calls; shape (n,)."""
        if turn < self._turn:
            self._restart()
        if self.drift.any():
            steps = self._random.standard_normal((turn - self._turn, len(self.offset)))
            for step in steps:
                self._drifted = self._keep * self._drifted + self._gain * step
        self._turn = turn
        noise = np.random.Generator(np.random.Philox(key=[self._key, turn + 1])).standard_normal(len(self.offset))
        found: Array = self.offset + self._drifted + self.noise * noise
        return found


def drifting(
    read: Parameters, prefix: str, size: int, *, rate: float, dt: float, random: np.random.Generator
) -> Drifting:
    """Return the error model that a plugin's parameters describe.

    Args:
        read: the parameters, ``offset``, ``drift``, ``drift_frequency`` and ``gaussian_noise`` among them.
        prefix: prefix of these names, e.g. ``accel_``.
        size: number of components of the quantity.
        rate: rate of the sensor [Hz]; zero for every step.
        dt: the simulation's step [s].
        random: generator that draws the key.

    Raises:
        SimulationError: a parameter is invalid, with its position.
    """

    def vector(meaning: str, default: float, *, least: float | None = None) -> Array:
        text = read.text(prefix + meaning)
        if not text:
            return np.full(size, default)
        # gazebo::math::Vector3 uses a single number for x, y and z.
        found = (
            np.full(size, read.number(prefix + meaning))
            if len(text.split()) == 1
            else np.array(read.vector(prefix + meaning, size))
        )
        if least is not None and (found < least).any():
            message = f"<{read.tag(prefix + meaning)}> is `{text}`; it must be {least:g} or greater"
            raise SimulationError(message, position=read.place(prefix + meaning))
        return found

    return Drifting(
        vector("offset", 0.0),
        vector("drift", 0.0, least=0.0),
        vector("drift_frequency", DRIFT_FREQUENCY, least=0.0),
        vector("gaussian_noise", 0.0, least=0.0),
        period=max(dt, 1.0 / rate) if rate > 0 else dt,
        key=int(random.integers(1 << 62)),
    )
