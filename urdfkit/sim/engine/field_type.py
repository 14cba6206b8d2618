"""Numba type of the fields of a world."""

import operator
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.datamodel import models
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin, register_model


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
