"""Six numbers at once are what they are one by one."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.sim.engine.compilation import compiled, field
from urdfkit.sim.engine.world.six import put, six


@compiled
def mix(floats, integers):
    x = field(floats, integers, 0)
    put(x, 1, six(x, 1) + x[0] * six(x, 7) - six(x, 13))
    return x[0]


def test_sums_and_multiples_are_those_of_each_number():
    x = np.random.default_rng(1).normal(size=20)
    made = x.copy()
    mix(made, np.zeros(1, dtype=np.int64))
    expected = x.copy()
    expected[1:7] = x[1:7] + x[0] * x[7:13] - x[13:19]
    assert made == pytest.approx(expected, abs=1e-15)
    assert (made[7:] == x[7:]).all()
    assert made[0] == x[0]
