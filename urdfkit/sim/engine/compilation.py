"""How the kernel's functions are compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
from numba.core import types
from numba.core.cgutils import pack_array
from numba.extending import intrinsic
from numba.np.arrayobj import make_array, populate_array

Function = TypeVar("Function", bound=Callable[..., Any])

# No references are counted: whoever calls the kernel holds the two blocks, all else are views of them. Counting, atomic
# as it is, for some two hundred views would take longer than a step.
# Contraction lets a·b + c be one instruction, rounded once; nothing else of IEEE 754 is given up, so NaN stays NaN.
OPTIONS: dict[str, Any] = {"fastmath": {"contract"}, "error_model": "numpy", "nogil": True, "_nrt": False}


def inlined(function: Function) -> Function:
    """Compile a function as part of whichever kernel calls it."""
    return cast(Function, numba.njit(function, forceinline=True, **OPTIONS))


def compiled(function: Function) -> Function:
    """Compile a function that kernels call."""
    return cast(Function, numba.njit(function, **OPTIONS))


def _field(typing: Any, block: Any, integers: Any, at: Any) -> Any:
    """Return the part of a block that holds one field: block[integers[at]:integers[at + 1]], unchecked."""

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = signature.args[0]
        whole = make_array(kind)(context, builder, arguments[0])
        starts = make_array(signature.args[1])(context, builder, arguments[1])
        place = builder.gep(starts.data, [arguments[2]])
        start = builder.load(place)
        beyond = builder.load(builder.gep(place, [context.get_constant(types.int64, 1)]))
        for load in (start, beyond):
            # Nobody moves a field: the compiler need not read its place again after every store.
            load.set_metadata("invariant.load", builder.module.add_metadata([]))
        part = make_array(kind)(context, builder)
        populate_array(
            part,
            data=builder.gep(whole.data, [start]),
            shape=pack_array(builder, [builder.sub(beyond, start)]),
            strides=whole.strides,
            itemsize=whole.itemsize,
            meminfo=None,
        )
        return part._getvalue()

    return types.Array(block.dtype, 1, "C")(block, integers, types.int64), codegen


field: Any = intrinsic(_field)
"""Return the part of a block that holds one field: ``field(block, integers, at)``."""
