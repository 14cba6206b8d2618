"""Sleep: trees at rest are left as they are, with the forces they rest on, until something happens to them.

An island falls asleep once all its trees have been at rest for `PATIENCE`, see `sleep_criteria`, without targets. For
an island of free bodies it is enough that their motion has died down, see `slow_motion`. The contacts of sleepers are
stored from the end of their array on, so that they can be reported and found again.
"""

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.contacts.broadphase import update_bounds
from urdfkit.sim.engine.contacts.warm_start import copy_contact
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import CONTACTS, DIED_DOWN, DT, LAST_PAIRS, OBSERVED, SLEEPING, TREES
from urdfkit.sim.engine.sleep.sleep_criteria import PATIENCE, is_free_body, is_left_alone, is_quiet
from urdfkit.sim.engine.sleep.slow_motion import observe
from urdfkit.sim.engine.sleep.tree_rest import stop


@compiled
def let_sleep(w: KernelWorld, contacts: int) -> None:
    """Let the islands sleep that have been at rest for long enough, or whose motion has died down."""
    dt = w.numbers[DT]
    for root in range(w.sizes[TREES]):
        if w.asleep[root] != 0 or w.island[root] != root:
            continue
        at_rest = died_down = True
        tree = root
        while tree >= 0:
            update(w, tree, dt)
            # What floats and touches nothing is on its way.
            lies = w.island_contact[root] >= 0 or w.tree_floats[tree] == 0
            rests = w.still[OBSERVED * tree] >= PATIENCE
            at_rest = at_rest and lies and rests
            died_down = died_down and lies and is_free_body(w, tree)
            died_down = died_down and (rests or w.still[OBSERVED * tree + DIED_DOWN] == 1.0)
            tree = w.island_next[tree]
        if at_rest or died_down:
            lie_down(w, root, contacts)


@inlined
def update(w: KernelWorld, tree: int, dt: float) -> None:
    """Bring up to date for how long a tree has been at rest, and whether its motion has died down."""
    at = OBSERVED * tree
    if not is_left_alone(w, tree):
        for k in range(OBSERVED):
            w.still[at + k] = 0.0
        return
    w.still[at] = w.still[at] + dt if is_quiet(w, tree) else 0.0
    if is_free_body(w, tree):
        observe(w, tree, dt)


@inlined
def lie_down(w: KernelWorld, root: int, contacts: int) -> None:
    """Let an island sleep, if there is room to keep its contacts."""
    most_contacts = w.sizes[CONTACTS]
    needed, k = 0, w.island_contact[root]
    while k >= 0:
        needed += 1
        k = w.contact_next[k]
    if contacts + w.counts[SLEEPING] + needed > most_contacts:
        return
    k = w.island_contact[root]
    while k >= 0:
        copy_contact(w, k, most_contacts - 1 - w.counts[SLEEPING])
        w.counts[SLEEPING] += 1
        # Of this step's contacts it is no more.
        w.contact_row[k] = -1
        if w.contact_against[k] >= 0:
            for j in range(w.counts[LAST_PAIRS]):
                if w.last_at[j] == k:
                    w.last_feature[j] = -1
        k = w.contact_next[k]
    tree = root
    while tree >= 0:
        w.asleep[tree] = root + 1
        stop(w, tree)
        update_bounds(w, tree, w.numbers[DT])
        tree = w.island_next[tree]
