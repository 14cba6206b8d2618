"""The step of the engine with mass matrix, bias and Jacobians from Pinocchio: the kernel is compared with it.

It uses the arrays of the engine and advances them as the kernel does. Nothing sleeps in it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tests.reference_engine.pinocchio_engine import Reference
from urdfkit.sim.engine import Engine


class ReferenceEngine(Engine):
    """Engine whose step is computed with Pinocchio."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **{**options, "sleep": False})

    def _step_function(self, *, alone: bool) -> Callable[..., int]:
        return Reference(self._members, self._free, self.arrays).advance


ENGINES = (Engine, ReferenceEngine)
