"""Sleep: trees at rest are left as they are, with the forces they rest on, until something happens to them.

An island falls asleep once all its trees have been at rest for `PATIENCE`, see `sleep_criteria`, with nothing asked of
them. For an island of free bodies it is enough that their motion has died down, see `slow_motion`. The contacts of
sleepers are kept from the end of their room on, so that they can be told and found again.
"""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import CONTACTS, DT, LAST_PAIRS, OBSERVED, SLEEPING, TREES, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.contacts.broadphase import update_bounds
from urdfkit.sim.engine.contacts.warm_start import copy_contact
from urdfkit.sim.engine.dynamics.mass_matrix import place
from urdfkit.sim.engine.math.spatial_algebra import ZERO, store_spatial, store_vector
from urdfkit.sim.engine.sleep.sleep_criteria import (
    ASKED,
    PATIENCE,
    asked_of,
    is_free_body,
    is_left_alone,
    is_quiet,
)
from urdfkit.sim.engine.sleep.slow_motion import DIED_DOWN, observe


@compiled
def let_sleep(floats: Any, integers: Any, contacts: int) -> None:
    """Let the islands sleep that have been at rest for long enough, or whose motion has died down."""
    asleep = field(integers, integers, At.asleep)
    island = field(integers, integers, At.island)
    island_next = field(integers, integers, At.island_next)
    island_contact = field(integers, integers, At.island_contact)
    tree_floats = field(integers, integers, At.tree_floats)
    still = field(floats, integers, At.still)
    dt = field(floats, integers, At.numbers)[DT]
    for root in range(integers[TREES]):
        if asleep[root] != 0 or island[root] != root:
            continue
        at_rest = died_down = True
        tree = root
        while tree >= 0:
            update(floats, integers, tree, dt)
            # What floats and touches nothing is on its way.
            lies = island_contact[root] >= 0 or tree_floats[tree] == 0
            rests = still[OBSERVED * tree] >= PATIENCE
            at_rest = at_rest and lies and rests
            died_down = died_down and lies and is_free_body(integers, tree)
            died_down = died_down and (rests or still[OBSERVED * tree + DIED_DOWN] != 0.0)
            tree = island_next[tree]
        if at_rest or died_down:
            lie_down(floats, integers, root, contacts)


@inlined
def update(floats: Any, integers: Any, tree: int, dt: float) -> None:
    """Bring up to date for how long a tree has been at rest, and whether its motion has died down."""
    still = field(floats, integers, At.still)
    at = OBSERVED * tree
    if not is_left_alone(floats, integers, tree):
        for k in range(OBSERVED):
            still[at + k] = 0.0
        return
    still[at] = still[at] + dt if is_quiet(floats, integers, tree) else 0.0
    if is_free_body(integers, tree):
        observe(floats, integers, tree, dt)


@inlined
def lie_down(floats: Any, integers: Any, root: int, contacts: int) -> None:
    """Let an island sleep, if there is room to keep its contacts."""
    most_contacts = integers[CONTACTS]
    asleep = field(integers, integers, At.asleep)
    island_next = field(integers, integers, At.island_next)
    island_contact = field(integers, integers, At.island_contact)
    contact_next = field(integers, integers, At.contact_next)
    contact_against = field(integers, integers, At.contact_against)
    contact_row = field(integers, integers, At.contact_row)
    last_at = field(integers, integers, At.last_at)
    last_feature = field(integers, integers, At.last_feature)
    counts = field(integers, integers, At.counts)
    needed, k = 0, island_contact[root]
    while k >= 0:
        needed += 1
        k = contact_next[k]
    if contacts + counts[SLEEPING] + needed > most_contacts:
        return
    k = island_contact[root]
    while k >= 0:
        copy_contact(floats, integers, k, most_contacts - 1 - counts[SLEEPING])
        counts[SLEEPING] += 1
        # Of this step's contacts it is no more.
        contact_row[k] = -1
        if contact_against[k] >= 0:
            for j in range(counts[LAST_PAIRS]):
                if last_at[j] == k:
                    last_feature[j] = -1
        k = contact_next[k]
    tree = root
    while tree >= 0:
        asleep[tree] = root + 1
        stop(floats, integers, tree)
        tree = island_next[tree]


@inlined
def stop(floats: Any, integers: Any, tree: int) -> None:
    """Take the last of a tree's velocity and note where it lies and what is asked of it."""
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    s_ahead = field(floats, integers, At.s_ahead)
    P = field(floats, integers, At.P)
    twist = field(floats, integers, At.twist)
    asked = field(floats, integers, At.asked)
    tree_body = field(integers, integers, At.tree_body)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_s = field(integers, integers, At.tree_s)
    tree_floats = field(integers, integers, At.tree_floats)
    first = tree_s[tree]
    for k in range(first, tree_s[tree + 1]):
        s_ahead[k] = s[k]
    for d in range(tree_dof[tree], tree_dof[tree + 1]):
        v[d] = 0.0
        for k in range(ASKED):
            asked[ASKED * d + k] = asked_of(floats, integers, d, k)
    if tree_floats[tree] != 0:
        store_vector(P, tree, (s[first], s[first + 1], s[first + 2]))
    place(floats, integers, tree, s, False)
    for b in range(tree_body[tree], tree_body[tree + 1]):
        store_spatial(twist, b, (ZERO, ZERO))
    update_bounds(floats, integers, tree, field(floats, integers, At.numbers)[DT])
