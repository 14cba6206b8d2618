"""Mass matrix and bias forces against Pinocchio, for every type of joint."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

TREE = """<robot name="tree"><link name="base"><inertial><origin xyz="0.1 0 0.2" rpy="0.3 0.1 -0.7"/><mass value="3"/>
<inertia ixx="0.1" iyy="0.15" izz="0.2" ixy="0.01" ixz="-0.02" iyz="0.003"/></inertial></link>{links}</robot>"""


def tree() -> str:
    parts, parents = "", ["base"]
    kinds = ("revolute", "prismatic", "continuous", "planar", "floating", "revolute", "prismatic", "continuous")
    for k, kind in enumerate(kinds):
        parent = parents[k // 2]
        parts += (
            f'<link name="l{k}"><inertial><origin xyz="0.1 {0.02 * k} -0.05" rpy="0.{k} 0.2 0.1"/>'
            f'<mass value="{k + 1}"/>'
            '<inertia ixx="0.1" iyy="0.15" izz="0.2" ixy="0.01" ixz="-0.02" iyz="0.003"/></inertial></link>'
            f'<joint name="j{k}" type="{kind}"><origin xyz="0.{k} -0.2 0.1" rpy="0.{k} -0.4 1.{k}"/>'
            f'<parent link="{parent}"/><child link="l{k}"/><axis xyz="0.{k} 1 -0.3"/>'
            '<limit lower="-3" upper="3" effort="9" velocity="9"/></joint>'
        )
        parents.append(f"l{k}")
    return TREE.format(links=parts)


@pytest.mark.parametrize("floating", [True, False])
@pytest.mark.parametrize("model", ["diff_drive", "arm", "tree", "double_pendulum"])
def test_terms_equal_pinocchio(engine_of, model, floating):
    engine = engine_of(tree() if model == "tree" else model, floating=floating, gravity=(0.3, -2.0, -9.0))
    model, data = engine.kinematics.model, engine.kinematics.data
    model.gravity.linear = np.array([0.3, -2.0, -9.0])
    random = np.random.default_rng(1)
    for _ in range(50):
        q = pin.integrate(model, pin.neutral(model), random.normal(size=model.nv))
        v = random.normal(size=model.nv)
        engine.reset(q, v)
        M = np.triu(pin.crba(model, data, q))
        M += np.triu(M, 1).T
        assert np.abs(engine.mass_matrix() - M).max() < 1e-12 * np.abs(M).max()
        h = pin.nonLinearEffects(model, data, q, v)
        assert np.abs(engine.bias_forces() - h).max() < 1e-12 * max(1.0, np.abs(h).max())
        pin.forwardKinematics(model, data, q)
        for joint, pose in enumerate(engine.body_poses(), start=1):
            assert np.abs(pose[:3] - data.oMi[joint].translation).max() < 1e-13 * 10
            assert np.abs(pose[3:].reshape(3, 3) - data.oMi[joint].rotation).max() < 1e-13
        energy = pin.computeKineticEnergy(model, data, q, v), pin.computePotentialEnergy(model, data, q)
        assert engine.energy() == pytest.approx(energy, rel=1e-12, abs=1e-12)
        assert pin.difference(model, q, engine.q) == pytest.approx(np.zeros(model.nv), abs=1e-12)


def test_a_floating_base_loses_no_precision_far_away(engine_of):
    engine = engine_of("diff_drive")
    model = engine.kinematics.model
    random = np.random.default_rng(2)
    q, v = engine.kinematics.neutral(), random.normal(size=model.nv)
    q[3:7] = [0.5, 0.5, 0.5, 0.5]
    engine.reset(q, v)
    near = engine.mass_matrix(), engine.bias_forces()
    q[:3] = [1e6, -2e6, 3e5]
    engine.reset(q, v)
    far = engine.mass_matrix(), engine.bias_forces()
    for here, there in zip(near, far, strict=True):
        assert np.array_equal(here, there)
