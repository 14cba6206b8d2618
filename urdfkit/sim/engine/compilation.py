"""Compilation of the functions of kernels. numba is imported when one is compiled, not with the modules."""

from collections.abc import Callable
from importlib import import_module
from typing import Any, TypeVar, cast

from urdfkit.compilation.deferred import Deferred

Function = TypeVar("Function", bound=Callable[..., Any])

# Reference counting is off: the caller of the kernel holds the two blocks, and all arrays are views of them. Atomic
# counting for some two hundred views would take longer than a step.
# Contraction lets a·b + c be one instruction, rounded once; nothing else of IEEE 754 is given up, so NaN stays NaN.
# Where that is done depends on the level that kernels are compiled for, not on the processor that runs them.
OPTIONS: dict[str, Any] = {"fastmath": {"contract"}, "error_model": "numpy", "nogil": True, "_nrt": False}


def deferred(module: str, name: str) -> Any:
    """Return an object of a module of the engine, which is imported on first use."""
    return Deferred(lambda: getattr(import_module(f"urdfkit.sim.engine.{module}"), name))


def register_types() -> None:
    """Register the types of the engine with numba; necessary before the first compilation."""
    for module in ("field_type", "kernel_world_type", "math.simd_types"):
        import_module(f"urdfkit.sim.engine.{module}")


class KernelFunction(Deferred):
    """Function that kernels call, compiled on first use.

    Args:
        function: in Python; an attribute, too.
        forceinline: whether callers contain its code.
    """

    def __init__(self, function: Callable[..., Any], *, forceinline: bool) -> None:
        self.python = function
        super().__init__(lambda: _compilable(function, forceinline=forceinline))


def _compilable(function: Callable[..., Any], *, forceinline: bool) -> Any:
    import numba

    register_types()
    return numba.njit(function, forceinline=forceinline, **OPTIONS)


def inlined(function: Function) -> Function:
    """Compile a function as part of whichever kernel calls it."""
    return cast(Function, KernelFunction(function, forceinline=True))


def compiled(function: Function) -> Function:
    """Compile a function that kernels call.

    Without `forceinline=False`, numba inlines a function whose first caller is `inlined`.
    """
    return cast(Function, KernelFunction(function, forceinline=False))
