"""Compilation of the kernel's functions, and the numba type of their fields."""

import operator
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
from llvmlite import ir
from numba.core import types
from numba.core.datamodel import models
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin, register_model

Function = TypeVar("Function", bound=Callable[..., Any])

# Reference counting is off: the caller of the kernel holds the two blocks, and all arrays are views of them. Atomic
# counting for some two hundred views would take longer than a step.
# Contraction lets a·b + c be one instruction, rounded once; nothing else of IEEE 754 is given up, so NaN stays NaN.
# Where that is done depends on the level that kernels are compiled for, not on the processor that runs them.
OPTIONS: dict[str, Any] = {"fastmath": {"contract"}, "error_model": "numpy", "nogil": True, "_nrt": False}


def inlined(function: Function) -> Function:
    """Compile a function as part of whichever kernel calls it."""
    return cast(Function, numba.njit(function, forceinline=True, **OPTIONS))


def compiled(function: Function) -> Function:
    """Compile a function that kernels call.

    Without `forceinline=False`, numba inlines a function whose first caller is `inlined`.
    """
    return cast(Function, numba.njit(function, forceinline=False, **OPTIONS))


class Field(types.Type):
    """Type of a field in compiled code: a pointer to its first entry.

    Unlike for arrays, negative indices are not supported, because checking them costs more than the arithmetic. The
    compiler may assume that a store to a float does not change an integer.
    """

    def __init__(self, dtype: Any) -> None:
        self.dtype = dtype
        super().__init__(name=f"Field({dtype})")


@register_model(Field)
class FieldModel(models.PrimitiveModel):  # type: ignore[misc]
    """A field in compiled code is a pointer."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, manager.lookup(kind.dtype).get_data_type().as_pointer())


@infer_global(operator.getitem)
class ReadField(AbstractTemplate):  # type: ignore[misc]
    """``field[k]``."""

    def generic(self, args: Any, kws: Any) -> Any:
        """Return the types of reading an entry."""
        block, index = args
        if isinstance(block, Field) and isinstance(index, types.Integer):
            return signature(block.dtype, block, types.int64)
        return None


@infer_global(operator.setitem)
class WriteField(AbstractTemplate):  # type: ignore[misc]
    """``field[k] = value``."""

    def generic(self, args: Any, kws: Any) -> Any:
        """Return the types of writing an entry."""
        block, index, value = args
        if isinstance(block, Field) and isinstance(index, types.Integer) and isinstance(value, types.Number):
            return signature(types.none, block, types.int64, block.dtype)
        return None


def of_kind(builder: Any, access: Any, dtype: Any) -> Any:
    """Mark an access so that the compiler knows that floats and integers do not alias."""
    module = builder.module
    root = module.add_metadata(["urdfkit"])
    kind = module.add_metadata([str(dtype), root, _zero()])
    access.set_metadata("tbaa", module.add_metadata([kind, kind, _zero()]))
    return access


def _zero() -> Any:
    """Return the constant 0, an offset in metadata."""
    return ir.Constant(ir.IntType(64), 0)


@lower_builtin(operator.getitem, Field, types.Integer)  # type: ignore[untyped-decorator]
def _read(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return of_kind(builder, builder.load(builder.gep(args[0], [args[1]])), sig.args[0].dtype)


@lower_builtin(operator.setitem, Field, types.Integer, types.Any)  # type: ignore[untyped-decorator]
def _write(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    of_kind(builder, builder.store(args[2], builder.gep(args[0], [args[1]])), sig.args[0].dtype)
    return context.get_dummy_value()
