"""Robots with skid steering that carry an arm turn as Coulomb friction on four evenly shared loads states."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pinocchio
import pytest

from urdfkit.description import load
from urdfkit.resources import find_model, templates_dir
from urdfkit.scaffold import create, load_template
from urdfkit.sim import Simulator

WHEELS = [f"{end}_{side}_wheel" for end in ("front", "rear") for side in ("left", "right")]
GRAVITY = 9.81
SPOT = [(0.0, sign * w) for w in (0.3, 0.5, 1.0, 2.0) for sign in (1, -1)]
CURVES = [(0.4, 0.3), (0.3, -0.5), (0.5, 1.0), (0.5, -1.0)]


@pytest.fixture(scope="module", params=["5", "6", "7"])
def robot(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A robot of the template with four driven wheels and an arm of 5, 6 or 7 joints."""
    folder = tmp_path_factory.mktemp("arm")
    template = load_template(templates_dir() / "robot")
    answers = {"name": "scout", "drive": "skid", "arm": request.param, "gripper": "no", "picture": "no"}
    create(template, template.answers(answers) | {"year": "2026", "into": "."}, folder)
    return load(find_model([f"{folder}/scout_description"]).path)


def coulomb(mass: float, centre: np.ndarray, products: np.ndarray, points: np.ndarray, surface: np.ndarray) -> Any:
    """Return vx, vy, w of a steady turn at which friction with coefficient 1 gives only the centripetal force.

    Args:
        mass: [kg].
        centre: of mass, from the ground under the base [m].
        products: of inertia about it, xz and yz as the matrix has them [kg·m²].
        points: where the wheels touch [m]; shape (4, 2).
        surface: speed of the wheels' rims [m/s].
    """
    conditions = np.vstack([np.ones(4), points.T])

    def rest(twist: np.ndarray) -> np.ndarray:
        vx, vy, w = twist
        acceleration = w * np.array([-(vy + w * centre[0]), vx - w * centre[1]])
        moments = mass * (GRAVITY * centre[:2] - centre[2] * acceleration) - w * w * products
        # Of all loads that balance, the most even ones.
        loads = np.linalg.lstsq(conditions, np.array([mass * GRAVITY, *moments]), rcond=None)[0]
        slip = np.column_stack([vx - w * points[:, 1] - surface, vy + w * points[:, 0]])
        friction = -loads[:, None] * slip / np.sqrt((slip**2).sum(axis=1) + 1e-18)[:, None]
        arms = points - centre[:2]
        moment = (arms[:, 0] * friction[:, 1] - arms[:, 1] * friction[:, 0]).sum()
        return np.array([*(friction.sum(axis=0) - mass * acceleration), moment])

    left, right = surface[points[:, 1] > 0].mean(), surface[points[:, 1] < 0].mean()
    twist = np.array([0.5 * (left + right), 1e-3, 0.5 * (right - left) / np.ptp(points[:, 1])])
    for _ in range(100):
        here = rest(twist)
        slopes = [(rest(twist + step) - here) / 1e-7 for step in 1e-7 * np.eye(3)]
        way, share = np.linalg.solve(np.column_stack(slopes), -here), 1.0
        while np.linalg.norm(rest(twist + share * way)) > np.linalg.norm(here) and share > 1e-6:
            share *= 0.5
        twist = twist + share * way
        if np.linalg.norm(here) < 1e-9 * mass:
            break
    assert np.linalg.norm(rest(twist)) < 1e-6 * mass
    return twist


@pytest.mark.slow
@pytest.mark.parametrize(("v", "w"), SPOT + CURVES)
def test_turns_as_even_loads_state(robot: Any, v: float, w: float) -> None:
    simulator = Simulator(robot, note=lambda _: None)
    while simulator.t < 1.5:
        share = min(1.0, (simulator.t + 0.5 * simulator.dt) / 0.5)
        simulator.command((v * share, 0, 0), (0, 0, w * share))
        simulator.step()
    model, q = simulator.kinematics.model, np.array(simulator.state.q)
    x, y, *_, sine, cosine = simulator.link_poses()[0]
    heading = 2.0 * math.atan2(sine, cosine)
    turned = np.array([[math.cos(heading), math.sin(heading)], [-math.sin(heading), math.cos(heading)]])
    poses = simulator.link_poses()[[simulator.kinematics.link_names.index(name) for name in WHEELS]]
    points = (poses[:, :2] - (x, y)) @ turned.T
    surface = np.array([simulator.state.velocity(f"{name}_joint") for name in WHEELS]) * poses[:, 2]
    data = model.createData()
    pinocchio.ccrba(model, data, q, np.zeros(model.nv))
    centre = np.array([*(turned @ (data.com[0][:2] - (x, y))), data.com[0][2]])
    expected = coulomb(data.Ig.mass, centre, turned @ data.Ig.inertia[:2, 2], points, surface)
    measured = np.array(simulator.state.v)[[0, 1, 5]]
    assert measured[:2] == pytest.approx(expected[:2], abs=1e-3)
    assert measured[2] == pytest.approx(expected[2], rel=1e-3)
