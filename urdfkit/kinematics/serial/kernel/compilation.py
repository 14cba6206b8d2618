"""Compilation of the functions of the serial kernel, and arrays on their stack."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
from llvmlite import ir
from numba.core import types
from numba.core.typing import signature
from numba.extending import intrinsic

Function = TypeVar("Function", bound=Callable[..., Any])

# Contraction lets a·b + c be one instruction; nothing else of IEEE 754 is given up, so NaN stays NaN.
OPTIONS: dict[str, Any] = {"fastmath": {"contract"}, "error_model": "numpy", "nogil": True, "_nrt": False}

Floats = Any
"""Pointer to floats, in the annotations of functions of the kernel."""
Integers = Any
"""Pointer to integers."""
FLOATS = types.CPointer(types.float64)  # type: ignore[attr-defined]
INTEGERS = types.CPointer(types.int64)  # type: ignore[attr-defined]


def inlined(function: Function) -> Function:
    """Compile a function as part of the function that calls it."""
    return cast(Function, numba.njit(function, forceinline=True, **OPTIONS))


def compiled(function: Function) -> Function:
    """Compile a function that the kernel calls, without inlining."""
    return cast(Function, numba.njit(function, forceinline=False, **OPTIONS))


@intrinsic  # type: ignore[untyped-decorator]
def stack(typing: Any, size: Any) -> Any:
    """Return a pointer to that many floats (a literal) on the stack; the compiler keeps small arrays in registers."""
    if not isinstance(size, types.IntegerLiteral):
        return None

    def allocate(context: Any, builder: Any, call: Any, arguments: Any) -> Any:
        length = ir.Constant(ir.IntType(64), size.literal_value)
        with builder.goto_entry_block():
            return builder.alloca(ir.DoubleType(), size=length)

    return signature(FLOATS, size), allocate


@intrinsic  # type: ignore[untyped-decorator]
def shifted(typing: Any, pointer: Any, index: Any) -> Any:
    """Return a pointer to the entry with an index."""
    if not isinstance(pointer, types.CPointer):  # type: ignore[attr-defined]
        return None

    def move(context: Any, builder: Any, call: Any, arguments: Any) -> Any:
        return builder.gep(arguments[0], [arguments[1]])

    return signature(pointer, pointer, types.int64), move
