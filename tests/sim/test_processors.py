"""The same seed on other processors: the same state and messages. tests/bench/bench_levels.py runs every robot."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import pytest

from urdfkit.compilation.instruction_set import level

BENCH = Path(__file__).parents[1] / "bench"
if str(BENCH) not in sys.path:
    sys.path.append(str(BENCH))
bench = importlib.import_module("bench_levels")

pytestmark = pytest.mark.skipif(
    level() != "x86-64-v3", reason="this processor is below the level of the kernels, or numba is configured"
)


@pytest.mark.slow
@pytest.mark.parametrize(("scene", "seconds"), [("simpleton", 0.5), (bench.HEAP, 0.3)])
def test_same_state_and_messages_without_wider_instructions(scene, seconds):
    first, *others = [
        bench.run(scene, processor, f"--seconds={seconds}", "--record")
        for name, processor in bench.processors().items()
        if name not in bench.OTHERS
    ]
    assert len(others) == 2
    assert first["level"] == "x86-64-v3"
    for other in others:
        assert other["level"] == first["level"]
        assert other["state"] == first["state"]
        assert other["topics"] == first["topics"]
    assert len(first["topics"]) > 5 or scene == bench.HEAP


@pytest.mark.slow
def test_other_positions_have_another_digest():
    short, long = (bench.run(bench.HEAP, {}, f"--seconds={seconds}") for seconds in (0.002, 0.003))
    assert short["state"] != long["state"]
