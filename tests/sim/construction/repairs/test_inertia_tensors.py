"""Repaired inertia tensors against the closed form of the projection."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from urdfkit.description import load
from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.robot import Link
from urdfkit.sim.construction.repairs.inertia_tensors import nearest_tensor, possible


def second_moments(tensor: np.ndarray) -> np.ndarray:
    return np.trace(tensor) / 2.0 * np.eye(3) - tensor


def turned(moments: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return a tensor with these principal moments, and its axes."""
    axes = pin.Quaternion(rng.normal(size=4)).normalized().matrix()
    return axes @ np.diag(moments) @ axes.T, axes


def test_the_nearest_tensor_is_the_closed_form_of_the_projection() -> None:
    rng = np.random.default_rng(1)
    for _ in range(500):
        a, b, c = moments = rng.normal(size=3)
        written, axes = turned(moments, rng)
        x, y, z = (max(0.0, (b + c - a) / 2), max(0.0, (a + c - b) / 2), max(0.0, (a + b - c) / 2))
        expected = axes @ np.diag([y + z, x + z, x + y]) @ axes.T
        np.testing.assert_allclose(nearest_tensor(written), expected, rtol=0, atol=1e-9)


def test_no_other_possible_tensor_is_nearer() -> None:
    rng = np.random.default_rng(2)
    written, _ = turned(np.array([0.1, 0.2, 0.9]), rng)
    distance = np.linalg.norm(second_moments(nearest_tensor(written)) - second_moments(written))
    assert distance > 0.29
    for size in (1e-3, 1e-2, 1e-1, 1.0):
        for _ in range(500):
            root = np.linalg.cholesky(second_moments(nearest_tensor(written)) + 1e-12 * np.eye(3))
            root = root + size * rng.normal(size=(3, 3))
            assert np.linalg.norm(root @ root.T - second_moments(written)) >= distance - 1e-9


def test_a_possible_tensor_stays() -> None:
    rng = np.random.default_rng(3)
    for _ in range(100):
        written, _ = turned(np.array([0.2, 0.3, 0.5]) + rng.uniform(0, 0.1, 3) * [1, 1, 0], rng)
        np.testing.assert_allclose(nearest_tensor(written), written, rtol=0, atol=1e-12)


def link(folder: Path, ixx: float, mass: float = 1.0) -> tuple[Link, AttachedBodies]:
    inertia = f'<inertia ixx="{ixx!r}" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/>'
    path = folder / "r.urdf"
    path.write_text(
        f'<robot name="r">\n<link name="a"><inertial><mass value="{mass}"/>{inertia}</inertial></link></robot>'
    )
    robot = load(path)
    return robot.links[0], AttachedBodies(robot)


@pytest.mark.parametrize(
    ("excess", "severity"), [(0.0, None), (5e-10, None), (5e-7, "note"), (9e-5, "note"), (1.1e-4, "warning")]
)
def test_slips_within_rounding_errors_are_notes(tmp_path: Path, excess: float, severity: str | None) -> None:
    written, bodies = link(tmp_path, 1.0 / (1.0 - excess))
    repaired, repair = possible(written, bodies)
    if severity is None:
        assert repaired is written
        assert repair is None
        return
    assert repair is not None
    assert (repair.severity, repair.kind, repair.code, repair.link) == (severity, "inertia", "I503", "a")
    assert str(repair).startswith(f"{tmp_path / 'r.urdf'}:2:")
    assert repaired.inertial is not None
    assert repaired.inertial.inertia is not None
    moments = np.linalg.eigvalsh(np.array(repaired.inertial.inertia.rows))
    assert moments[0] + moments[1] == pytest.approx(moments[2], rel=1e-12)


def test_the_message_has_the_moments_before_and_after(tmp_path: Path) -> None:
    _, repair = possible(*link(tmp_path, 2.0))
    assert repair is not None
    assert repair.message == (
        "the inertia of link `a` is impossible: of its principal moments 0.5, 0.5 and 2 kg·m² the largest exceeds the "
        "sum of the others, which is physically impossible; simulated with 1, 1, 2 kg·m² (changed by 33.3 %)"
    )
    assert possible(*link(tmp_path, -0.1))[1].code == "I502"
    assert possible(*link(tmp_path, 2.0, mass=-1.0))[1] is None
