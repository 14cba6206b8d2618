"""The step: from one configuration and velocity to the next, all in one compiled call."""

import math
from typing import Any

from urdfkit.sim.engine.constraints.joint_servos import account
from urdfkit.sim.engine.constraints.position_goals import approach_goals
from urdfkit.sim.engine.contacts.contact_search import find_candidate_pairs, find_contacts
from urdfkit.sim.engine.contacts.warm_start import store_impulses, store_pair_impulses
from urdfkit.sim.engine.dynamics.link_poses import place_links
from urdfkit.sim.engine.dynamics.odometry import update_odometry, update_odometry_at_rest
from urdfkit.sim.engine.dynamics.tree_motion import begin_step, evaluate, integrate_tree, predict_poses
from urdfkit.sim.engine.kernel_world import world
from urdfkit.sim.engine.simulation_memory import (
    DT,
    FOUND_CONTACTS,
    FOUND_PAIRS,
    FOUND_ROWS,
    LINK_POSES,
    NEXT_UPDATE,
    ODOMETER,
    STEPS,
    TERMS,
    TREES,
)
from urdfkit.sim.engine.sleep.sleep import let_sleep
from urdfkit.sim.engine.sleep.wake import wake_disturbed, wake_touched
from urdfkit.sim.engine.stepping.islands import build_islands
from urdfkit.sim.engine.stepping.solve_island import solve_island


def advance(floats: Any, integers: Any, steps: int, action: int) -> int:
    """Advance by `steps`; return how many were done: fewer only if the state stopped being finite.

    A step integrates the first half with the old velocity, computes the new velocity there, and integrates the second
    half with it (Moreau's midpoint scheme; leapfrog without contacts): positions are accurate to second order with one
    evaluation. Contacts are those at the expected end of the step, so that the velocity of a wheel has the direction
    that the wheel has then.

    Args:
        floats: block of floats.
        integers: block of integers.
        steps: number of steps; for `LINK_POSES`, the number of the tree.
        action: `ADVANCE`; `TERMS`: compute poses, M and bias of the present state; or `LINK_POSES`, see `place_links`.
    """
    w = world(floats, integers)
    if action == LINK_POSES:
        place_links(w, steps)
        return 0
    trees = w.sizes[TREES]
    dt = w.numbers[DT]
    counts = w.counts
    if action == TERMS:
        for tree in range(trees):
            begin_step(w, tree)
        return 0
    for done in range(steps):
        for tree in range(trees):
            if w.asleep[tree] == 0:
                store_impulses(w, tree)
        store_pair_impulses(w)
        if done == 0:
            wake_disturbed(w)
        awake = 0
        for tree in range(trees):
            if w.asleep[tree] == 0:
                awake += 1
                integrate_tree(w, tree, 0.5 * dt)
                begin_step(w, tree)
                approach_goals(w, w.tree_dof[tree], w.tree_dof[tree + 1], dt)
        if awake == 0:
            # Nothing will happen before the next call.
            counts[FOUND_CONTACTS] = counts[FOUND_ROWS] = counts[FOUND_PAIRS] = 0
            counts[STEPS] += steps - done
            for tree in range(trees):
                update_odometry_at_rest(w, tree, counts[STEPS])
            return steps
        while True:
            pairs = find_candidate_pairs(w)
            if pairs < 0:
                return done
            meeting = False
            for tree in range(trees):
                if w.near[tree] != 0 and w.asleep[tree] == 0:
                    meeting = True
                    predict_poses(w, tree, 0.5 * dt)
            contacts = 0
            if meeting:
                contacts = find_contacts(w, pairs)
                if contacts < 0:
                    return done
            if not wake_touched(w, contacts):
                break
            for tree in range(trees):
                if w.near[tree] != 0 and w.asleep[tree] == 0:
                    evaluate(w, tree)
        build_islands(w, trees, contacts)
        all_rows = 0
        for root in range(trees):
            if w.island[root] != root or w.asleep[root] != 0:
                continue
            rows = solve_island(w, root)
            if rows < 0:
                return done
            all_rows += rows
        total = 0.0
        for tree in range(trees):
            if w.asleep[tree] != 0:
                update_odometry_at_rest(w, tree, counts[STEPS] + 1)
                continue
            first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
            account(w, first, beyond, dt)
            for d in range(first, beyond):
                total += w.v[d]
            integrate_tree(w, tree, 0.5 * dt)
            at = ODOMETER * tree
            if w.odometer[at] != 0 and counts[STEPS] + 1 >= w.odometer[at + NEXT_UPDATE]:
                update_odometry(w, tree, counts[STEPS] + 1)
        counts[FOUND_CONTACTS], counts[FOUND_ROWS], counts[FOUND_PAIRS] = contacts, all_rows, pairs
        if not math.isfinite(total):
            return done
        let_sleep(w, contacts)
        counts[STEPS] += 1
    return steps
