"""The step: from one configuration and velocity to the next, all in one compiled call."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import (
    DT,
    FOUND_CONTACTS,
    FOUND_ROWS,
    SLOTS,
    STEPS,
    TREES,
    At,
)
from urdfkit.sim.engine.compilation import field
from urdfkit.sim.engine.dynamics import place, terms
from urdfkit.sim.engine.integrate import move
from urdfkit.sim.engine.servo import account
from urdfkit.sim.engine.world.islands import join
from urdfkit.sim.engine.world.search import candidates, touching
from urdfkit.sim.engine.world.settle import settle


def advance(floats: Any, integers: Any, steps: int, only_terms: bool) -> int:
    """Advance by `steps`; return how many were done: fewer only if the state stopped being finite.

    A step moves half its way with the old velocity, finds there the new one, and moves the other half with that
    (Moreau's scheme; without contacts, the leapfrog): positions are right to second order, at the cost of one
    evaluation. Contacts are those of where the step is expected to end, so that a wheel's velocity points where the
    wheel then does.

    With `only_terms`, compute poses, M and bias of the state as it is, and advance nothing.
    """
    trees, slots = integers[TREES], integers[SLOTS]
    base = field(floats, integers, At.base)
    numbers = field(floats, integers, At.numbers)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    memory = field(floats, integers, At.memory)
    last = field(floats, integers, At.last)
    P = field(floats, integers, At.P)
    v_start = field(floats, integers, At.v_start)
    s_ahead = field(floats, integers, At.s_ahead)
    v_ahead = field(floats, integers, At.v_ahead)
    tree_body = field(integers, integers, At.tree_body)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_s = field(integers, integers, At.tree_s)
    tree_floats = field(integers, integers, At.tree_floats)
    near = field(integers, integers, At.near)
    island = field(integers, integers, At.island)
    saturated = field(integers, integers, At.saturated)
    counts = field(integers, integers, At.counts)
    dt = numbers[DT]
    for done in range(steps):
        for tree in range(trees):
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            if not only_terms:
                move(floats, integers, tree_body[tree], tree_body[tree + 1], s, v, 0.5 * dt)
            for d in range(first, beyond):
                v_start[d] = v[d]
                saturated[d] = 0
            # All of a tree is reckoned from one point, its floating base: far from the origin nothing is lost.
            for k in range(3):
                P[3 * tree + k] = s[tree_s[tree] + k] if tree_floats[tree] != 0 else base[3 * tree + k]
            place(floats, integers, tree, s, False)
            terms(floats, integers, tree)
        if only_terms:
            return 0
        pairs = candidates(floats, integers)
        if pairs < 0:
            return done
        meeting = False
        for tree in range(trees):
            if near[tree] == 0:
                continue
            meeting = True
            for k in range(tree_s[tree], tree_s[tree + 1]):
                s_ahead[k] = s[k]
            for d in range(tree_dof[tree], tree_dof[tree + 1]):
                v_ahead[d] = v[d]
            move(floats, integers, tree_body[tree], tree_body[tree + 1], s_ahead, v_ahead, 0.5 * dt)
            place(floats, integers, tree, s_ahead, True)
        for k in range(slots):
            last[k] = memory[k]
            memory[k] = 0.0
        contacts = 0
        if meeting:
            contacts = touching(floats, integers, pairs)
            if contacts < 0:
                return done
        join(floats, integers, trees, contacts)
        all_rows = 0
        for root in range(trees):
            if island[root] != root:
                continue
            rows = settle(floats, integers, root)
            if rows < 0:
                return done
            all_rows += rows
        total = 0.0
        for tree in range(trees):
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            account(floats, integers, first, beyond, dt)
            for d in range(first, beyond):
                total += v[d]
            move(floats, integers, tree_body[tree], tree_body[tree + 1], s, v, 0.5 * dt)
        counts[FOUND_CONTACTS], counts[FOUND_ROWS] = contacts, all_rows
        if not math.isfinite(total):
            return done
        counts[STEPS] += 1
    return steps
