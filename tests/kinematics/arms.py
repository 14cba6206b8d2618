"""Eight arms of different makers, and their kinematics by Pinocchio, the truth for `Chain`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from urdfkit import load
from urdfkit.cli import main
from urdfkit.kinematics import Chain, Kinematics

CORPUS = Path(__file__).parents[3] / "shared" / "corpus"
ROBOTS = CORPUS / "example-robot-data" / "robots"

PANDA = (ROBOTS / "panda_description/urdf/panda.urdf", "panda_link0", "panda_hand")
"""Seven joints."""
UR5 = (ROBOTS / "ur_description/urdf/ur5_robot.urdf", "base_link", "tool0")
"""Six joints of -2π … 2π."""
UR5_LIMITED = (ROBOTS / "ur_description/urdf/ur5_joint_limited_robot.urdf", "base_link", "tool0")
"""Six joints of -π … π."""
FR3 = (CORPUS / "franka_description/robots/fr3/fr3.urdf.xacro", "base", "fr3_hand_tcp")
ROMEO = (ROBOTS / "romeo_description/urdf/romeo.urdf", "base_link", "r_wrist")
"""Seven joints above that of the torso."""


def made_arm(folder: Path, joints: int) -> tuple[Path, str, str]:
    """Create the packages of a robot with an arm of six or seven joints."""
    name = f"made{joints}"
    words = ["new", "robot", name, "--arm", str(joints), "--drive", "none", "--into", str(folder), "--yes", "--quiet"]
    assert main(words) == 0
    return folder / f"{name}_description", "world", "hand_roll_link"


def robot_or_skip(file: Path) -> object:
    if not file.exists():
        pytest.skip(f"{file.name} of the corpus is not here")
    return load(file)


class Reference:
    """Poses and Jacobians of a chain by Pinocchio."""

    def __init__(self, chain: Chain) -> None:
        self.chain = chain
        self.kinematics = Kinematics(chain.robot)

    def pose(self, q: np.ndarray, others: dict[str, float] | None = None) -> np.ndarray:
        """Return the pose of the tip in the base; `others` are positions of joints that are held."""
        positions = dict(others or {}) | dict(zip(self.chain.joint_names, q.tolist(), strict=True))
        placements = self.kinematics.placements(self.kinematics.configuration(positions))
        base, tip = (placements[self.kinematics.frame(name)] for name in (self.chain.base, self.chain.tip))
        return base.actInv(tip).homogeneous

    def poses(self, q: np.ndarray, others: dict[str, float] | None = None) -> np.ndarray:
        return np.array([self.pose(row, others) for row in q])


def random_configurations(chain: Chain, number: int, seed: int = 0) -> np.ndarray:
    """Return configurations within the limits; of joints without limits within a turn, or a metre."""
    lower = np.where(np.isfinite(chain.lower), chain.lower, -np.pi)
    upper = np.where(np.isfinite(chain.upper), chain.upper, np.pi)
    return np.random.default_rng(seed).uniform(lower, upper, (number, len(lower)))


def errors(poses: np.ndarray, targets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return distances [m] and angles [rad] between poses."""
    distance = np.linalg.norm(poses[:, :3, 3] - targets[:, :3, 3], axis=1)
    relative = np.einsum("nji,njk->nik", poses[:, :3, :3], targets[:, :3, :3])
    skew = relative - relative.transpose(0, 2, 1)
    sine = 0.5 * np.sqrt(skew[:, 2, 1] ** 2 + skew[:, 0, 2] ** 2 + skew[:, 1, 0] ** 2)
    return distance, np.arctan2(sine, 0.5 * (np.trace(relative, axis1=1, axis2=2) - 1.0))
