"""SIMD operations on fields: ``load4(x, at)`` and the same for 6, 8 and 16, sums, multiples, and ``store``.

Free bodies have six dofs, and rows are processed sixteen at a time. Each operation compiles to one or two instructions,
where the compiler would otherwise emit one per number, because it does not vectorise these loops itself.
"""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.compilation import deferred, inlined

LANES = 16
"""How many rows are taken at a time. Their numbers have room for as many more, see `simulation_memory.allocate`."""
FLAGS = ("contract",)
"""As `compilation.OPTIONS` has it: a product and a sum may be one instruction."""


STRIP = 8
"""How many entries of a branch of a robot are taken at a time."""


@inlined
def padded(n: int) -> int:
    """Return n rounded up to a multiple of `LANES`."""
    return (n + LANES - 1) & -LANES


load4: Any = deferred("math.simd_types", "load4")
"""Load four numbers of a field: ``load4(x, at)``."""
load6: Any = deferred("math.simd_types", "load6")
"""Load six numbers of a field: ``load6(x, at)``."""
load8: Any = deferred("math.simd_types", "load8")
"""Load eight numbers of a field: ``load8(x, at)``."""
load16: Any = deferred("math.simd_types", "load16")
"""Load sixteen numbers of a field: ``load16(x, at)``."""
store: Any = deferred("math.simd_types", "store")
"""Write numbers into a field: ``store(x, at, numbers)``."""
