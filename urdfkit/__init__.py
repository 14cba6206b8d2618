"""urdfkit: load, lint, view and simulate robots described in URDF or xacro.

The public names are listed in `__all__` and documented in docs/library.md. They are imported on first use, so that
``import urdfkit`` is fast.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description import Robot as Robot
    from urdfkit.description import expand as expand
    from urdfkit.description import load as load
    from urdfkit.description.sdf import World as World
    from urdfkit.errors import UrdfkitError as UrdfkitError
    from urdfkit.kinematics import Kinematics as Kinematics
    from urdfkit.lint import Finding as Finding
    from urdfkit.lint import lint as lint
    from urdfkit.sim import Simulator as Simulator

__version__ = "0.1.0"

_MODULES = {
    "Finding": "urdfkit.lint.finding",
    "Kinematics": "urdfkit.kinematics",
    "Robot": "urdfkit.description",
    "Simulator": "urdfkit.sim",
    "UrdfkitError": "urdfkit.errors",
    "World": "urdfkit.description.sdf",
    "expand": "urdfkit.description",
    "load": "urdfkit.description",
}

__all__ = [
    "Finding",
    "Kinematics",
    "Robot",
    "Simulator",
    "UrdfkitError",
    "World",
    "__version__",
    "expand",
    "lint",
    "load",
]


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name == "lint":  # this package can be called
        return import_module("urdfkit.lint")
    if name not in _MODULES:
        from urdfkit.errors import did_you_mean

        raise AttributeError(f"module 'urdfkit' has no attribute {name!r}{did_you_mean(name, __all__)}")
    return getattr(import_module(_MODULES[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
