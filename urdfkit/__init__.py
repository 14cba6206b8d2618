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
    "teleop",
    "view",
]


_CALLABLE = ("lint", "teleop", "view")
"""Public functions that have the name of a module: importing the module must not hide the function."""


def __getattr__(name: str) -> Any:
    if name in _CALLABLE:
        return _import_module(f"urdfkit.{name}")
    if name not in _MODULES:
        from urdfkit.errors import did_you_mean

        raise AttributeError(f"module 'urdfkit' has no attribute {name!r}{did_you_mean(name, __all__)}")
    return getattr(_import_module(_MODULES[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)


def _import_module(name: str) -> ModuleType:
    from importlib import import_module

    return import_module(name)


class _Root(ModuleType):
    """Type of this package: makes the modules of `_CALLABLE` callable when they are imported."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _CALLABLE and type(value) is ModuleType:
            value.__class__ = _CallableModule
        super().__setattr__(name, value)


class _CallableModule(ModuleType):
    """Module that calls the public function of the same name: `urdfkit.lint` and `urdfkit.lint.engine` both work."""

    @property
    def __wrapped__(self) -> Any:
        """The function; `inspect.signature` and editors show its parameters."""
        name = self.__name__.rpartition(".")[2]
        return getattr(_import_module(_MODULES[name]), name)

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Call the function."""
        return self.__wrapped__(*args, **kwargs)


sys.modules[__name__].__class__ = _Root
