"""Registration of the environments in Gymnasium, which calls `register` when it is imported."""

from __future__ import annotations

ID = "urdfkit/Robot-v0"
"""Identifier for `gymnasium.make` and `gymnasium.make_vec`."""


def register() -> None:
    """Register the environment of a single robot and the vector environment under `ID`."""
    import gymnasium

    if ID not in gymnasium.registry:
        gymnasium.register(
            ID,
            entry_point="urdfkit.sim.environments.robot_environment:RobotEnvironment",
            vector_entry_point="urdfkit.sim.environments.vector_environment:RobotVectorEnvironment",
        )
