"""Kinematics of a robot: configurations by name, frames of all links by Pinocchio, and chains with inverse kinematics.

A `Robot` goes in; placements, transforms, the ``pin.Model``, Jacobians and joint positions for poses come out.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from urdfkit.kinematics.chain import Chain
    from urdfkit.kinematics.joint_limits import JointLimitError
    from urdfkit.kinematics.mimic import Coupling
    from urdfkit.kinematics.model import Kinematics
    from urdfkit.kinematics.reach.base_placement import base_placement
    from urdfkit.kinematics.reach.reach_map import ReachMap, reach_map
    from urdfkit.kinematics.retiming.fastest_motion import retime
    from urdfkit.kinematics.self_collision.collision_matrix import collision_matrix
    from urdfkit.kinematics.serial.solutions import Solutions
    from urdfkit.kinematics.tf import TransformTree

__all__ = [
    "Chain",
    "Coupling",
    "JointLimitError",
    "Kinematics",
    "ReachMap",
    "Solutions",
    "TransformTree",
    "base_placement",
    "collision_matrix",
    "reach_map",
    "retime",
]

_HOMES = {
    "Chain": "chain",
    "Coupling": "mimic",
    "JointLimitError": "joint_limits",
    "Kinematics": "model",
    "ReachMap": "reach.reach_map",
    "Solutions": "serial.solutions",
    "TransformTree": "tf",
    "base_placement": "reach.base_placement",
    "collision_matrix": "self_collision.collision_matrix",
    "reach_map": "reach.reach_map",
    "retime": "retiming.fastest_motion",
}


def __getattr__(name: str) -> Any:
    """Import on first use: Pinocchio takes a third of a second."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
