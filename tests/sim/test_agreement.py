"""The compiled engine and the reference from random states of every robot we ship: the quick part of `make soak`."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from urdfkit.resources import robot_names

BENCH = Path(__file__).parents[2] / "tests" / "bench"


def agreement() -> Any:
    """Return the module tests/bench/agreement.py."""
    if str(BENCH) not in sys.path:
        sys.path.append(str(BENCH))
    return importlib.import_module("agreement")


@pytest.mark.parametrize("robot", robot_names())
def test_a_step_is_the_same_in_both_engines(robot: str) -> None:
    found = agreement().compare(robot, states=50)
    assert found.states == 50
    assert found.apart == (), f"v {found.velocity:.1e}, q {found.position:.1e}"


def test_a_difference_would_be_seen() -> None:
    pair = agreement().Pair("rrbot")
    drawn = pair.draw(np.random.default_rng(0))
    assert max(pair.step(drawn)[:2]) < 1e-9
    engine = pair.engines[0]
    step = engine.step

    def pushed(n: int = 1) -> None:
        engine.applied[0] += 0.01
        step(n)

    engine.step = pushed
    assert max(pair.step(drawn)[:2]) > 1e-9
