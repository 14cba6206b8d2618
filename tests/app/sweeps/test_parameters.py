"""Parameters of a sweep: the options of a run with their values."""

from __future__ import annotations

import pytest

from urdfkit.app.simulation.runs.run_options import RunOptions
from urdfkit.app.sweeps.parameters import options_with
from urdfkit.sim import Spawn


@pytest.mark.parametrize(
    ("name", "value", "field", "expected"),
    [
        ("gravity", 1.6, "gravity", (0.0, 0.0, -1.6)),
        ("dt", 0.002, "dt", 0.002),
        ("cmd.ramp", 2.0, "ramp", 2.0),
        ("cmd.vx", 0.5, "command", (0.5, 0.0, 0.0)),
        ("cmd.vy", 0.5, "command", (0.0, 0.5, 0.0)),
        ("cmd.wz", 0.5, "command", (0.0, 0.0, 0.5)),
        ("target.elbow", 0.5, "joint_targets", {"elbow": 0.5}),
        ("spawn.yaw", 0.5, "spawn", Spawn(yaw=0.5)),
        ("spawn.elbow", 0.5, "spawn", Spawn(joints={"elbow": 0.5})),
    ],
)
def test_a_value_without_options(name: str, value: float, field: str, expected: object) -> None:
    assert getattr(options_with(RunOptions(), {name: value}), field) == expected


def test_values_replace_those_of_the_options_and_no_others() -> None:
    options = RunOptions(
        command=(0.1, 0.2, 0.3), joint_targets={"a": 1.0, "b": 2.0}, spawn=Spawn(x=1.0, y=2.0, joints={"a": 3.0})
    )
    found = options_with(options, {"cmd.wz": 0.9, "target.b": 7.0, "spawn.y": 8.0, "spawn.c": 9.0, "box.mass": 1.0})
    assert found.command == (0.1, 0.2, 0.9)
    assert found.joint_targets == {"a": 1.0, "b": 7.0}
    assert found.spawn == Spawn(x=1.0, y=8.0, joints={"a": 3.0, "c": 9.0})
