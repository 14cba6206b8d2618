"""Sleep: trees at rest are left as they are, with the forces they rest on, until something happens to them.

An island falls asleep once all its trees have stayed where they are for `PATIENCE`, with nothing asked of them: none
has gone farther than it would at a speed of `QUIET` (`TURNING`), or was ever faster than `LOUD`. What lies in a heap
trembles a little where contacts come and go, and yet is at rest. It wakes as a whole when what is awake comes within
reach of a contact, or when what is asked of one of its trees, its place, its velocity or gravity is not what it was.
The contacts of sleepers are kept from the end of their room on, so that they can be told and found again.
"""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import CONTACTS, DOFS, DT, LAST_PAIRS, MIMICS, SHAPES, SLEEPING, SLOTS, TREES, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.dynamics import place
from urdfkit.sim.engine.spatial import ZERO, load_rotation, load_vector, store_rotation, store_spatial, store_vector
from urdfkit.sim.engine.world.near import bound
from urdfkit.sim.engine.world.trees import begin

QUIET = 1e-4
"""Speed [m/s, rad/s] below which, on the whole, a dof counts as at rest: MuJoCo's ``sleep_tolerance``."""
TURNING = 5e-3
"""The same for the turning of a free body, which nothing brakes where it lies on two points [rad/s].

MuJoCo, too, allows what is small to turn faster, ODE 0.01 rad/s.
"""
LOUD = 1e-2
"""Speed [m/s, rad/s] of a dof that is not at rest, however short: ODE's thresholds for bodies to be disabled."""
LOUD_TURNING = 5e-2
"""The same for the turning of a free body [rad/s]: a corner of a brick goes at a tenth of that [m/s]."""
PATIENCE = 0.5
"""How long an island is at rest before it sleeps [s]."""
ASKED = 8
"""Targets of each dof that are remembered."""


@inlined
def remember(floats: Any, integers: Any, tree: int) -> None:
    """Make what a tree's rows exerted in the last step what `last` holds, and forget it in `memory`."""
    dofs, mimics, shapes = integers[DOFS], integers[MIMICS], integers[SHAPES]
    memory = field(floats, integers, At.memory)
    last = field(floats, integers, At.last)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_mimic = field(integers, integers, At.tree_mimic)
    tree_shape = field(integers, integers, At.tree_shape)
    shape_feature = field(integers, integers, At.shape_feature)
    for d in range(tree_dof[tree], tree_dof[tree + 1]):
        last[d], last[dofs + d] = memory[d], memory[dofs + d]
        memory[d] = memory[dofs + d] = 0.0
    for k in range(2 * dofs + tree_mimic[tree], 2 * dofs + tree_mimic[tree + 1]):
        last[k], memory[k] = memory[k], 0.0
    first, beyond = tree_shape[tree], tree_shape[tree + 1]
    if first == beyond:
        return
    features = 2 * dofs + mimics
    end = 3 * shape_feature[beyond] if beyond < shapes else integers[SLOTS] - 3 * integers[CONTACTS] - features
    for k in range(features + 3 * shape_feature[first], features + end):
        last[k], memory[k] = memory[k], 0.0


@inlined
def remember_pairs(floats: Any, integers: Any) -> None:
    """Do the same for the contacts of pairs."""
    memory = field(floats, integers, At.memory)
    last = field(floats, integers, At.last)
    last_at = field(integers, integers, At.last_at)
    counts = field(integers, integers, At.counts)
    first = integers[SLOTS] - 3 * integers[CONTACTS]
    for j in range(counts[LAST_PAIRS]):
        slot = first + 3 * last_at[j]
        for k in range(slot, slot + 3):
            last[k], memory[k] = memory[k], 0.0


@inlined
def asked_of(floats: Any, integers: Any, d: int, k: int) -> float:
    """Return the k-th of the targets of a dof."""
    if k == 0:
        return float(field(floats, integers, At.motor_velocity)[d])
    if k == 1:
        return float(field(floats, integers, At.motor_effort)[d])
    if k == 2:
        return float(field(floats, integers, At.applied)[d])
    if k == 3:
        return float(field(floats, integers, At.position_target)[d])
    if k == 4:
        return float(field(floats, integers, At.velocity_target)[d])
    if k == 5:
        return float(field(floats, integers, At.kp)[d])
    if k == 6:
        return float(field(floats, integers, At.kd)[d])
    return float(field(floats, integers, At.servo_effort)[d])


@inlined
def is_quiet(floats: Any, integers: Any, tree: int) -> bool:
    """Return whether a tree may sleep, hardly moves, and nothing is asked of it that could move it.

    How far each dof has gone since the tree began to be at rest is kept in ``strayed``.
    """
    if field(integers, integers, At.sleeps)[tree] == 0:
        return False
    v = field(floats, integers, At.v)
    applied = field(floats, integers, At.applied)
    motor_velocity = field(floats, integers, At.motor_velocity)
    kp = field(floats, integers, At.kp)
    kd = field(floats, integers, At.kd)
    tree_dof = field(integers, integers, At.tree_dof)
    strayed = field(floats, integers, At.strayed)
    dt = field(floats, integers, At.numbers)[DT]
    still = field(floats, integers, At.still)[tree]
    first, tree_body = tree_dof[tree], field(integers, integers, At.tree_body)
    free = tree_body[tree + 1] - tree_body[tree] == 1 and field(integers, integers, At.tree_floats)[tree] != 0
    for d in range(first, tree_dof[tree + 1]):
        strayed[d] = (strayed[d] if still > 0.0 else 0.0) + dt * v[d]
    for d in range(first, tree_dof[tree + 1]):
        turns = free and d >= first + 3
        slow = TURNING if turns else QUIET
        if not abs(v[d]) < (LOUD_TURNING if turns else LOUD) or not abs(strayed[d]) < slow * max(PATIENCE, still):
            return False
        if applied[d] != 0.0 or motor_velocity[d] != 0.0 or kp[d] != 0.0 or kd[d] != 0.0:
            return False
    return True


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
            still[tree] = 0.0
            remember(floats, integers, tree)


@inlined
def insert_pair(floats: Any, integers: Any, k: int) -> None:
    """Put a kept contact of a pair among those of the last step, which are in order."""
    last = field(floats, integers, At.last)
    last_a = field(integers, integers, At.last_a)
    last_b = field(integers, integers, At.last_b)
    last_feature = field(integers, integers, At.last_feature)
    last_at = field(integers, integers, At.last_at)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_impulse = field(floats, integers, At.contact_impulse)
    contact_point = field(floats, integers, At.contact_point)
    last_point = field(floats, integers, At.last_point)
    counts = field(integers, integers, At.counts)
    a, b = contact_shape[k], contact_against[k]
    j = counts[LAST_PAIRS]
    while j > 0 and (last_a[j - 1] > a or (last_a[j - 1] == a and last_b[j - 1] > b)):
        last_a[j], last_b[j] = last_a[j - 1], last_b[j - 1]
        last_feature[j], last_at[j] = last_feature[j - 1], last_at[j - 1]
        store_vector(last_point, j, load_vector(last_point, j - 1))
        j -= 1
    last_a[j], last_b[j], last_feature[j], last_at[j] = a, b, contact_feature[k], k
    store_vector(last_point, j, load_vector(contact_point, k))
    counts[LAST_PAIRS] += 1
    slot = integers[SLOTS] - 3 * integers[CONTACTS] + 3 * k
    last[slot] = contact_impulse[3 * k + 2]
    last[slot + 1], last[slot + 2] = contact_impulse[3 * k], contact_impulse[3 * k + 1]


@inlined
def copy_contact(floats: Any, integers: Any, k: int, to: int) -> None:
    """Copy a contact to another number."""
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_row = field(integers, integers, At.contact_row)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
    contact_impulse = field(floats, integers, At.contact_impulse)
    contact_body[to], contact_other[to] = contact_body[k], contact_other[k]
    contact_shape[to], contact_against[to] = contact_shape[k], contact_against[k]
    contact_feature[to], contact_row[to] = contact_feature[k], contact_row[k]
    contact_gap[to], contact_mu[to] = contact_gap[k], contact_mu[k]
    store_vector(contact_point, to, load_vector(contact_point, k))
    store_rotation(contact_frame, to, load_rotation(contact_frame, k))
    store_vector(contact_impulse, to, load_vector(contact_impulse, k))


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
                begin(floats, integers, tree)
        wake(floats, integers, label)
    return any_woken


@compiled
def let_sleep(floats: Any, integers: Any, contacts: int) -> None:
    """Let the islands sleep that have been at rest for long enough."""
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
        tired = True
        tree = root
        while tree >= 0:
            still[tree] = still[tree] + dt if is_quiet(floats, integers, tree) else 0.0
            # What floats and touches nothing is on its way.
            lies = island_contact[root] >= 0 or tree_floats[tree] == 0
            tired = tired and lies and still[tree] >= PATIENCE
            tree = island_next[tree]
        if tired:
            lie_down(floats, integers, root, contacts)


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
    bound(floats, integers, tree, field(floats, integers, At.numbers)[DT])
