"""Poses of the links of a robot in the world, at any coordinates.

They are read between steps, so they have arrays of their own: those of the last step are at the middle of the step.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import PLANAR, PRISMATIC, REVOLUTE
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.math.spatial_algebra import (
    IDENTITY,
    ZERO,
    add,
    compose,
    load_rotation,
    load_spatial,
    load_vector,
    rotate,
    scale,
    store_rotation,
    store_vector,
    turn_about,
    turn_of,
)


@compiled
def place_links(w: KernelWorld, tree: int) -> None:
    """Compute ``link_pose`` of a robot's links, x y z and quaternion x y z w, at the coordinates ``read_s``."""
    s = w.read_s
    for i in range(w.tree_body[tree], w.tree_body[tree + 1]):
        above = w.parent[i]
        R, p = IDENTITY, ZERO
        if above >= 0:
            R, p = load_rotation(w.read_R, above), load_vector(w.read_p, above)
        p = add(p, rotate(R, load_vector(w.place_p, i)))
        R = compose(R, load_rotation(w.place_R, i))
        at = w.first_s[i]
        lin, ang = load_spatial(w.subspace, w.first_v[i])
        if w.kind[i] == REVOLUTE:
            R = compose(R, turn_about(ang, *sine_cosine(s[at])))
        elif w.kind[i] == PRISMATIC:
            p = add(p, rotate(R, scale(s[at], lin)))
        elif w.kind[i] == PLANAR:
            p = add(p, rotate(R, (s[at], s[at + 1], 0.0)))
            R = compose(R, turn_about((0.0, 0.0, 1.0), *sine_cosine(s[at + 2])))
        else:
            p = add(p, rotate(R, (s[at], s[at + 1], s[at + 2])))
            R = compose(R, turn_of(s[at + 3], s[at + 4], s[at + 5], s[at + 6]))
        store_rotation(w.read_R, i, R)
        store_vector(w.read_p, i, p)
    for k in range(w.tree_link[tree], w.tree_link[tree + 1]):
        body = w.link_body[k]
        R, p = load_rotation(w.link_R, k), load_vector(w.link_p, k)
        if body >= 0:
            above = load_rotation(w.read_R, body)
            R, p = compose(above, R), add(load_vector(w.read_p, body), rotate(above, p))
        x, y, z, scalar = quaternion_of(R)
        w.link_pose[7 * k], w.link_pose[7 * k + 1], w.link_pose[7 * k + 2] = p
        w.link_pose[7 * k + 3], w.link_pose[7 * k + 4], w.link_pose[7 * k + 5] = x, y, z
        w.link_pose[7 * k + 6] = scalar


@inlined
def quaternion_of(R: Any) -> Any:
    """Return the quaternion x y z w of a rotation, of which the largest of x y z and w, or w itself, is positive."""
    total = R[0] + R[4] + R[8]
    if total > 0.0:
        root = math.sqrt(total + 1.0)
        half = 0.5 / root
        return ((R[7] - R[5]) * half, (R[2] - R[6]) * half, (R[3] - R[1]) * half, 0.5 * root)
    if R[0] >= R[4] and R[0] >= R[8]:
        root = math.sqrt(R[0] - R[4] - R[8] + 1.0)
        half = 0.5 / root
        return (0.5 * root, (R[3] + R[1]) * half, (R[6] + R[2]) * half, (R[7] - R[5]) * half)
    if R[4] >= R[8]:
        root = math.sqrt(R[4] - R[8] - R[0] + 1.0)
        half = 0.5 / root
        return ((R[3] + R[1]) * half, 0.5 * root, (R[7] + R[5]) * half, (R[2] - R[6]) * half)
    root = math.sqrt(R[8] - R[0] - R[4] + 1.0)
    half = 0.5 / root
    return ((R[6] + R[2]) * half, (R[7] + R[5]) * half, 0.5 * root, (R[3] - R[1]) * half)
