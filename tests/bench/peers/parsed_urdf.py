"""URDF texts as our engine reads them."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from tests.bench.peers.scene import GRAVITY
from urdfkit.description import Robot, load
from urdfkit.kinematics import Kinematics


@lru_cache(maxsize=32)
def read(urdf: str) -> Robot:
    """Load a robot from its text."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.urdf"
        path.write_text(urdf, encoding="utf-8")
        return load(path)


class Weight:
    """What gravity demands of the joints of a robot whose root stands level.

    Args:
        urdf: its text.
    """

    def __init__(self, urdf: str) -> None:
        self._kinematics = Kinematics(read(urdf))
        self._kinematics.model.gravity.linear[:] = GRAVITY

    def __call__(self, positions: Mapping[str, float]) -> dict[str, float]:
        """Return joint → effort at rest [N·m], for these positions [rad]."""
        import pinocchio as pin

        kinematics = self._kinematics
        efforts = pin.computeGeneralizedGravity(
            kinematics.model, kinematics.data, kinematics.configuration(positions)
        ).tolist()
        return {joint: efforts[kinematics.velocity_index(joint)] for joint in positions}
