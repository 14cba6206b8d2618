"""Robots on many contacts: few steps of Newton's method at rest, also where corrections contradict each other."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.bench.contact_rich.models import humanoid, quadruped
from tests.bench.contact_rich.scenes import FOLDED
from tests.sim.engine.conftest import EngineOf
from urdfkit import Simulator
from urdfkit.sim.engine import Engine, kernel_cache
from urdfkit.sim.engine.interpreted_kernel import interpreted, views
from urdfkit.sim.engine.simulation_memory import ADVANCE, GUESSES
from urdfkit.sim.engine.solver.augmented_newton import descend_tree

LINK = (
    '<link name="{0}"><inertial><origin xyz="{1}"/><mass value="{2}"/>'
    '<inertia ixx="{3}" ixy="0" ixz="0" iyy="{4}" iyz="0" izz="{5}"/></inertial>{6}</link>'
)
JOINT = (
    '<joint name="{0}_joint" type="revolute"><parent link="{1}"/><child link="{0}"/>'
    '<origin xyz="{2}"/><axis xyz="{3}"/><limit lower="{4}" upper="{5}" effort="200" velocity="23"/></joint>'
)
BOX = '<collision><origin xyz="{0}" rpy="0 1.57 0"/><geometry><box size="{1}"/></geometry></collision>'


def leg(name: str, x: float, y: float) -> str:
    """Return a leg with a shape at its thigh only; its calf begins outside of its limits."""
    side = math.copysign(1.0, y)
    hip, thigh, calf, foot = (f"{name}_{part}" for part in ("hip", "thigh", "calf", "foot"))
    box = BOX.format("-0.025 0 -0.16", "0.32 0.0445 0.054")
    return (
        LINK.format(hip, f"0 {0.01 * side} 0", 2.7, 0.005, 0.006, 0.004, "")
        + JOINT.format(hip, "base", f"{x} {y} 0", "1 0 0", -0.87, 0.87)
        + LINK.format(
            thigh,
            f"-0.01 {-0.02 * side} -0.05",
            4.5,
            0.055,
            0.053,
            0.01,
            box,
        )
        + JOINT.format(thigh, hip, f"0 {0.12 * side} 0", "0 1 0", -0.94, 4.69)
        + LINK.format(calf, "0.01 0 -0.14", 2.3, 0.03, 0.03, 0.001, "")
        + JOINT.format(calf, thigh, "0 0 -0.35", "0 1 0", -2.82, -0.43)
        + LINK.format(foot, "0 0 0", 1.1, 0.003, 0.005, 0.003, "")
        + JOINT.format(foot, calf, "0 0 -0.35", "0 1 0", -9, 9)
    )


WEIGHT = (10.0 + 4.0 * 1.8) * 9.81


def lying(engine_of: EngineOf) -> Engine:
    """Return a limp quadruped that lies on its legs, which are folded to their limits.

    It first balances on two of them and topples after four to five seconds, depending on rounding.
    """
    engine = engine_of(quadruped(0.1), sleep=False)
    engine.reset(engine.kinematics.configuration(FOLDED, base=np.array([0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0])))
    engine.step(7000)
    return engine


def newton_steps(engine: Engine, steps: int) -> list[int]:
    found = []
    for _ in range(steps):
        engine.step()
        found.append(int(engine.arrays["counts"][GUESSES]))
    return found


def test_a_robot_at_rest_takes_few_steps(engine_of: EngineOf) -> None:
    engine = lying(engine_of)
    taken = newton_steps(engine, 170)
    assert min(taken) > 0
    assert np.mean(taken) < 4.0
    assert np.abs(engine.v).max() < 1e-6
    assert sum(contact.force[2] for contact in engine.contacts()) == pytest.approx(WEIGHT, rel=1e-5)


def test_a_robot_at_rest_keeps_the_factors_of_its_matrix(engine_of: EngineOf, monkeypatch: pytest.MonkeyPatch) -> None:
    engine = lying(engine_of)
    advance: Any = interpreted(kernel_cache._advance(world=False))
    functions = interpreted(descend_tree.python).__globals__  # type: ignore[attr-defined]
    calls = {"factor_tree": 0, "solve_tree": 0}

    def count(name: str) -> None:
        function = functions[name]

        def counted(*arguments: Any) -> Any:
            calls[name] += 1
            return function(*arguments)

        monkeypatch.setitem(functions, name, counted)

    for name in calls:
        count(name)
    advance(views(engine.arrays.floats, engine.arrays.integers), None, 10, ADVANCE)
    assert calls["solve_tree"] >= 20
    assert calls["factor_tree"] <= 0.75 * calls["solve_tree"]


def test_a_collapsing_humanoid_takes_few_newton_steps(engine_of: EngineOf) -> None:
    engine = engine_of(humanoid(25, 1.0), sleep=False)
    pose = {"left_hip_pitch": 0.3, "right_knee": 0.4}
    engine.reset(engine.kinematics.configuration(pose, base=np.array([0.0, 0.0, 0.961, 0.0, 0.0, 0.0, 1.0])))
    taken = newton_steps(engine, 2000)
    # Friction jams it between 1.1 and 1.6 s: there, matrices have negative pivots.
    assert np.mean(np.abs(taken)) < 8.0
    assert engine.iterated < 15


def test_a_reset_engine_repeats_the_same_bytes(engine_of: EngineOf) -> None:
    engine = lying(engine_of)
    states = []
    for _ in range(2):
        engine.reset(engine.kinematics.configuration(FOLDED, base=np.array([0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0])))
        engine.step(700)
        states.append(engine.arrays["s"].tobytes() + engine.arrays["x"].tobytes())
    assert states[0] == states[1]


def test_thighs_that_jam_on_the_ground_do_not_sink(tmp_path: Path) -> None:
    """The calves return into their limits and so push the thighs, which slide on their edges with friction 1."""
    places = {"a": (0.33, 0.07), "b": (0.33, -0.07), "c": (-0.33, 0.07), "d": (-0.33, -0.07)}
    base = LINK.format("base", "0 0 0", 35.6, 0.4, 1.3, 1.5, BOX.format("0 0 0", "0.15 0.28 0.5"))
    legs = "".join(leg(name, *place) for name, place in places.items())
    path = tmp_path / "wheeled.urdf"
    path.write_text(f'<robot name="wheeled">{base}{legs}</robot>')
    simulator = Simulator(path)
    deepest = 0.0
    for _ in range(100):
        simulator.run(0.02)
        deepest = max(deepest, *(contact.depth for contact in simulator.state.contacts), 0.0)
    assert deepest < 1e-4


@pytest.mark.parametrize("seed", [0, 2])
def test_a_held_robot_deep_in_the_ground_is_lifted_out(tmp_path: Path, seed: int) -> None:
    """The quick correction needs ten times its weight, which its joints cannot bear; the slow one needs little."""
    path = tmp_path / "humanoid.urdf"
    path.write_text(humanoid(25))
    simulator = Simulator(path)
    random = np.random.default_rng(seed)
    for name in simulator.kinematics.joint_names:
        lower, upper = simulator.kinematics.limits(name)
        simulator.motors.hold(name, 0.7 * random.uniform(lower, upper))
    simulator.run(4.0)
    pose = list(simulator.state.base_pose)
    pose[2] -= 0.0105
    simulator.world.place(simulator.name, pose)
    simulator.run(3.0)
    assert max(contact.depth for contact in simulator.state.contacts) < 0.0035


def test_a_humanoid_whose_motors_press_its_fingers_down_does_not_sink(tmp_path: Path) -> None:
    """Motors of fingers can lift the robot: their rows weigh a thousandth of what they hold, so rounds hardly gain."""
    path = tmp_path / "humanoid.urdf"
    path.write_text(humanoid(42))
    simulator = Simulator(path)
    random = np.random.default_rng(6)
    deepest = 0.0
    for step in range(250):
        if step % 50 == 0:
            for name in simulator.kinematics.joint_names:
                simulator.motors.hold(name, random.uniform(-1.5, 1.5))
        simulator.step(10)
        deepest = max(deepest, *(contact.depth for contact in simulator.state.contacts), 0.0)
    assert deepest < 2e-3  # it was 7 mm
