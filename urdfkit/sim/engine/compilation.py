"""How the kernel's functions are compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])

# Contraction lets a·b + c be one instruction, rounded once; nothing else of IEEE 754 is given up, so NaN stays NaN.
OPTIONS: dict[str, Any] = {"fastmath": {"contract"}, "error_model": "numpy", "nogil": True}


def inlined(function: Function) -> Function:
    """Compile a function as part of whichever kernel calls it."""
    return cast(Function, numba.njit(function, forceinline=True, **OPTIONS))


def compiled(function: Function) -> Function:
    """Compile a function that kernels call."""
    return cast(Function, numba.njit(function, **OPTIONS))
