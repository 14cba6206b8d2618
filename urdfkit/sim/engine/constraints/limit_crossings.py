"""Joint limits that a step turns out to reach."""

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld

PASSING = 1e-9
"""How far beyond a limit a joint has passed it [rad or m]."""
WHIRLING = 0.05
"""Motion of a joint in a step from which on its velocity is evaluated at the middle of the step [rad or m]."""


@inlined
def passes_limits(w: KernelWorld, first: int, beyond: int, dt: float) -> bool:
    """Mark the dofs that the step would take past a limit it seemed far from; return whether there are any.

    Each is marked once in a step, then `joint_rows` opens its row.
    """
    found = False
    for d in range(first, beyond):
        position = w.s[w.dof_s[d]]
        # In the middle of the next step, half of which is gone with this velocity.
        end = position + dt * w.v[d]
        if (
            w.pressed[d] == 0
            and w.lower[d] <= position <= w.upper[d]
            and not w.lower[d] - PASSING <= end <= w.upper[d] + PASSING
        ):
            w.pressed[d] = -1 if end < w.lower[d] else 1
            found = True
    return found


@inlined
def whirls(w: KernelWorld, first: int, beyond: int, dt: float) -> bool:
    """Return whether a joint moves so far in a step that velocity-dependent forces must be evaluated twice."""
    for d in range(first, beyond):  # noqa: SIM110
        if dt * abs(w.v_start[d]) > WHIRLING:
            return True
    return False
