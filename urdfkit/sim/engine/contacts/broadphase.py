"""Broad phase: pairs of shapes that may touch within a step, by axis-aligned boxes and sweep-and-prune along x.

Shapes of a tree are paired with those of other trees, static shapes and, with self-collision, shapes of the same tree,
but not with those of the same body or of adjacent bodies. Pairs are in the order of their numbers, and so are contacts.
"""

from typing import Any

from urdfkit.sim.engine.collision.support_points import CAPSULE, CYLINDER, SPHERE, WHEEL
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.contacts.ground_contacts import REACH
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import (
    add,
    compose,
    cross,
    load_rotation,
    load_spatial,
    load_vector,
    rotate,
    store_vector,
)

NOWHERE = 1e300
"""Where the box of a tree without shapes begins [m]."""


@inlined
def reach_of(w: KernelWorld, k: int, axes: Any) -> Any:
    """Return how far a shape reaches along the axes of the world from the middle of its box, turned as `axes`."""
    kind = w.shape_kind[k]
    x, y, z = load_vector(w.shape_half, k)
    if kind == SPHERE:
        return (x, x, x)
    if kind == CAPSULE:
        z -= x
        return (x + z * abs(axes[2]), x + z * abs(axes[5]), x + z * abs(axes[8]))
    if kind in (CYLINDER, WHEEL):
        return (
            x * max(0.0, 1.0 - axes[2] * axes[2]) ** 0.5 + z * abs(axes[2]),
            x * max(0.0, 1.0 - axes[5] * axes[5]) ** 0.5 + z * abs(axes[5]),
            x * max(0.0, 1.0 - axes[8] * axes[8]) ** 0.5 + z * abs(axes[8]),
        )
    return (
        x * abs(axes[0]) + y * abs(axes[1]) + z * abs(axes[2]),
        x * abs(axes[3]) + y * abs(axes[4]) + z * abs(axes[5]),
        x * abs(axes[6]) + y * abs(axes[7]) + z * abs(axes[8]),
    )


@compiled
def update_bounds(w: KernelWorld, tree: int, dt: float) -> None:
    """Compute the boxes that contain the shapes of a tree during a step, and the box around all of them."""
    low, high = (NOWHERE, NOWHERE, NOWHERE), (-NOWHERE, -NOWHERE, -NOWHERE)
    for k in range(w.tree_shape[tree], w.tree_shape[tree + 1]):
        body = w.shape_body[k]
        body_R = load_rotation(w.R, body)
        axes = compose(body_R, load_rotation(w.shape_R, k))
        centre = add(load_vector(w.r, body), rotate(body_R, load_vector(w.shape_p, k)))
        velocity = load_spatial(w.twist, body)
        speed = add(velocity[0], cross(velocity[1], centre))
        turn = abs(velocity[1][0]) + abs(velocity[1][1]) + abs(velocity[1][2])
        more = w.shape_radius[k] * 2.0 * dt * turn + dt * dt * REACH
        reach = reach_of(w, k, axes)
        reach = (
            reach[0] + more + 2.0 * dt * abs(speed[0]),
            reach[1] + more + 2.0 * dt * abs(speed[1]),
            reach[2] + more + 2.0 * dt * abs(speed[2]),
        )
        at = add(add(centre, rotate(axes, load_vector(w.shape_middle, k))), load_vector(w.P, tree))
        store_vector(w.shape_at, k, at)
        store_vector(w.shape_reach, k, reach)
        low = (min(low[0], at[0] - reach[0]), min(low[1], at[1] - reach[1]), min(low[2], at[2] - reach[2]))
        high = (max(high[0], at[0] + reach[0]), max(high[1], at[1] + reach[1]), max(high[2], at[2] + reach[2]))
    store_vector(w.tree_low, tree, low)
    store_vector(w.tree_high, tree, high)


@inlined
def overlap(w: KernelWorld, a: int, b: int) -> bool:
    """Return whether the boxes of two shapes overlap."""
    for k in range(3):
        if abs(w.shape_at[3 * a + k] - w.shape_at[3 * b + k]) > w.shape_reach[3 * a + k] + w.shape_reach[3 * b + k]:
            return False
    return True


@inlined
def trees_that_meet(w: KernelWorld, trees: int, room: int) -> int:
    """List for each tree the later ones whose box meets its own; return how many in all, -1 if there is no room.

    The boxes are swept along x. The order in which they begin is kept from step to step, so that sorting it again costs
    little.
    """
    order, first, low, high = w.tree_order, w.tree_meet, w.tree_low, w.tree_high
    for k in range(1, trees):
        tree = order[k]
        start = low[3 * tree]
        j = k - 1
        while j >= 0 and low[3 * order[j]] > start:
            order[j + 1] = order[j]
            j -= 1
        order[j + 1] = tree
    for k in range(trees + 1):
        first[k] = 0
    count = 0
    for k in range(trees):
        i = order[k]
        end = high[3 * i]
        for n in range(k + 1, trees):
            j = order[n]
            if low[3 * j] > end:
                break
            if w.asleep[i] != 0 and w.asleep[j] != 0:
                continue
            if (
                low[3 * i + 1] > high[3 * j + 1]
                or high[3 * i + 1] < low[3 * j + 1]
                or low[3 * i + 2] > high[3 * j + 2]
                or high[3 * i + 2] < low[3 * j + 2]
            ):
                continue
            if count >= room:
                return -1
            w.meet_a[count], w.meet_b[count] = min(i, j), max(i, j)
            first[min(i, j) + 1] += 1
            count += 1
    for k in range(trees):
        first[k + 1] += first[k]
    # In order by counting; within one tree by moving the few there are.
    for k in range(count):
        i, j = w.meet_a[k], w.meet_b[k]
        at = first[i]
        first[i] += 1
        w.meet_tree[at] = j
    for k in range(trees, 0, -1):
        first[k] = first[k - 1]
    first[0] = 0
    for i in range(trees):
        for k in range(first[i] + 1, first[i + 1]):
            tree = w.meet_tree[k]
            j = k - 1
            while j >= first[i] and w.meet_tree[j] > tree:
                w.meet_tree[j + 1] = w.meet_tree[j]
                j -= 1
            w.meet_tree[j + 1] = tree
    return count


@inlined
def static_shapes_near(w: KernelWorld, tree: int, first: int, shapes: int) -> int:
    """List the static shapes that overlap the box of a tree; return their number."""
    count = 0
    for b in range(first, shapes):
        for k in range(3):
            at, far = w.shape_at[3 * b + k], w.shape_reach[3 * b + k]
            if w.tree_low[3 * tree + k] > at + far or w.tree_high[3 * tree + k] < at - far:
                break
        else:
            w.still_near[count] = b
            count += 1
    return count


@compiled
def find_pairs(w: KernelWorld, trees: int, shapes: int, room: int) -> int:
    """List the pairs of shapes whose boxes overlap and mark their trees; return how many, -1 if there is no room."""
    meets = w.shape_meets
    if trees_that_meet(w, trees, room) < 0:
        return -1
    count = 0
    for i in range(trees):
        first, beyond = w.tree_shape[i], w.tree_shape[i + 1]
        alone = w.tree_meets[i] == 0
        around = static_shapes_near(w, i, w.tree_shape[trees], shapes) if w.asleep[i] == 0 else 0
        if (alone or w.asleep[i] != 0) and around == 0 and w.tree_meet[i] == w.tree_meet[i + 1]:
            continue
        for a in range(first, beyond):
            owner, one = w.shape_owner[a], w.shape_body[a]
            if not alone and w.asleep[i] == 0:
                for b in range(a + 1, beyond):
                    other = w.shape_body[b]
                    if one == other or w.parent[one] == other or w.parent[other] == one:
                        continue
                    if meets[a] == 0 and meets[b] == 0:
                        continue
                    if overlap(w, a, b):
                        if count >= room:
                            return -1
                        w.pair_a[count], w.pair_b[count] = a, b
                        w.near[i] = 1
                        count += 1
            for k in range(w.tree_meet[i], w.tree_meet[i + 1]):
                j = w.meet_tree[k]
                for b in range(w.tree_shape[j], w.tree_shape[j + 1]):
                    if owner == w.shape_owner[b] and meets[a] == 0 and meets[b] == 0:
                        continue
                    if overlap(w, a, b):
                        if count >= room:
                            return -1
                        w.pair_a[count], w.pair_b[count] = a, b
                        w.near[i] = w.near[j] = 1
                        count += 1
            for k in range(around):
                b = w.still_near[k]
                # A body that is fixed to the world does not collide with the bodies on its joints.
                if owner == w.shape_owner[b] and ((meets[a] == 0 and meets[b] == 0) or w.parent[one] < 0):
                    continue
                if overlap(w, a, b):
                    if count >= room:
                        return -1
                    w.pair_a[count], w.pair_b[count] = a, b
                    w.near[i] = 1
                    count += 1
    return count
