"""TorchChain: poses against Pinocchio, gradients by autograd against Jacobians of the compiled kernel."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.kinematics.arms import Reference, random_configurations
from tests.kinematics.test_chain import MOBILE
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError, MissingDependencyError
from urdfkit.kinematics import Chain

torch: Any = None

pytestmark = pytest.mark.slow  # the import of PyTorch


@pytest.fixture(scope="module", autouse=True)
def _import_torch() -> None:
    """Import PyTorch when a test runs, not when tests are collected."""
    global torch
    torch = pytest.importorskip("torch")
    pytest.importorskip("pytorch_kinematics")


def jacobians_by_autograd(forward: Callable[[Any], Any], q: np.ndarray) -> np.ndarray:
    """Return the derivatives of poses as twists, linear rows first; shape (N, 6, n)."""
    at = torch.tensor(q, requires_grad=True)
    poses = forward(at)
    rates = np.zeros((*q.shape, 4, 4))
    for i in range(3):
        for j in range(4):
            (rates[:, :, i, j],) = torch.autograd.grad(poses[:, i, j].sum(), at, retain_graph=True)
    turns = np.einsum("nvij,nkj->nvik", rates[..., :3, :3], poses[:, :3, :3].detach().numpy())
    twists = [*np.moveaxis(rates[..., :3, 3], -1, 0), turns[..., 2, 1], turns[..., 0, 2], turns[..., 1, 0]]
    return np.stack(twists, axis=1)


def test_the_poses_of_every_link_are_those_of_pinocchio(arm: Robot) -> None:
    """Continuous joints, mimic joints, a base that moves, and a base below the tip included."""
    tips = {link.name for link in arm.links}
    checked = 0
    for base, others in (("world", tips - {"world"}), ("camera", tips - {"camera", "camera_optical", "dial"})):
        for tip in sorted(others):
            chain = Chain(arm, base, tip)
            q = random_configurations(chain, 20)
            poses = chain.torch().forward(torch.tensor(q)).numpy()
            np.testing.assert_allclose(poses, Reference(chain).poses(q), rtol=0, atol=1e-12)
            checked += 1
    assert checked == 18


@pytest.mark.parametrize(("base", "tip"), [("world", "finger_b"), ("camera", "world"), ("finger_a", "camera_optical")])
@pytest.mark.parametrize("first_derivatives_only", [False, True])
def test_gradients_are_the_jacobians(arm: Robot, base: str, tip: str, first_derivatives_only: bool) -> None:
    chain = Chain(arm, base, tip)
    tensors = chain.torch()
    q = random_configurations(chain, 20, 1)
    found = jacobians_by_autograd(lambda at: tensors.forward(at, first_derivatives_only=first_derivatives_only), q)
    np.testing.assert_allclose(found, chain.jacobian(q), rtol=0, atol=1e-10)
    np.testing.assert_allclose(tensors.jacobian(torch.tensor(q)).numpy(), chain.jacobian(q), rtol=0, atol=1e-12)


def test_second_derivatives_are_those_of_differences(arm: Robot) -> None:
    tensors = Chain(arm, "world", "camera").torch()
    q = torch.tensor([[0.3, 0.1, -0.7]], dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradgradcheck(tensors.forward, q)
    with pytest.raises(RuntimeError, match="mismatch"):
        torch.autograd.gradgradcheck(lambda at: tensors.forward(at, first_derivatives_only=True), q)


@pytest.mark.parametrize(("base", "tip"), [("floor", "hand"), ("hand", "floor")])
def test_planar_and_held_joints(robot_of: Callable[[str], Robot], base: str, tip: str) -> None:
    hold = {"torso": 0.2}
    chain = Chain(robot_of(MOBILE.format(axis="1 2 -1")), base, tip, hold=hold)
    q = random_configurations(chain, 20)
    poses = chain.torch().forward(torch.tensor(q)).numpy()
    np.testing.assert_allclose(poses, Reference(chain).poses(q, hold), rtol=0, atol=1e-12)


def test_names_limits_and_shapes(arm: Robot) -> None:
    chain = Chain(arm, "world", "camera")
    tensors = chain.torch()
    assert tensors.joint_names == chain.joint_names
    np.testing.assert_array_equal(tensors.lower.numpy(), chain.lower)
    np.testing.assert_array_equal(tensors.upper.numpy(), chain.upper)
    # The limits of `bend` (-1.5 … 2) and of the dial, which follows it: 1.5 · bend - 0.2.
    np.testing.assert_allclose(tensors.chain.low.numpy(), [-np.inf, -0.1, -2.45], atol=1e-12)
    np.testing.assert_allclose(tensors.chain.high.numpy(), [np.inf, 0.4, 2.8], atol=1e-12)
    assert tensors.forward(torch.zeros(3, dtype=torch.float64)).shape == (4, 4)
    assert tensors.forward(torch.zeros(2, 5, 3, dtype=torch.float64)).shape == (2, 5, 4, 4)
    assert tensors.jacobian(torch.zeros(2, 5, 3, dtype=torch.float64)).shape == (2, 5, 6, 3)
    with pytest.raises(KinematicsError, match=r"configurations have 3 numbers; got shape \(7, 4\)"):
        tensors.forward(torch.zeros(7, 4, dtype=torch.float64))


def test_numbers_of_32_bits(arm: Robot) -> None:
    chain = Chain(arm, "world", "finger_b")
    q = random_configurations(chain, 20)
    poses = chain.torch(dtype=torch.float32).forward(torch.tensor(q, dtype=torch.float32))
    assert poses.dtype == torch.float32
    np.testing.assert_allclose(poses.numpy(), chain.forward(q), rtol=0, atol=2e-6)


def test_pytorch_is_imported_only_when_it_is_used() -> None:
    code = "import sys\nfrom urdfkit.kinematics import Chain\nassert 'torch' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_without_pytorch_kinematics(arm: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "urdfkit.kinematics.torch_chain", raising=False)
    monkeypatch.setitem(sys.modules, "pytorch_kinematics", None)
    with pytest.raises(MissingDependencyError, match=r"pip install 'urdfkit\[batch\]'"):
        Chain(arm, "world", "camera").torch()
