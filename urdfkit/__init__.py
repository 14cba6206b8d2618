"""urdfkit: from a URDF or xacro to a robot you lint, view, compute with and drive.

The public names are resolved on first use, so that ``import urdfkit`` is fast.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description import Robot as Robot
    from urdfkit.description import load as load
    from urdfkit.errors import UrdfkitError as UrdfkitError
    from urdfkit.kinematics import Kinematics as Kinematics
    from urdfkit.lint import Finding as Finding
    from urdfkit.lint import lint as lint
    from urdfkit.sim import Simulator as Simulator

__version__ = "0.1.0"

_HOME = {
    "Finding": "urdfkit.lint",
    "Kinematics": "urdfkit.kinematics",
    "Robot": "urdfkit.description",
    "Simulator": "urdfkit.sim",
    "UrdfkitError": "urdfkit.errors",
    "lint": "urdfkit.lint",
    "load": "urdfkit.description",
}

__all__ = ["Finding", "Kinematics", "Robot", "Simulator", "UrdfkitError", "__version__", "lint", "load"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'urdfkit' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
