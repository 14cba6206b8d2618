"""Forward kinematics of a robot by Pinocchio: configurations by name, frames of all links, transforms between them.

A `Robot` goes in; placements, transforms and the ``pin.Model`` come out.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from urdfkit.kinematics.joint_limits import JointLimitError
    from urdfkit.kinematics.mimic import Coupling
    from urdfkit.kinematics.model import Kinematics
    from urdfkit.kinematics.tf import TransformTree

__all__ = ["Coupling", "JointLimitError", "Kinematics", "TransformTree"]

_HOMES = {"Coupling": "mimic", "JointLimitError": "joint_limits", "Kinematics": "model", "TransformTree": "tf"}


def __getattr__(name: str) -> Any:
    """Import on first use: Pinocchio takes a third of a second."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
