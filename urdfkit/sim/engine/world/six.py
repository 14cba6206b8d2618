"""Six numbers at once, as free bodies have: ``six(x, at)`` of a field, sums and multiples of them, ``put`` into one.

The compiler does for each of these with one or two instructions what it does for six numbers with six; by itself it
does not see that.
"""

from __future__ import annotations

import operator
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.datamodel import models
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, register_model

from urdfkit.sim.engine.compilation import of_kind

NUMBERS = ir.VectorType(ir.DoubleType(), 6)
FLAGS = ("contract",)
"""As `compilation.OPTIONS` has it: a product and a sum may be one instruction."""


class Six(types.Type):
    """The type of six numbers in compiled code."""

    def __init__(self) -> None:
        super().__init__(name="Six")


SIX = Six()


@register_model(Six)
class SixModel(models.PrimitiveModel):  # type: ignore[misc]
    """Six numbers in compiled code are one vector."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, NUMBERS)


class OfTwo(AbstractTemplate):  # type: ignore[misc]
    """``a + b`` and ``a - b``."""

    def generic(self, args: Any, kws: Any) -> Any:
        """Return the types of a sum or difference."""
        return signature(SIX, SIX, SIX) if args == (SIX, SIX) else None


class OfOne(AbstractTemplate):  # type: ignore[misc]
    """``c * a``."""

    def generic(self, args: Any, kws: Any) -> Any:
        """Return the types of a multiple."""
        return signature(SIX, types.float64, SIX) if args == (types.float64, SIX) else None


infer_global(operator.add)(type("Add", (OfTwo,), {}))
infer_global(operator.sub)(type("Subtract", (OfTwo,), {}))
infer_global(operator.mul)(type("Multiply", (OfOne,), {}))


@lower_builtin(operator.add, Six, Six)  # type: ignore[untyped-decorator]
def _add(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.fadd(*args, flags=FLAGS)


@lower_builtin(operator.sub, Six, Six)  # type: ignore[untyped-decorator]
def _subtract(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.fsub(*args, flags=FLAGS)


@lower_builtin(operator.mul, types.Float, Six)  # type: ignore[untyped-decorator]
def _multiply(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    one = builder.insert_element(ir.Constant(NUMBERS, ir.Undefined), args[0], ir.Constant(ir.IntType(32), 0))
    none = ir.Constant(ir.VectorType(ir.IntType(32), 6), [0] * 6)
    return builder.fmul(builder.shuffle_vector(one, one, none), args[1], flags=FLAGS)


def _place(builder: Any, block: Any, at: Any) -> Any:
    """Return where six numbers of a field are."""
    return builder.bitcast(builder.gep(block, [at]), NUMBERS.as_pointer())


def _six(typing: Any, x: Any, at: Any) -> Any:
    """Return six numbers of a field."""

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return of_kind(builder, builder.load(_place(builder, *arguments), align=8), types.float64)

    return SIX(x, types.int64), codegen


def _put(typing: Any, x: Any, at: Any, numbers: Any) -> Any:
    """Write six numbers into a field."""

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        block, place, value = arguments
        of_kind(builder, builder.store(value, _place(builder, block, place), align=8), types.float64)
        return context.get_dummy_value()

    return types.none(x, types.int64, SIX), codegen


six: Any = intrinsic(_six)
"""Return six numbers of a field, from a place on: ``six(x, at)``."""
put: Any = intrinsic(_put)
"""Write six numbers into a field, from a place on: ``put(x, at, numbers)``."""
