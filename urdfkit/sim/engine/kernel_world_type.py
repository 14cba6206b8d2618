"""Numba type of `KernelWorld`."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models
from numba.core.typing.templates import AttributeTemplate, infer_getattr
from numba.extending import intrinsic, lower_getattr_generic, register_model
from numba.np.arrayobj import make_array

from urdfkit.sim.engine.field_type import Field
from urdfkit.sim.engine.simulation_memory import FLOATS, INTEGERS, At

FLOAT_FIELD, INTEGER_FIELD = Field(types.float64), Field(types.int64)
BLOCKS = {"floats": FLOAT_FIELD, "sizes": INTEGER_FIELD}
"""Attributes besides the fields: the block of floats, and that of integers, which begins with the sizes."""


class KernelWorldType(types.Type):
    """Type of `KernelWorld` in compiled code."""


WORLD = KernelWorldType("KernelWorld")


@register_model(KernelWorldType)
class KernelWorldModel(models.StructModel):  # type: ignore[misc]
    """A world in compiled code is the addresses of its two blocks."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, list(BLOCKS.items()))


@infer_getattr
class KernelWorldFields(AttributeTemplate):  # type: ignore[misc]
    """``w.mass``."""

    key = KernelWorldType

    def generic_resolve(self, kind: Any, name: str) -> Any:
        """Return the type of a field."""
        if name in FLOATS:
            return FLOAT_FIELD
        return INTEGER_FIELD if name in INTEGERS else BLOCKS.get(name)


@lower_getattr_generic(KernelWorldType)  # type: ignore[untyped-decorator]
def _field(context: Any, builder: Any, kind: Any, value: Any, name: str) -> Any:
    """Return the address of a field."""
    blocks = cgutils.create_struct_proxy(kind)(context, builder, value=value)
    if name in BLOCKS:
        return getattr(blocks, name)
    start = builder.load(builder.gep(blocks.sizes, [ir.Constant(ir.IntType(64), int(At[name]))]))
    # Fields do not move, so the compiler need not read the start again after every store.
    start.set_metadata("invariant.load", builder.module.add_metadata([]))
    return builder.gep(blocks.floats if name in FLOATS else blocks.sizes, [start])


def _world(typing: Any, floats: Any, integers: Any) -> Any:
    """Return the world of two blocks."""

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        blocks = zip(signature.args, arguments, strict=True)
        return cgutils.pack_struct(builder, [make_array(kind)(context, builder, block).data for kind, block in blocks])

    return WORLD(floats, integers), codegen


world: Any = intrinsic(_world)
"""Return the `KernelWorld` of two blocks: ``world(floats, integers)``."""
