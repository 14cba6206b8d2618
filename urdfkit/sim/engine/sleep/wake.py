"""Waking: an island that sleeps wakes as a whole.

It wakes when an awake body comes within reach of a contact, or when the targets, place or velocity of one of its trees,
or gravity, changes.
"""

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.contacts.warm_start import copy_contact, insert_pair, store_impulses
from urdfkit.sim.engine.dynamics.tree_motion import begin_step
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import CONTACTS, OBSERVED, SLEEPING, TREES
from urdfkit.sim.engine.sleep.sleep_criteria import TARGETS, target_of


@inlined
def is_disturbed(w: KernelWorld, tree: int) -> bool:
    """Return whether a sleeping tree was moved from outside or has new targets."""
    for k in range(w.tree_s[tree], w.tree_s[tree + 1]):
        if w.s[k] != w.s_ahead[k]:
            return True
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        if w.v[d] != 0.0:
            return True
        for k in range(TARGETS):
            if w.targets_at_sleep[TARGETS * d + k] != target_of(w, d, k):
                return True
    return False


@compiled
def wake_disturbed(w: KernelWorld) -> None:
    """Wake the islands disturbed since the last call, or all of them if gravity has changed."""
    turned = False
    for k in range(3):
        turned = turned or w.gravity[k] != w.gravity_last_step[k]
        w.gravity_last_step[k] = w.gravity[k]
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
