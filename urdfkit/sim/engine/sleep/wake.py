"""Waking: an island that sleeps wakes as a whole.

It does when what is awake comes within reach of a contact, or when what is asked of one of its trees, its place, its
velocity or gravity is not what it was.
"""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import CONTACTS, OBSERVED, SLEEPING, TREES, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.contacts.warm_start import copy_contact, insert_pair, store_impulses
from urdfkit.sim.engine.dynamics.tree_motion import begin_step
from urdfkit.sim.engine.sleep.sleep_criteria import ASKED, asked_of


@inlined
def is_disturbed(floats: Any, integers: Any, tree: int) -> bool:
    """Return whether somebody moved a sleeping tree or asks something new of it."""
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    s_ahead = field(floats, integers, At.s_ahead)
    asked = field(floats, integers, At.asked)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_s = field(integers, integers, At.tree_s)
    for k in range(tree_s[tree], tree_s[tree + 1]):
        if s[k] != s_ahead[k]:
            return True
    for d in range(tree_dof[tree], tree_dof[tree + 1]):
        if v[d] != 0.0:
            return True
        for k in range(ASKED):
            if asked[ASKED * d + k] != asked_of(floats, integers, d, k):
                return True
    return False


@compiled
def rouse_disturbed(floats: Any, integers: Any) -> None:
    """Wake what has been disturbed since the last call; all, where gravity has changed."""
    asleep = field(integers, integers, At.asleep)
    gravity = field(floats, integers, At.gravity)
    asked_gravity = field(floats, integers, At.asked_gravity)
    turned = False
    for k in range(3):
        turned = turned or gravity[k] != asked_gravity[k]
        asked_gravity[k] = gravity[k]
    for tree in range(integers[TREES]):
        if asleep[tree] != 0 and (turned or is_disturbed(floats, integers, tree)):
            wake(floats, integers, asleep[tree])


@compiled
def wake(floats: Any, integers: Any, label: int) -> None:
    """Wake the trees of an island that sleeps; what their contacts exerted is remembered as of the last step."""
    most_contacts = integers[CONTACTS]
    asleep = field(integers, integers, At.asleep)
    still = field(floats, integers, At.still)
    body_tree = field(integers, integers, At.body_tree)
    contact_body = field(integers, integers, At.contact_body)
    contact_against = field(integers, integers, At.contact_against)
    counts = field(integers, integers, At.counts)
    kept = 0
    for j in range(counts[SLEEPING]):
        k = most_contacts - 1 - j
        if asleep[body_tree[contact_body[k]]] != label:
            kept += 1
            copy_contact(floats, integers, k, most_contacts - kept)
        elif contact_against[k] >= 0:
            insert_pair(floats, integers, k)
    counts[SLEEPING] = kept
    for tree in range(integers[TREES]):
        if asleep[tree] == label:
            asleep[tree] = 0
            for k in range(OBSERVED):
                still[OBSERVED * tree + k] = 0.0
            store_impulses(floats, integers, tree)


@compiled
def rouse_touched(floats: Any, integers: Any, contacts: int) -> bool:
    """Wake the sleepers that what is awake can touch within the step; return whether there were any."""
    asleep = field(integers, integers, At.asleep)
    body_tree = field(integers, integers, At.body_tree)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    any_woken = False
    for k in range(contacts):
        if contact_other[k] < 0:
            continue
        label = max(asleep[body_tree[contact_body[k]]], asleep[body_tree[contact_other[k]]])
        if label == 0:
            continue
        any_woken = True
        for tree in range(integers[TREES]):
            if asleep[tree] == label:
                begin_step(floats, integers, tree)
        wake(floats, integers, label)
    return any_woken
