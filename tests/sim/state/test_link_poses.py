"""Poses of links and configurations that are read from a state, compared with Pinocchio."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from urdfkit.sim import Simulator, Spawn

INERTIA = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
JOINTS = {"turn": "continuous", "slide": "prismatic", "lever": "revolute", "glide": "planar", "fly": "floating"}
LIMIT = '<limit lower="-3" upper="3" effort="1" velocity="1"/>'


def every_joint(folder: Path) -> Path:
    """Return a robot with a joint of each type, and a fixed link on each of the links."""
    text, parent = f'<link name="base">{INERTIA}</link><link name="tag_base"/>', "base"
    text += '<joint name="tag_0" type="fixed"><parent link="base"/><child link="tag_base"/></joint>'
    for name, kind in JOINTS.items():
        text += (
            f'<link name="{name}_link">{INERTIA}</link><link name="tag_{name}"/>'
            f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{name}_link"/>'
            f'<origin xyz="0.1 0.2 -0.3" rpy="0.4 -0.5 2"/><axis xyz="0.6 0 0.8"/>{LIMIT}</joint>'
            f'<joint name="tag_{name}_joint" type="fixed"><parent link="{name}_link"/><child link="tag_{name}"/>'
            f'<origin xyz="1 2 3" rpy="-3 0.5 1.5"/></joint>'
        )
        parent = f"{name}_link"
    text += (
        f'<link name="follower">{INERTIA}</link><joint name="follow" type="revolute"><parent link="base"/>'
        f'<child link="follower"/><axis xyz="0 1 0"/>{LIMIT}<mimic joint="lever" multiplier="-0.5"/></joint>'
    )
    path = folder / "robot.urdf"
    path.write_text(f'<robot name="robot">{text}</robot>')
    return path


@pytest.mark.parametrize("world", ["void", "house"])
@pytest.mark.parametrize("fixed", [False, True])
def test_poses_are_those_of_pinocchio(tmp_path: Path, world: str, fixed: bool) -> None:
    spawn = Spawn(x=2.0, y=-1.0, z=5.0, yaw=2.0)
    simulator = Simulator(every_joint(tmp_path), world=world, fixed_base=fixed, spawn=spawn)
    state, kinematics = simulator.state, simulator.kinematics
    base = pin.XYZQUATToSE3(np.array(state.base_pose)) if fixed else pin.SE3.Identity()
    random = np.random.default_rng(1)
    articulation = simulator.world.robots["robot"].articulation
    signs = set()
    for _ in range(50):
        q = pin.integrate(kinematics.model, kinematics.neutral(), random.uniform(-4.0, 4.0, kinematics.model.nv))
        articulation.put(q)
        state.advance(0)
        assert np.allclose(state.q, q, rtol=0.0, atol=1e-13)
        poses = state.link_poses()
        assert poses.shape == (len(kinematics.link_names), 7)
        for link, pose, found in zip(kinematics.link_names, kinematics.link_poses(q), poses, strict=True):
            expected = base * pin.XYZQUATToSE3(pose)
            assert np.allclose(pin.XYZQUATToSE3(found).homogeneous, expected.homogeneous, rtol=0.0, atol=1e-12), link
            assert np.allclose(found, pin.SE3ToXYZQUAT(expected), rtol=0.0, atol=1e-7), link
            signs.add(int(np.argmax(np.abs(found[3:]))))
    assert signs == {0, 1, 2, 3}


def test_arrays_that_are_read_keep_the_moment_and_cannot_be_written() -> None:
    simulator = Simulator("simpleton")
    state = simulator.state
    simulator.command((0.4, 0.0, 0.0), (0.0, 0.0, 0.6))
    simulator.run(0.1)
    poses, q, snapshot = state.link_poses(), state.q, state.snapshot()
    kept = poses.copy(), q.copy()
    simulator.run(0.1)
    assert np.abs(state.link_poses() - kept[0]).max() > 1e-3
    assert np.array_equal(poses, kept[0])
    assert np.array_equal(q, kept[1])
    assert np.array_equal(snapshot.link_poses(), kept[0])
    for array in (poses, q, state.v, state.tau):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


@pytest.mark.parametrize("world", ["empty", "house"])
def test_reading_does_not_change_the_simulation(world: str) -> None:
    read, other = (Simulator("simpleton", world=world) for _ in range(2))
    for simulator in (read, other):
        simulator.command((0.4, 0.0, 0.0), (0.0, 0.0, 0.6))
    for _ in range(50):
        read.step(20)
        read.link_poses()
        read.world.body_poses()
        assert len(read.state.contacts) >= 3
        other.step(20)
    assert read.snapshot() == other.snapshot()
