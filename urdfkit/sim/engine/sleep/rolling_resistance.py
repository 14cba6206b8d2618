"""Rolling and spinning resistance of free bodies, so that heaps of them come to rest and can sleep.

A rigid ball on a plane rolls for ever, also in this engine. In a heap of balls, cans and boxes, that would keep all
bodies awake, as would a ball that spins about the normal of its contact. Real bodies come to rest because surfaces
deform where they touch. Therefore, a moment resists the rotation of a round body

- about the normal of each of its contacts,
- about any axis, if it touches another free body, or if it rolls slowly at a constant speed, see `slow_motion`,

provided that its island contains only free bodies to which no force is applied. A single body that rolls faster than
50 mm/s or on a slope, and bodies that a robot touches, roll freely.

A box that leans with a corner on a neighbour and with an edge on a wall turns about the line through both points, on
which friction has no lever: it swings from one corner to the next and back, for ever. The patches on which real bodies
touch resist that. Therefore, the same moment resists the rotation of other bodies about the normal of a contact, if
they touch another free body, are slow, and turn mostly about that normal. It does not act on a body that tips.
"""

import math
from typing import Any

from urdfkit.sim.engine.collision.support_points import CAPSULE, CYLINDER, SPHERE
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import dot, load_spatial, load_vector, scale
from urdfkit.sim.engine.simulation_memory import OBSERVED, RESISTED
from urdfkit.sim.engine.sleep.sleep_criteria import TURNING, is_free_body

COEFFICIENT = 0.01
"""Ratio of the force that keeps up rolling to the weight: of wood on wood, or of hard rubber."""
MOSTLY = 0.5
"""Least share of the turning of a body that is not round that is about the normal of a contact that resists it."""
ROLLS_ON = 0.1
"""Speed [m/s] of a point of a body that turns without resistance, if it is round, alone and on level ground, or not
round: of a ball that rolls at 50 mm/s, the ``sleepThreshold`` of Box2D 3."""
DONE = -1
"""Marks a tree whose turning is resisted already in this step."""


@inlined
def point_speed(linear: Any, angular: Any, reach: float) -> float:
    """Return the greatest speed of points of a body up to a distance from its origin."""
    return float(dot(linear, linear) ** 0.5 + reach * dot(angular, angular) ** 0.5)


@inlined
def is_round(w: KernelWorld, shape: int) -> bool:
    """Return whether a shape is round and on a body that nothing holds."""
    if shape < 0:
        return False
    body = w.shape_body[shape]
    kind = w.shape_kind[shape]
    if body < 0 or kind not in (SPHERE, CYLINDER, CAPSULE):
        return False
    return is_free_body(w, w.body_tree[body])


@compiled
def rolls(w: KernelWorld, root: int) -> bool:
    """Return whether an island touches with something that can roll."""
    k = w.island_contact[root]
    while k >= 0:
        if is_round(w, w.contact_shape[k]) or is_round(w, w.contact_against[k]):
            return True
        k = w.contact_next[k]
    return False


@inlined
def is_left_to_itself(w: KernelWorld, root: int) -> bool:
    """Return whether the trees of an island are all free bodies that nothing pushes."""
    tree = root
    while tree >= 0:
        if not is_free_body(w, tree):
            return False
        for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
            if w.applied[d] != 0.0:
                return False
        tree = w.island_next[tree]
    return True


@inlined
def resist(w: KernelWorld, k: int, shape: int, dt: float) -> None:
    """Let a moment resist the turning of the body of a shape in a contact, once a step.

    It is at most what stops the body within the step.
    """
    if shape < 0 or w.shape_body[shape] < 0:
        return
    body = w.shape_body[shape]
    tree = w.body_tree[body]
    touches_free = w.tree_block
    if not is_free_body(w, tree) or touches_free[tree] == DONE:
        return
    rounded = is_round(w, shape)
    if not rounded and touches_free[tree] == 0:
        return
    first = w.tree_dof[tree] + 3
    turning = (w.v[first], w.v[first + 1], w.v[first + 2])
    if not rounded or (touches_free[tree] == 0 and w.still[OBSERVED * tree + RESISTED] == 0.0):
        # A free body's velocities are written in its own axes.
        normal = load_vector(w.contact_frame, 3 * k + 2)
        i, j, m = load_spatial(w.S, first - 3)[0], load_spatial(w.S, first - 2)[0], load_spatial(w.S, first - 1)[0]
        normal = (dot(normal, i), dot(normal, j), dot(normal, m))
        about = dot(turning, normal)
        if not rounded:
            whole, linear = dot(turning, turning), (w.v[first - 3], w.v[first - 2], w.v[first - 1])
            if abs(about) < MOSTLY * math.sqrt(whole) or point_speed(linear, turning, w.shape_radius[shape]) > ROLLS_ON:
                return
        turning = scale(about, normal)
    touches_free[tree] = DONE
    speed = math.sqrt(dot(turning, turning))
    if speed == 0.0:
        return
    least = min(
        w.M[w.dof_row[first] + first], min(w.M[w.dof_row[first + 1] + first + 1], w.M[w.dof_row[first + 2] + first + 2])
    )
    gravity = load_vector(w.gravity, 0)
    weight = w.mass[body] * math.sqrt(dot(gravity, gravity))
    radius = w.shape_size[3 * shape] if rounded else w.shape_radius[shape]
    share = min(COEFFICIENT * weight * radius, least * speed / dt) / speed
    w.bias[first] += share * turning[0]
    w.bias[first + 1] += share * turning[1]
    w.bias[first + 2] += share * turning[2]


@inlined
def turns(w: KernelWorld, root: int) -> bool:
    """Return whether a body turns in an island of several."""
    tree = root if w.island_next[root] >= 0 else -1
    while tree >= 0:
        for d in range(w.tree_dof[tree] + 3, w.tree_dof[tree + 1]):
            if abs(w.v[d]) > TURNING:
                return True
        tree = w.island_next[tree]
    return False


@compiled
def resist_rolling(w: KernelWorld, root: int, dt: float) -> None:
    """Add to ``bias`` what resists the turning of the bodies of an island."""
    if not ((rolls(w, root) or turns(w, root)) and is_left_to_itself(w, root)):
        return
    touches_free = w.tree_block
    tree = root
    while tree >= 0:
        touches_free[tree] = 0
        tree = w.island_next[tree]
    k = w.island_contact[root]
    while k >= 0:
        other = w.contact_other[k]
        if other >= 0:
            touches_free[w.body_tree[w.contact_body[k]]] = touches_free[w.body_tree[other]] = 1
        k = w.contact_next[k]
    k = w.island_contact[root]
    while k >= 0:
        resist(w, k, w.contact_shape[k], dt)
        resist(w, k, w.contact_against[k], dt)
        k = w.contact_next[k]
