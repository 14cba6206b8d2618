"""Whether the motion of a free body has died down, so that it may sleep although it still moves a little.

Rigid bodies in a heap hardly ever come to rest by themselves: a box swings on two contact points like a pendulum
without damping, contacts at a corner alternate from step to step, and a column creeps. Real bodies would lie still, as
their surfaces yield. So a free body is observed in windows of `PATIENCE`, and its motion has died down if, in the last
whole window,

- no point of the body was faster than `SLOW`,
- the average velocity of no point was above `CREEP`: a body that glides or slides continues,
- no point was faster than `GROWTH` times the fastest in the window before: a body that begins to tip continues.

The speed of a box of height h that tips over an edge grows as exp(t·√(3g/2h)) at least, by more than `GROWTH` in a
window for h up to 7.6 m. A block that slides from rest at more than 1.4 mm/s² is above `CREEP` before its speed less
than doubles from one window to the next.

A round body is an exception to the second condition, as nothing resists its rolling on the ground.
"""

from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import ZERO, add, dot, load_vector, scale, store_vector
from urdfkit.sim.engine.simulation_memory import OBSERVED
from urdfkit.sim.engine.sleep.rolling_resistance import is_round
from urdfkit.sim.engine.sleep.sleep_criteria import PATIENCE, QUIET

SLOW = 2e-2
"""Greatest speed [m/s] of a point of a body whose motion has died down: of a ball that rolls at 10 mm/s.

ODE disables bodies below 0.01 m/s and 0.01 rad/s, Box2D below 0.01 m/s and 2°/s for 0.5 s, Jolt where no point is
faster than 0.03 m/s for 0.5 s, Bullet below 0.8 m/s and 1 rad/s for 2 s.
"""
CREEP = 1e-3
"""Average speed [m/s] in a window above which a point of a body slides or glides on."""
GROWTH = 2.0
"""Ratio of the greatest speeds in two windows above which a motion grows; those below `QUIET` count as `QUIET`."""
WINDOW, FASTEST, FASTEST_BEFORE, DIED_DOWN = 1, 2, 3, 4
"""Places in ``still`` of a tree: time in this window, greatest speed in it and in the one before, and the result."""


@inlined
def point_speed(linear: Any, angular: Any, reach: float) -> float:
    """Return the greatest speed of points of a body up to a distance from its origin."""
    return float(dot(linear, linear) ** 0.5 + reach * dot(angular, angular) ** 0.5)


@inlined
def observe(w: KernelWorld, tree: int, dt: float) -> None:
    """Bring up to date whether the motion of a free body has died down."""
    still = w.still
    first, at = w.tree_dof[tree], OBSERVED * tree
    linear, angular = (w.v[first], w.v[first + 1], w.v[first + 2]), (w.v[first + 3], w.v[first + 4], w.v[first + 5])
    reach, rolls = 0.0, False
    for k in range(w.tree_shape[tree], w.tree_shape[tree + 1]):
        centre = load_vector(w.shape_p, k)
        reach = max(reach, w.shape_radius[k] + dot(centre, centre) ** 0.5)
        rolls = rolls or is_round(w, k)
    speed = point_speed(linear, angular, reach)
    if not speed < SLOW:
        still[at + WINDOW] = still[at + DIED_DOWN] = 0.0
        still[at + FASTEST_BEFORE] = SLOW
        return
    if still[at + WINDOW] == 0.0:
        still[at + FASTEST] = 0.0
        store_vector(w.displaced, 2 * tree, ZERO)
        store_vector(w.displaced, 2 * tree + 1, ZERO)
    still[at + WINDOW] += dt
    still[at + FASTEST] = max(still[at + FASTEST], speed)
    moved = add(load_vector(w.displaced, 2 * tree), scale(dt, linear))
    turned = add(load_vector(w.displaced, 2 * tree + 1), scale(dt, angular))
    store_vector(w.displaced, 2 * tree, moved)
    store_vector(w.displaced, 2 * tree + 1, turned)
    if still[at + WINDOW] >= PATIENCE:
        grows = still[at + FASTEST] > GROWTH * max(still[at + FASTEST_BEFORE], QUIET)
        creeps = not rolls and point_speed(moved, turned, reach) > CREEP * still[at + WINDOW]
        still[at + DIED_DOWN] = 0.0 if grows or creeps else 1.0
        still[at + FASTEST_BEFORE] = still[at + FASTEST]
        still[at + WINDOW] = 0.0
