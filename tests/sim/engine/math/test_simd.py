"""Several numbers at once are what they are one by one."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.kernel_world import world
from urdfkit.sim.engine.math.simd import LANES, load6, load16, padded, store


@compiled
def mix(floats, integers):
    x = world(floats, integers).floats
    store(x, 1, load6(x, 1) + x[0] * load6(x, 7) - load6(x, 13))
    return x[0]


@compiled
def mix_sixteen(floats, integers):
    x = world(floats, integers).floats
    store(x, 1, load16(x, 1) + x[0] * load16(x, 17) - load16(x, 33))
    return padded(0), padded(1), padded(LANES), padded(LANES + 1)


def test_sums_and_multiples_are_those_of_each_number():
    x = np.random.default_rng(1).normal(size=20)
    made = x.copy()
    mix(made, np.zeros(1, dtype=np.int64))
    expected = x.copy()
    expected[1:7] = x[1:7] + x[0] * x[7:13] - x[13:19]
    assert made == pytest.approx(expected, abs=1e-15)
    assert (made[7:] == x[7:]).all()
    assert made[0] == x[0]


def test_sixteen_are_as_many_as_there_is_room_for():
    x = np.random.default_rng(2).normal(size=50)
    made = x.copy()
    assert mix_sixteen(made, np.zeros(1, dtype=np.int64)) == (0, LANES, LANES, 2 * LANES)
    expected = x.copy()
    expected[1:17] = x[1:17] + x[0] * x[17:33] - x[33:49]
    assert made == pytest.approx(expected, abs=1e-15)
    assert (made[17:] == x[17:]).all()
