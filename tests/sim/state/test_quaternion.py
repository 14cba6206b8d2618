"""Quaternions of rotation matrices, and that making many keeps no memory."""

from __future__ import annotations

import gc
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest

from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.resources import find_model
from urdfkit.sim.engine import Engine
from urdfkit.sim.state.quaternion import from_matrix, product

LEAST_LOST = 80
"""What Pinocchio 4.1 loses at each ``pin.Quaternion(R)`` [B]."""


def test_a_product_is_the_rotation_by_the_second_then_the_first() -> None:
    rng = np.random.default_rng(0)
    for first, second in rng.normal(size=(20, 2, 4)):
        a, b = (pin.Quaternion(*(q[[3, 0, 1, 2]] / np.linalg.norm(q))) for q in (first, second))
        np.testing.assert_allclose(product(a.coeffs(), b.coeffs()), (a * b).coeffs(), atol=1e-15)


def test_a_matrix_becomes_its_quaternion() -> None:
    for turn in ([0.1, 0.2, -0.3], [3.0, 0.0, 0.1], [0.0, 0.0, np.pi]):
        R = pin.exp3(np.array(turn))
        np.testing.assert_allclose(from_matrix(R), pin.Quaternion(R).coeffs(), atol=1e-15)
        np.testing.assert_allclose(from_matrix(np.asfortranarray(R)), from_matrix(R), atol=0.0)


def resident() -> int:
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def shift() -> Callable[[], Any]:
    robot = load(find_model(["simpleton"]).path)
    engine = Engine(Kinematics(robot, floating_base=True), [])
    by = np.array([0.0, 0.0, 0.0, 1e-3, 2e-3, 0.0])
    return lambda: engine._shift_base(by)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="asks Linux for the memory in use")
@pytest.mark.parametrize("make", [lambda: lambda: from_matrix(np.eye(3)), shift], ids=["matrix", "base"])
def test_many_rotations_keep_no_memory(make: Callable[[], Callable[[], Any]]) -> None:
    call, times = make(), 40_000
    for _ in range(1000):
        call()
    before = resident()
    for _ in range(times):
        call()
    assert resident() - before < LEAST_LOST * times / 3
