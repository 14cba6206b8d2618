"""What rolls, and what resists its turning.

A rigid ball that rolls on a plane does so for ever, and here it does. In a heap of balls, cans and boxes that would
keep everything awake, and so would a ball that turns on the spot, about the normal of its contact. A real one comes to
rest, as surfaces yield a little where they touch. So a moment resists the turning of a round body

- about the normal of its contact, on whatever it lies,
- about any axis, where it touches another free body,

as long as all that touch each other are free bodies that nothing pushes. What rolls by itself on the ground, or what a
robot touches, rolls freely.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.collision.support_points import CAPSULE, CYLINDER, SPHERE
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.math.spatial_algebra import dot, load_spatial, load_vector, scale
from urdfkit.sim.engine.sleep.sleep_criteria import is_free_body

COEFFICIENT = 0.01
"""Ratio of the force that keeps up rolling to the weight: of wood on wood, or of hard rubber."""
DONE = -1
"""Marks a tree whose turning is resisted already in this step."""


@inlined
def is_round(floats: Any, integers: Any, shape: int) -> bool:
    """Return whether a shape is round and on a body that nothing holds."""
    if shape < 0:
        return False
    body = field(integers, integers, At.shape_body)[shape]
    kind = field(integers, integers, At.shape_kind)[shape]
    if body < 0 or kind not in (SPHERE, CYLINDER, CAPSULE):
        return False
    return is_free_body(integers, field(integers, integers, At.body_tree)[body])


@compiled
def rolls(floats: Any, integers: Any, root: int) -> bool:
    """Return whether an island touches with something that can roll."""
    contact_next = field(integers, integers, At.contact_next)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    k = field(integers, integers, At.island_contact)[root]
    while k >= 0:
        if is_round(floats, integers, contact_shape[k]) or is_round(floats, integers, contact_against[k]):
            return True
        k = contact_next[k]
    return False


@inlined
def is_left_to_itself(floats: Any, integers: Any, root: int) -> bool:
    """Return whether the trees of an island are all free bodies that nothing pushes."""
    applied = field(floats, integers, At.applied)
    tree_dof = field(integers, integers, At.tree_dof)
    island_next = field(integers, integers, At.island_next)
    tree = root
    while tree >= 0:
        if not is_free_body(integers, tree):
            return False
        for d in range(tree_dof[tree], tree_dof[tree + 1]):
            if applied[d] != 0.0:
                return False
        tree = island_next[tree]
    return True


@inlined
def resist(floats: Any, integers: Any, k: int, shape: int, dt: float) -> None:
    """Let a moment resist the turning of the body of a round shape in a contact, once a step.

    It is at most what stops the body within the step.
    """
    if not is_round(floats, integers, shape):
        return
    body = field(integers, integers, At.shape_body)[shape]
    tree = field(integers, integers, At.body_tree)[body]
    touches_free = field(integers, integers, At.tree_block)
    if touches_free[tree] == DONE:
        return
    v = field(floats, integers, At.v)
    bias = field(floats, integers, At.bias)
    M = field(floats, integers, At.M)
    S = field(floats, integers, At.S)
    dof_row = field(integers, integers, At.dof_row)
    first = field(integers, integers, At.tree_dof)[tree] + 3
    turning = (v[first], v[first + 1], v[first + 2])
    if touches_free[tree] == 0:
        # A free body's velocities are written in its own axes.
        normal = load_vector(field(floats, integers, At.contact_frame), 3 * k + 2)
        i, j, m = load_spatial(S, first - 3)[0], load_spatial(S, first - 2)[0], load_spatial(S, first - 1)[0]
        normal = (dot(normal, i), dot(normal, j), dot(normal, m))
        turning = scale(dot(turning, normal), normal)
    touches_free[tree] = DONE
    speed = math.sqrt(dot(turning, turning))
    if speed == 0.0:
        return
    least = min(M[dof_row[first] + first], min(M[dof_row[first + 1] + first + 1], M[dof_row[first + 2] + first + 2]))
    gravity = load_vector(field(floats, integers, At.gravity), 0)
    weight = field(floats, integers, At.mass)[body] * math.sqrt(dot(gravity, gravity))
    radius = field(floats, integers, At.shape_size)[3 * shape]
    share = min(COEFFICIENT * weight * radius, least * speed / dt) / speed
    bias[first] += share * turning[0]
    bias[first + 1] += share * turning[1]
    bias[first + 2] += share * turning[2]


@compiled
def resist_rolling(floats: Any, integers: Any, root: int, dt: float) -> None:
    """Add to ``bias`` what resists the turning of the round bodies of an island."""
    if not (rolls(floats, integers, root) and is_left_to_itself(floats, integers, root)):
        return
    body_tree = field(integers, integers, At.body_tree)
    island_next = field(integers, integers, At.island_next)
    island_contact = field(integers, integers, At.island_contact)
    contact_next = field(integers, integers, At.contact_next)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    touches_free = field(integers, integers, At.tree_block)
    tree = root
    while tree >= 0:
        touches_free[tree] = 0
        tree = island_next[tree]
    k = island_contact[root]
    while k >= 0:
        other = contact_other[k]
        if other >= 0:
            touches_free[body_tree[contact_body[k]]] = touches_free[body_tree[other]] = 1
        k = contact_next[k]
    k = island_contact[root]
    while k >= 0:
        resist(floats, integers, k, contact_shape[k], dt)
        resist(floats, integers, k, contact_against[k], dt)
        k = contact_next[k]
