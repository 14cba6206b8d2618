"""Joint limits that a step turns out to reach."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined

PASSING = 1e-9
"""How far beyond a limit a joint has passed it [rad or m]."""
WHIRLING = 0.05
"""Motion of a joint in a step from which on its velocity is evaluated at the middle of the step [rad or m]."""


@inlined
def passes_limits(floats: Any, integers: Any, first: int, beyond: int, dt: float) -> bool:
    """Mark the dofs that the step would take past a limit it seemed far from; return whether there are any.

    Each is marked once in a step, then `joint_rows` opens its row.
    """
    dof_s = field(integers, integers, At.dof_s)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    lower = field(floats, integers, At.lower)
    upper = field(floats, integers, At.upper)
    pressed = field(integers, integers, At.pressed)
    found = False
    for d in range(first, beyond):
        position = s[dof_s[d]]
        # In the middle of the next step, half of which is gone with this velocity.
        end = position + dt * v[d]
        if pressed[d] == 0 and lower[d] <= position <= upper[d] and not lower[d] - PASSING <= end <= upper[d] + PASSING:
            pressed[d] = -1 if end < lower[d] else 1
            found = True
    return found


@inlined
def whirls(floats: Any, integers: Any, first: int, beyond: int, dt: float) -> bool:
    """Return whether a joint moves so far in a step that velocity-dependent forces must be evaluated twice."""
    v = field(floats, integers, At.v_start)
    for d in range(first, beyond):  # noqa: SIM110
        if dt * abs(v[d]) > WHIRLING:
            return True
    return False
