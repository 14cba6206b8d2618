"""Numba types of several numbers of a field, and the operations on them."""

from __future__ import annotations

import operator
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.datamodel import models
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, register_model

from urdfkit.sim.engine.field_type import of_kind
from urdfkit.sim.engine.math.simd import FLAGS, LANES, STRIP


class Numbers(types.Type):
    """The type of so many numbers in compiled code."""

    def __init__(self, count: int) -> None:
        self.count = count
        super().__init__(name=f"Numbers({count})")

    @property
    def vector(self) -> Any:
        """Return what they are to the compiler."""
        return ir.VectorType(ir.DoubleType(), self.count)


FOUR, SIX, EIGHT, SIXTEEN = Numbers(4), Numbers(6), Numbers(STRIP), Numbers(LANES)


@register_model(Numbers)
class NumbersModel(models.PrimitiveModel):  # type: ignore[misc]
    """Several numbers in compiled code are one vector."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, kind.vector)


class OfTwo(AbstractTemplate):  # type: ignore[misc]
    """``a + b`` and ``a - b``."""

    def generic(self, args: Any, kws: Any) -> Any:
        """Return the types of a sum or difference."""
        a, b = args
        return signature(a, a, a) if isinstance(a, Numbers) and a == b else None


class OfOne(AbstractTemplate):  # type: ignore[misc]
    """``c * a``."""

    def generic(self, args: Any, kws: Any) -> Any:
        """Return the types of a multiple."""
        c, a = args
        return signature(a, c, a) if c == types.float64 and isinstance(a, Numbers) else None


infer_global(operator.add)(type("Add", (OfTwo,), {}))
infer_global(operator.sub)(type("Subtract", (OfTwo,), {}))
infer_global(operator.mul)(type("Multiply", (OfOne,), {}))


@lower_builtin(operator.add, Numbers, Numbers)  # type: ignore[untyped-decorator]
def _add(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.fadd(*args, flags=FLAGS)


@lower_builtin(operator.sub, Numbers, Numbers)  # type: ignore[untyped-decorator]
def _subtract(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.fsub(*args, flags=FLAGS)


@lower_builtin(operator.mul, types.Float, Numbers)  # type: ignore[untyped-decorator]
def _multiply(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    kind = sig.args[1]
    one = builder.insert_element(ir.Constant(kind.vector, ir.Undefined), args[0], ir.Constant(ir.IntType(32), 0))
    none = ir.Constant(ir.VectorType(ir.IntType(32), kind.count), [0] * kind.count)
    return builder.fmul(builder.shuffle_vector(one, one, none), args[1], flags=FLAGS)


def _place(builder: Any, kind: Any, block: Any, at: Any) -> Any:
    """Return where numbers of a field are."""
    return builder.bitcast(builder.gep(block, [at]), kind.vector.as_pointer())


def _reading(kind: Numbers) -> Any:
    """Return what reads so many numbers of a field."""

    def read(typing: Any, x: Any, at: Any) -> Any:
        def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return of_kind(builder, builder.load(_place(builder, kind, *arguments), align=8), types.float64)

        return kind(x, types.int64), codegen

    return intrinsic(read)


def _put(typing: Any, x: Any, at: Any, numbers: Any) -> Any:
    """Write numbers into a field."""

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        block, at, value = arguments
        place = _place(builder, signature.args[2], block, at)
        of_kind(builder, builder.store(value, place, align=8), types.float64)
        return context.get_dummy_value()

    return types.none(x, types.int64, numbers), codegen


load4: Any = _reading(FOUR)
"""Load four numbers of a field: ``load4(x, at)``."""
load6: Any = _reading(SIX)
"""Load six numbers of a field: ``load6(x, at)``."""
load8: Any = _reading(EIGHT)
"""Load eight numbers of a field: ``load8(x, at)``."""
load16: Any = _reading(SIXTEEN)
"""Load sixteen numbers of a field: ``load16(x, at)``."""
store: Any = intrinsic(_put)
"""Write numbers into a field: ``store(x, at, numbers)``."""
