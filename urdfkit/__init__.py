"""urdfkit: load, lint, view and simulate robots described in URDF or xacro.

The public names are listed in `__all__` and documented in docs/library.md. They are imported on first use, so that
``import urdfkit`` is fast.
"""

from __future__ import annotations

import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Any

    from urdfkit.app.simulation.simulation_handle import teleop as teleop
    from urdfkit.app.sweeps.sweep import sweep as sweep
    from urdfkit.app.viewer.viewing import view as view
    from urdfkit.description import Robot as Robot
    from urdfkit.description import expand as expand
    from urdfkit.description import load as load
    from urdfkit.description.sdf import World as World
    from urdfkit.errors import UrdfkitError as UrdfkitError
    from urdfkit.kinematics import Kinematics as Kinematics
    from urdfkit.lint import Finding as Finding
    from urdfkit.lint import lint as lint
    from urdfkit.sim import Simulator as Simulator
else:
    ModuleType = type(sys)  # importing `types` takes longer than the rest

__version__ = "0.1.0"

_MODULES = {
    "Finding": "urdfkit.lint.finding",
    "Kinematics": "urdfkit.kinematics",
    "Robot": "urdfkit.description",
    "Simulator": "urdfkit.sim",
    "UrdfkitError": "urdfkit.errors",
    "World": "urdfkit.description.sdf",
    "expand": "urdfkit.description",
    "lint": "urdfkit.lint",
    "load": "urdfkit.description",
    "sweep": "urdfkit.app.sweeps.sweep",
    "teleop": "urdfkit.app.simulation.simulation_handle",
    "view": "urdfkit.app.viewer.viewing",
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
    "sweep",
    "teleop",
    "view",
]


_EXTRAS = {"Kinematics": "view", "Simulator": "sim", "sweep": "sweep", "teleop": "sim", "view": "view"}
"""Public name → the extra with its dependencies."""

_FUNCTIONS = ("lint", "teleop", "view")
"""Public functions that have the name of a module, which importing that module must not hide."""


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        from urdfkit.errors import did_you_mean

        raise AttributeError(f"module 'urdfkit' has no attribute {name!r}{did_you_mean(name, __all__)}")
    from importlib import import_module

    try:
        value = getattr(import_module(_MODULES[name]), name)
    except ModuleNotFoundError as error:
        if name not in _EXTRAS or (error.name or "").partition(".")[0] == "urdfkit":
            raise
        from urdfkit.errors import MissingDependencyError

        message = f"urdfkit.{name} needs {error.name}: pip install 'urdfkit[{_EXTRAS[name]}]'"
        raise MissingDependencyError(message) from error
    if name in _FUNCTIONS:  # `urdfkit.lint.rule` is the module after `import urdfkit.lint.rule`
        value.__dict__ = import_module(f"urdfkit.{name}").__dict__
        globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)


class _Package(ModuleType):
    """Type of this package: the import system does not replace the functions of `_FUNCTIONS` by modules."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in _FUNCTIONS or type(value) is not ModuleType:
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
