"""The tutorials' nodes do what their pages say."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

from urdfkit.sim import Simulator

TUTORIALS = Path(__file__).parents[2] / "docs" / "tutorials"


@pytest.mark.slow
def test_stop_on_white_drives_up_to_the_barrier_and_stops(capsys: pytest.CaptureFixture[str]) -> None:
    node = TUTORIALS / "stop_on_white.py"
    assert len(node.read_text().splitlines()) <= 30
    simulator = runpy.run_path(str(node))["simulator"]
    (reported,) = capsys.readouterr().out.splitlines()
    assert reported.endswith("Stopping!")
    x, y, _ = simulator.state.base_pose[:3]
    assert 0.8 < x < 2.0  # the barrier begins at 2.4 m
    assert abs(y) < 1e-3
    assert np.abs(simulator.state.base_velocity).max() < 1e-6
    assert float(reported.split()[0]) < 3.2


@pytest.mark.slow
def test_wander_drives_about_and_touches_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    simulator = runpy.run_path(str(TUTORIALS / "wander.py"))["simulator"]
    x, y, *_ = simulator.state.base_pose
    assert capsys.readouterr().out == f"at x {x:.1f} m, y {y:.1f} m\n"
    assert np.hypot(x, y) > 2.0
    links, bodies = set(simulator.kinematics.link_names), simulator.world.body_poses()
    pairs = [{contact.a, contact.b} for contact in simulator.state.contacts]
    assert any(pair & links for pair in pairs)  # its wheels touch the ground
    assert not [pair for pair in pairs if pair & links and pair & set(bodies)]
    for name, pose in Simulator("rrbot", world="house").world.body_poses().items():
        assert np.abs(np.array(bodies[name][:3]) - pose[:3]).max() < 1e-3, name  # nothing was pushed


def test_what_the_page_on_nodes_shows_does_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    blocks = re.findall(r"^```python\n(.*?)^```", (TUTORIALS / "own_node.md").read_text(), re.MULTILINE | re.DOTALL)
    topics, listens, tells = blocks
    told: dict[str, object] = {}
    exec(topics, told)
    assert "/scan sensor_msgs/msg/LaserScan" in capsys.readouterr().out.splitlines()
    exec(listens, told)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 2
    assert all(re.fullmatch(r"0\.\d\d s: \d+\.\d\d m ahead", line) for line in lines)
    exec(tells, told)
    assert capsys.readouterr().out == ""  # nobody listens any more
    assert isinstance(told["x"], float)
    assert told["x"] > 0.1
