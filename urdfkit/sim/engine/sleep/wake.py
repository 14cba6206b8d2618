"""Waking: an island that sleeps wakes as a whole.

It wakes when an awake body comes within reach of a contact, or when the targets, place or velocity of one of its trees,
or gravity, changes.
"""

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.contacts.warm_start import copy_contact, insert_pair, store_impulses
from urdfkit.sim.engine.dynamics.tree_motion import begin_step
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import CONTACTS, OBSERVED, SLEEPING, TREES
from urdfkit.sim.engine.sleep.tree_rest import gravity_changed, is_disturbed


@compiled
def wake_disturbed(w: KernelWorld) -> None:
    """Wake the islands disturbed since the last call, or all of them if gravity has changed."""
    turned = gravity_changed(w)
    for tree in range(w.sizes[TREES]):
        if w.asleep[tree] != 0 and (turned or is_disturbed(w, tree)):
            wake(w, w.asleep[tree])


@compiled
def wake(w: KernelWorld, label: int) -> None:
    """Wake the trees of an island that sleeps; what their contacts exerted is remembered as of the last step."""
    most_contacts = w.sizes[CONTACTS]
    kept = 0
    for j in range(w.counts[SLEEPING]):
        k = most_contacts - 1 - j
        if w.asleep[w.body_tree[w.contact_body[k]]] != label:
            kept += 1
            copy_contact(w, k, most_contacts - kept)
        elif w.contact_against[k] >= 0:
            insert_pair(w, k)
    w.counts[SLEEPING] = kept
    for tree in range(w.sizes[TREES]):
        if w.asleep[tree] == label:
            w.asleep[tree] = 0
            for k in range(OBSERVED):
                w.still[OBSERVED * tree + k] = 0.0
            store_impulses(w, tree)


@compiled
def wake_touched(w: KernelWorld, contacts: int) -> bool:
    """Wake the sleepers that an awake body can touch within the step; return whether there were any."""
    any_woken = False
    for k in range(contacts):
        if w.contact_other[k] < 0:
            continue
        label = max(w.asleep[w.body_tree[w.contact_body[k]]], w.asleep[w.body_tree[w.contact_other[k]]])
        if label == 0:
            continue
        any_woken = True
        for tree in range(w.sizes[TREES]):
            if w.asleep[tree] == label:
                begin_step(w, tree)
        wake(w, label)
    return any_woken
