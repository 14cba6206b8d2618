"""TorchChain: the poses of a chain as differentiable tensors of PyTorch, on the processor or a GPU."""

from typing import Any

import numpy as np

from urdfkit.errors import KinematicsError, MissingDependencyError
from urdfkit.kinematics.serial.serial_chain import SerialChain

try:
    import pytorch_kinematics as pk
    import torch
except ImportError as error:
    raise MissingDependencyError(
        f"Chain.torch needs pytorch-kinematics: pip install 'urdfkit[batch]' ({error})"
    ) from error


class TorchChain:
    """A chain whose poses and Jacobians are tensors with gradients.

    Every moving joint is a joint of pytorch-kinematics about or along its z axis; mimic joints are columns of `factors`
    that belong to their leader.

    Args:
        chain: the chain; joints that it holds do not move.
        device: ``cpu``, ``cuda`` or another device of PyTorch.
        dtype: type of the numbers; ``torch.float64`` when None.

    Attributes:
        joint_names: the variables, as those of `Chain`.
        lower: lower limits [rad] or [m]; shape (n,).
        upper: upper limits [rad] or [m]; shape (n,).
        factors: positions of the m moving joints are ``q @ factors + offsets``; shape (n, m).
        offsets: see `factors`; shape (m,).
        chain: the ``pytorch_kinematics.SerialChain`` of the m moving joints.
    """

    def __init__(self, chain: SerialChain, device: Any = "cpu", dtype: Any = None) -> None:
        dtype = torch.float64 if dtype is None else dtype
        where = {"dtype": dtype, "device": device}
        steps = np.array(chain.steps)
        *moving, last = np.split(steps, range(16, len(steps), 16))
        root = frame = pk.Frame("base")
        factors = np.zeros((len(chain.variables), len(moving)))
        offsets = np.zeros(len(moving))
        for k, (step, index) in enumerate(zip(moving, chain.indices, strict=True)):
            is_slide = bool(step[14:].any())
            factors[index, k], offsets[k] = step[14:] if is_slide else step[12:14]
            joint = pk.Joint(f"joint {k}", _placement(step, dtype), "prismatic" if is_slide else "revolute", **where)
            if (factor := factors[index, k]) != 0.0:
                ends = chain.variables[index].lower, chain.variables[index].upper
                joint.limits = sorted(factor * end + offsets[k] for end in ends)
            frame = _below(frame, f"frame {k}", joint)
        _below(frame, "tip", pk.Joint("tip", _placement(last, dtype)))
        root.to(**where)
        self.chain: Any = pk.SerialChain(pk.Chain(root, **where), "tip", **where)
        self.joint_names = tuple(variable.name for variable in chain.variables)
        self.lower: Any = torch.tensor([variable.lower for variable in chain.variables], **where)
        self.upper: Any = torch.tensor([variable.upper for variable in chain.variables], **where)
        self.factors: Any = torch.tensor(factors, **where)
        self.offsets: Any = torch.tensor(offsets, **where)

    def forward(self, q: Any, *, first_derivatives_only: bool = False) -> Any:
        """Return the poses of the tip in the base; shape (N, 4, 4).

        Args:
            q: configurations, a tensor; shape (N, n) or (n,).
            first_derivatives_only: compute gradients from the geometric Jacobian: in a fifth of the time for large N,
                but their own derivatives are wrong.

        Raises:
            KinematicsError: configurations of another length.
        """
        poses = self.chain.forward_kinematics_tensor(self._joints(q), analytical_grad=first_derivatives_only)
        return poses[-1].reshape(*q.shape[:-1], 4, 4)

    def jacobian(self, q: Any) -> Any:
        """Return the Jacobians at the tip in the axes of the base, linear rows first; shape (N, 6, n)."""
        jacobians = self.chain.jacobian_tensor(self._joints(q)) @ self.factors.T
        return jacobians.reshape(*q.shape[:-1], 6, len(self.joint_names))

    def _joints(self, q: Any) -> Any:
        """Return the positions of the moving joints; shape (N, m)."""
        if q.ndim == 0 or q.shape[-1] != len(self.joint_names):
            raise KinematicsError(f"configurations have {len(self.joint_names)} numbers; got shape {tuple(q.shape)}")
        return q.reshape(-1, q.shape[-1]) @ self.factors + self.offsets


def _below(parent: Any, name: str, joint: Any) -> Any:
    """Return a new frame below another one."""
    frame = pk.Frame(name, joint=joint)
    parent.add_child(frame)
    return frame


def _placement(step: Any, dtype: Any) -> Any:
    """Return the placement of a step: rotation by rows and translation."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = step[:9].reshape(3, 3), step[9:12]
    return pk.Transform3d(matrix=torch.tensor(matrix, dtype=dtype))
