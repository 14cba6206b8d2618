"""How the kernel's functions are compiled."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
from numba.core import types
from numba.core.cgutils import pack_array
from numba.core.datamodel.models import ArrayModel
from numba.extending import intrinsic, lower_builtin, register_model
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


class Field(types.Array):
    """The type of a part of a block whose indices are never negative, so that none is counted from the end.

    Looking at the sign of every index takes time, and hides from the compiler what lies side by side.
    """

    def __init__(self, dtype: Any) -> None:
        """Make the type of one-dimensional fields of numbers of a type."""
        super().__init__(dtype, 1, "C", name=f"field({dtype})")


register_model(Field)(ArrayModel)


def _place(context: Any, builder: Any, kind: Any, field: Any, index_type: Any, index: Any) -> Any:
    """Return a pointer to an element."""
    at = context.cast(builder, index, index_type, types.intp)
    return builder.gep(make_array(kind)(context, builder, field).data, [at], inbounds=True)


@lower_builtin(operator.getitem, Field, types.Integer)  # type: ignore[untyped-decorator]
def _load(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    kind, index_type = signature.args
    place = _place(context, builder, kind, arguments[0], index_type, arguments[1])
    return context.unpack_value(builder, kind.dtype, place)


@lower_builtin(operator.setitem, Field, types.Integer, types.Any)  # type: ignore[untyped-decorator]
def _store(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    kind, index_type, value_type = signature.args
    place = _place(context, builder, kind, arguments[0], index_type, arguments[1])
    context.pack_value(builder, kind.dtype, context.cast(builder, arguments[2], value_type, kind.dtype), place)


def _part_of(kind_of: Callable[[Any], Any]) -> Callable[..., Any]:
    """Return the intrinsic that takes one field out of a block: block[integers[at]:integers[at + 1]], unchecked."""

    def _field(typing: Any, block: Any, integers: Any, at: Any) -> Any:
        """Return the part of a block that holds one field."""

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
            part = make_array(signature.return_type)(context, builder)
            populate_array(
                part,
                data=builder.gep(whole.data, [start]),
                shape=pack_array(builder, [builder.sub(beyond, start)]),
                strides=whole.strides,
                itemsize=whole.itemsize,
                meminfo=None,
            )
            return part._getvalue()

        return kind_of(block.dtype)(block, integers, types.int64), codegen

    return _field


field: Any = intrinsic(_part_of(lambda dtype: types.Array(dtype, 1, "C")))
"""Return the part of a block that holds one field: ``field(block, integers, at)``."""
bare_field: Any = intrinsic(_part_of(Field))
"""Return the same as a `Field`, for what is done over long rows of numbers."""
