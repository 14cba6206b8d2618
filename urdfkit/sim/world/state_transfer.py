"""Transfer of the state from one engine to the next when the entities of a world change.

Transferred are the positions and velocities of trees (robots and free bodies), their targets, and the impulses for the
warm start of the contact solver: those of joints and ground contacts, and those of pairs of shapes that both remain.
Sleeping trees wake with the impulses of their contacts, and may sleep again soon.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from urdfkit.linear_algebra import Array
from urdfkit.sim.engine import Engine
from urdfkit.sim.engine.articulation import PER_DOF
from urdfkit.sim.engine.simulation_memory import ITERATED, LAST_PAIRS, SLEEPING, STEPS, Arrays

_PER_DOF = (*PER_DOF, "strayed")


@dataclass(frozen=True)
class EngineLayout:
    """Names of the trees and shapes of an engine, in its order.

    Attributes:
        trees: names of robots, then of free bodies.
        owners: names of the owners of shapes: robots, then all bodies.
    """

    trees: Sequence[str]
    owners: Sequence[str]


def transfer_state(before: Engine, old: EngineLayout, after: Engine, new: EngineLayout) -> None:
    """Copy the state of one engine to another, for trees and shapes of both. Others keep their initial poses.

    Args:
        before: the previous engine.
        old: layout of the previous engine.
        after: the new engine.
        new: layout of the new engine; common entries are in the same order in both.
    """
    a, b = before.arrays, after.arrays
    trees = [(old.trees.index(name), k) for k, name in enumerate(new.trees) if name in old.trees]
    for i, j in trees:
        for name in _PER_DOF:
            b[name][_span(b, "tree_dof", j)] = a[name][_span(a, "tree_dof", i)]
        b["s"][_span(b, "tree_s", j)] = a["s"][_span(a, "tree_s", i)]
        for name in ("displaced", "odometry", "encoder", "odometer"):
            b[name][j] = a[name][i]
        b["still"][j] = 0.0 if a["asleep"][i] else a["still"][i]
    shapes = _shapes(before, old, after, new)
    _transfer_impulses(a, b, trees, shapes)
    _transfer_pair_impulses(a, b, shapes)
    for count in (STEPS, ITERATED):
        b["counts"][count] = a["counts"][count]
    after.evaluate()


def _span(arrays: Arrays, starts: str, k: int) -> slice:
    return slice(int(arrays[starts][k]), int(arrays[starts][k + 1]))


def _shapes(before: Engine, old: EngineLayout, after: Engine, new: EngineLayout) -> dict[int, int]:
    """Return the index of each remaining shape in the new engine, by its index in the previous one."""
    previous, present = _by_owner(before, old), _by_owner(after, new)
    return {k: j for key, was in previous.items() for k, j in zip(was, present.get(key, ()), strict=False)}


def _by_owner(engine: Engine, part: EngineLayout) -> dict[tuple[str, bool], list[int]]:
    """Return the indices of shapes in order, by owner and whether they are static."""
    found: dict[tuple[str, bool], list[int]] = {}
    for k, touch in enumerate(engine.collision_shapes):
        found.setdefault((part.owners[touch.owner], touch.body < 0), []).append(k)
    return found


def _transfer_impulses(a: Arrays, b: Arrays, trees: Sequence[tuple[int, int]], shapes: dict[int, int]) -> None:
    """Transfer the impulses of motors, limits, mimic joints and ground contacts."""
    n, m = int(a["tree_dof"][-1]), int(b["tree_dof"][-1])
    for i, j in trees:
        was, now = _span(a, "tree_dof", i), _span(b, "tree_dof", j)
        b["memory"][now] = a["memory"][was]
        b["memory"][m + now.start : m + now.stop] = a["memory"][n + was.start : n + was.stop]
        was, now = _span(a, "tree_mimic", i), _span(b, "tree_mimic", j)
        b["memory"][2 * m + now.start : 2 * m + now.stop] = a["memory"][2 * n + was.start : 2 * n + was.stop]
    first, then = 2 * n + int(a["tree_mimic"][-1]), 2 * m + int(b["tree_mimic"][-1])
    ends = _feature_ends(a, first), _feature_ends(b, then)
    for k, j in shapes.items():
        slots = min(ends[0][k] - int(a["shape_feature"][k]), ends[1][j] - int(b["shape_feature"][j]))
        source, goal = first + 3 * int(a["shape_feature"][k]), then + 3 * int(b["shape_feature"][j])
        b["memory"][goal : goal + 3 * slots] = a["memory"][source : source + 3 * slots]


def _feature_ends(arrays: Arrays, first: int) -> list[int]:
    """Return the end index of each shape's features, which begin at an index of the memory."""
    last = (len(arrays["memory"]) - first) // 3 - len(arrays["contact_gap"])
    return [*arrays["shape_feature"][1:].tolist(), last]


def _transfer_pair_impulses(a: Arrays, b: Arrays, shapes: dict[int, int]) -> None:
    """Transfer the impulses of contacts between pairs, including those of sleeping trees, in the order of the pairs."""
    room = len(b["contact_gap"])
    pairs = [
        (shapes[one], shapes[other], feature, impulse, point)
        for one, other, feature, impulse, point in (*_last_pairs(a), *_sleeping_pairs(a))
        if one in shapes and other in shapes and feature >= 0
    ]
    pairs = sorted(pairs, key=lambda each: each[:2])[:room]  # stable: features keep their order
    first = len(b["memory"]) - 3 * room
    for k, (one, other, feature, impulse, point) in enumerate(pairs):
        b["last_a"][k], b["last_b"][k], b["last_feature"][k], b["last_at"][k] = one, other, feature, k
        b["memory"][first + 3 * k : first + 3 * k + 3] = impulse
        b["last_point"][k] = point
    b["counts"][LAST_PAIRS] = len(pairs)


Pair = tuple[int, int, int, Array, Array]
"""Two shapes, the feature of the contact, the impulse with the normal component first, and the contact point."""


def _last_pairs(arrays: Arrays) -> Iterator[Pair]:
    first = len(arrays["memory"]) - 3 * len(arrays["contact_gap"])
    for k in range(int(arrays["counts"][LAST_PAIRS])):
        at = first + 3 * int(arrays["last_at"][k])
        one, other, feature = (int(arrays[name][k]) for name in ("last_a", "last_b", "last_feature"))
        yield one, other, feature, arrays["memory"][at : at + 3], arrays["last_point"][k]


def _sleeping_pairs(arrays: Arrays) -> Iterator[Pair]:
    """Yield the stored contacts of sleeping trees, from the end of the array."""
    room = len(arrays["contact_gap"])
    for k in range(room - 1, room - 1 - int(arrays["counts"][SLEEPING]), -1):
        one, other, feature = (int(arrays[name][k]) for name in ("contact_shape", "contact_against", "contact_feature"))
        if other >= 0:
            yield one, other, feature, arrays["contact_impulse"][k][[2, 0, 1]], arrays["contact_point"][k]
