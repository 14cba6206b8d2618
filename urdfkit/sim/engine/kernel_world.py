"""All arrays of a world as one value in compiled code, with each field as an attribute: ``w.mass[body]``."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.compilation import deferred


class KernelWorld:
    """All arrays of a world in compiled code.

    Its attributes are the fields `FLOATS` and `INTEGERS`, and `kernel_world_type.BLOCKS`.
    """

    def __getattr__(self, name: str) -> Any:
        """Return a field; compiled code only."""
        raise AttributeError(name)


world: Any = deferred("kernel_world_type", "world")
"""Return the `KernelWorld` of two blocks: ``world(floats, integers)``."""
