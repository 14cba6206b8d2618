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

A round body that rolls evenly through a window, slower than `ROLLS_ON` and by no more than `EVEN` faster or slower, is
driven by nothing. Rolling resistance acts on it from then on, until a window in which it was faster than in the one
before. So a ball comes to rest on level ground, and not on a slope of 0.01°. To keep a ball that turns back on a slope,
the conditions must hold for it in two windows in turn.

The second condition does not apply to a body in an island with another free body if the body is round, as rolling
resistance acts on it anyway, or if its centre of mass stays where it is. Such a body turns in place, for example a box
about two corners between a wall and a neighbour, and nothing drives it. Point contacts have no friction against that
rotation. Real contacts are patches, and their friction stops it: at a force of 10 N, a patch of 1 mm slows down a box
of 1 kg and 0.12 m by 2 rad/s².
"""

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import ZERO, add, cross, dot, load_vector, scale, store_vector
from urdfkit.sim.engine.simulation_memory import (
    DIED_DOWN,
    FASTEST,
    FASTEST_BEFORE,
    OBSERVED,
    RESISTED,
    SLOWEST,
    WINDOW,
)
from urdfkit.sim.engine.sleep.rolling_resistance import ROLLS_ON, is_round, point_speed
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
EVEN = 1e-3
"""Difference [m/s] of the greatest and least speed in a window of a body that rolls evenly: of a ball, 1 mm/s²."""


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
    if not speed < (ROLLS_ON if rolls else SLOW):
        still[at + WINDOW] = still[at + DIED_DOWN] = still[at + RESISTED] = 0.0
        still[at + FASTEST_BEFORE] = SLOW
        return
    if still[at + WINDOW] == 0.0:
        still[at + FASTEST] = 0.0
        still[at + SLOWEST] = speed
        store_vector(w.displaced, 2 * tree, ZERO)
        store_vector(w.displaced, 2 * tree + 1, ZERO)
    still[at + WINDOW] += dt
    still[at + FASTEST] = max(still[at + FASTEST], speed)
    still[at + SLOWEST] = min(still[at + SLOWEST], speed)
    moved = add(load_vector(w.displaced, 2 * tree), scale(dt, linear))
    turned = add(load_vector(w.displaced, 2 * tree + 1), scale(dt, angular))
    store_vector(w.displaced, 2 * tree, moved)
    store_vector(w.displaced, 2 * tree + 1, turned)
    if still[at + WINDOW] >= PATIENCE:
        fastest, before = still[at + FASTEST], still[at + FASTEST_BEFORE]
        grows = fastest > GROWTH * max(before, QUIET)
        alone = w.island[tree] == tree and w.island_next[tree] < 0
        centre = add(moved, cross(turned, load_vector(w.centre, w.tree_body[tree])))
        held = not alone and (rolls or dot(centre, centre) ** 0.5 <= QUIET * still[at + WINDOW])
        creeps = not held and point_speed(moved, turned, reach) > CREEP * still[at + WINDOW]
        share = 0.5 if rolls and alone else 1.0
        died_down = fastest < SLOW and not (grows or creeps)
        still[at + DIED_DOWN] = min(still[at + DIED_DOWN] + share, 1.0) if died_down else 0.0
        even = still[at + SLOWEST] >= QUIET and fastest - still[at + SLOWEST] <= EVEN
        slows = still[at + RESISTED] != 0.0 and fastest <= before
        still[at + RESISTED] = 1.0 if rolls and (even or slows) else 0.0
        still[at + FASTEST_BEFORE] = fastest
        still[at + WINDOW] = 0.0
