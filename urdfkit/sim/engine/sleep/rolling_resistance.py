"""Rolling and spinning resistance of round free bodies, so that heaps of them come to rest and can sleep.

A rigid ball on a plane rolls for ever, also in this engine. In a heap of balls, cans and boxes, that would keep all
bodies awake, as would a ball that spins about the normal of its contact. Real bodies come to rest because surfaces
deform where they touch. Therefore, a moment resists the rotation of a round body

- about the normal of each of its contacts,
- about any axis, if it touches another free body, or if it rolls slowly at a constant speed, see `slow_motion`,

provided that its island contains only free bodies to which no force is applied. A single body that rolls faster than
50 mm/s or on a slope, and bodies that a robot touches, roll freely.
"""

import math

from urdfkit.sim.engine.collision.support_points import CAPSULE, CYLINDER, SPHERE
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import dot, load_spatial, load_vector, scale
from urdfkit.sim.engine.simulation_memory import OBSERVED, RESISTED
from urdfkit.sim.engine.sleep.sleep_criteria import is_free_body

COEFFICIENT = 0.01
"""Ratio of the force that keeps up rolling to the weight: of wood on wood, or of hard rubber."""
DONE = -1
"""Marks a tree whose turning is resisted already in this step."""


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
    """Let a moment resist the turning of the body of a round shape in a contact, once a step.

    It is at most what stops the body within the step.
    """
    if not is_round(w, shape):
        return
    body = w.shape_body[shape]
    tree = w.body_tree[body]
    touches_free = w.tree_block
    if touches_free[tree] == DONE:
        return
    first = w.tree_dof[tree] + 3
    turning = (w.v[first], w.v[first + 1], w.v[first + 2])
    if touches_free[tree] == 0 and w.still[OBSERVED * tree + RESISTED] == 0.0:
        # A free body's velocities are written in its own axes.
        normal = load_vector(w.contact_frame, 3 * k + 2)
        i, j, m = load_spatial(w.S, first - 3)[0], load_spatial(w.S, first - 2)[0], load_spatial(w.S, first - 1)[0]
        normal = (dot(normal, i), dot(normal, j), dot(normal, m))
        turning = scale(dot(turning, normal), normal)
    touches_free[tree] = DONE
    speed = math.sqrt(dot(turning, turning))
    if speed == 0.0:
        return
    least = min(
        w.M[w.dof_row[first] + first], min(w.M[w.dof_row[first + 1] + first + 1], w.M[w.dof_row[first + 2] + first + 2])
    )
    gravity = load_vector(w.gravity, 0)
    weight = w.mass[body] * math.sqrt(dot(gravity, gravity))
    radius = w.shape_size[3 * shape]
    share = min(COEFFICIENT * weight * radius, least * speed / dt) / speed
    w.bias[first] += share * turning[0]
    w.bias[first + 1] += share * turning[1]
    w.bias[first + 2] += share * turning[2]


@compiled
def resist_rolling(w: KernelWorld, root: int, dt: float) -> None:
    """Add to ``bias`` what resists the turning of the round bodies of an island."""
    if not (rolls(w, root) and is_left_to_itself(w, root)):
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
