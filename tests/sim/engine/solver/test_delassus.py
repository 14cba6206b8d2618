"""However many rows there are, their matrix is that of the masses, and so are the velocities without impulses."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.sim.engine.simulation_memory import FOUND_ROWS

DT = 0.001


def rubbing(joints):
    """Return a tree of so many joints, each with dry friction; every third link bears two others."""
    parts = ['<link name="l0"/>']
    for k in range(1, joints + 1):
        parent = k - 2 if k % 3 == 2 and k > 2 else k - 1
        parts.append(
            f'<link name="l{k}"><inertial><origin xyz="0.02 0.01 0.1"/><mass value="1"/><inertia ixx="0.01" '
            f'iyy="0.012" izz="0.008" ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="j{k}" type="continuous">'
            f'<parent link="l{parent}"/><child link="l{k}"/><origin xyz="0 0 0.1"/><axis xyz="{k % 2} {1 - k % 2} 0"/>'
            '<dynamics friction="0.5"/></joint>'
        )
    return f'<robot name="rubbing">{"".join(parts)}</robot>'


@pytest.mark.parametrize("joints", [1, 2, 7, 8, 15, 16, 17, 33])
def test_rows_are_whitened_by_the_masses(engine_of, joints):
    engine = engine_of(rubbing(joints), floating=False, dt=DT, ground=None, gravity=(0.0, 0.0, 0.0))
    start = np.random.default_rng(joints).normal(scale=0.1, size=joints)
    engine.reset(None, start)
    engine.step()
    a = engine.arrays
    assert a["counts"][FOUND_ROWS] == joints
    # Each row is the velocity of one joint.
    M = np.tril(a["M"][: joints**2].reshape(joints, joints))
    M += np.tril(M, -1).T
    inverse = np.linalg.inv(M)
    A = a["A"][: joints**2].reshape(joints, joints)
    assert pytest.approx(inverse, rel=1e-9, abs=1e-9 * np.abs(inverse).max()) == A
    free = start - DT * inverse @ a["bias"]
    assert a["g"][:joints] == pytest.approx(free, rel=1e-9, abs=1e-9 * np.abs(free).max())
    change = free + inverse @ a["x"][:joints]
    assert engine.v == pytest.approx(change, rel=1e-9, abs=1e-9 * np.abs(free).max())
