"""Sine, cosine and the exponential next to numpy's in extended precision."""

from __future__ import annotations

import math

import numba
import numpy as np
import pytest

from urdfkit.sim.engine.compilation import OPTIONS
from urdfkit.sim.engine.math.elementary_functions import FAR, exponential, sine_cosine


@numba.njit(**OPTIONS)
def sines(angles, sine, cosine):
    for k in range(len(angles)):
        sine[k], cosine[k] = sine_cosine(angles[k])


@numba.njit(**OPTIONS)
def exponentials(numbers, found):
    for k in range(len(numbers)):
        found[k] = exponential(numbers[k])


def measured(angles):
    sine, cosine = np.empty_like(angles), np.empty_like(angles)
    sines(angles, sine, cosine)
    return sine, cosine


def ulps(found, exact):
    return float((np.abs(found - exact) / np.spacing(np.abs(found))).max())


@pytest.mark.skipif(np.finfo(np.longdouble).nmant < 63, reason="no extended precision to compare with")
@pytest.mark.parametrize("reach", [1e-3, 1.0, 10.0, 1e3, FAR])
def test_within_one_unit_in_the_last_place(reach):
    angles = np.random.default_rng(0).uniform(-reach, reach, 100_000)
    sine, cosine = measured(angles)
    assert ulps(sine, np.sin(angles.astype(np.longdouble))) < 1.0
    assert ulps(cosine, np.cos(angles.astype(np.longdouble))) < 1.0


@pytest.mark.skipif(np.finfo(np.longdouble).nmant < 63, reason="no extended precision to compare with")
def test_next_to_multiples_of_a_quarter():
    angles = np.arange(1, 100_000) * (math.pi / 2.0)
    sine, cosine = measured(angles)
    assert ulps(sine, np.sin(angles.astype(np.longdouble))) < 1.0
    assert ulps(cosine, np.cos(angles.astype(np.longdouble))) < 1.0


def test_of_wheels_that_have_turned_for_days():
    angles = np.random.default_rng(0).uniform(-1e9, 1e9, 10_000)
    sine, cosine = measured(angles)
    assert np.abs(sine - np.sin(angles)).max() < 1e-15
    assert np.abs(cosine - np.cos(angles)).max() < 1e-15


def test_of_no_number():
    sine, cosine = measured(np.array([math.inf, -math.inf, math.nan]))
    assert np.isnan(sine).all()
    assert np.isnan(cosine).all()
    sine, cosine = measured(np.array([0.0, -0.0]))
    assert np.signbit(sine).tolist() == [False, True]
    assert cosine.tolist() == [1.0, 1.0]


@pytest.mark.skipif(np.finfo(np.longdouble).nmant < 63, reason="no extended precision to compare with")
def test_exponential():
    numbers = -np.random.default_rng(0).uniform(0.0, 700.0, 100_000)
    found = np.empty_like(numbers)
    exponentials(numbers, found)
    assert ulps(found, np.exp(numbers.astype(np.longdouble))) < 1.0
    ends = np.array([0.0, -710.0, -math.inf])
    exponentials(ends, ends)
    assert ends.tolist() == [1.0, 0.0, 0.0]
