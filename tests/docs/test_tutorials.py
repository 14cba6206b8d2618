"""The tutorials' nodes do what their pages say."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest

TUTORIALS = Path(__file__).parents[2] / "docs" / "tutorials"


def test_stop_on_white_drives_up_to_the_barrier_and_stops(capsys: pytest.CaptureFixture[str]) -> None:
    node = TUTORIALS / "stop_on_white.py"
    assert len(node.read_text().splitlines()) <= 30
    simulator = runpy.run_path(str(node))["simulator"]
    (said,) = capsys.readouterr().out.splitlines()
    assert said.endswith("Stopping!")
    x, y, _ = simulator.state.base_pose[:3]
    assert 0.8 < x < 2.0  # the barrier begins at 2.4 m
    assert abs(y) < 1e-3
    assert np.abs(simulator.state.base_velocity).max() < 1e-6
    assert float(said.split()[0]) < 3.2
