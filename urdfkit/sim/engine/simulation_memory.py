"""Everything a world needs to be simulated, in one block of floats and one of integers.

The kernel takes the two blocks, so that a call costs the same for every world; Python sees the same memory through
named views. A copy of the blocks is a copy of the whole simulation.
"""

from __future__ import annotations

import mmap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.sim.engine.collision import collide_pair as memory
from urdfkit.sim.engine.math.simd import LANES

Size = tuple[str, ...]

OBSERVED = 7
"""Numbers that are kept of each tree to decide whether it sleeps."""
AT_REST, WINDOW, FASTEST, SLOWEST, FASTEST_BEFORE, DIED_DOWN, RESISTED = range(OBSERVED)
"""Places in ``still`` of a tree: the time at rest, and for `slow_motion` the time in this window, the greatest and the
least speed in it, the greatest in the window before, and the results: motion has died down, rolling is resisted."""

ENCODERS, ENCODER = 8, 5
"""Most joints that the odometry of a tree measures, and how many numbers are kept of each."""
LAST_POSITION, FORWARD_SHARE, LEFT_SHARE, TURN_SHARE, ANGLE_SHARE = range(ENCODER)
"""Places in ``encoder`` of a joint: its position at the last update, and the effect of a change of it."""
ODOMETRY = 9
X, Y, HEADING, FORWARD, LEFT, TURNED, DISTANCE, PERIOD, AXLES = range(ODOMETRY)
"""Places in ``odometry`` of a tree: the pose, the last displacement in the axes of the robot and its length, the number
of steps between updates, and the distance between the axles of a bicycle, otherwise zero."""
FOLLOWS_ARC, LAST_UPDATE, BEFORE, NEXT_UPDATE, FIRST_COORDINATE = range(1, 6)
"""Places in ``odometer`` of a tree after the number of its encoders, zero for none: whether displacements follow an
arc, the steps of the last updates and of the next, and the coordinates of its encoders, relative to its first one."""
ODOMETER = FIRST_COORDINATE + ENCODERS
BLOCK_WORDS = 4
"""Words of 32 bits in which ``block_after`` has the trees that one shares a block with."""
NEIGHBOURS = 16 * BLOCK_WORDS
"""Room in ``block_near`` for each tree: all pairs of the trees of an island fit."""
ATTEMPT = 3
LAST_ATTEMPT, TURNS, SKIPPED = range(ATTEMPT)
"""Places in ``attempt`` of a tree, see `augmented_newton`: which attempt solved the last step, how often in turn it was
found by failures of the ones before, and in how many of the next steps those are skipped."""


def _sizes(*rows: str) -> dict[str, Size]:
    """Return name → shape of fields written as ``name:shape``."""
    return {
        name: tuple(shape.split(",")) for row in rows for name, shape in (field.split(":") for field in row.split())
    }


# name:shape; the letters are counts: b bodies, d dofs, s coordinates, k shapes, p vertices, m mimic joints,
# c contacts, r rows, a slots of remembered impulses, t trees, e entries of all their mass matrices, y entries of rows,
# q entries of a matrix of rows, f pairs of shapes, n numbers and i indices of hulls and meshes in pairs, l links,
# h entries of branches.
FLOATS = _sizes(
    # the trees: robots and free bodies
    "place_R:b,9 place_p:b,3 mass:b centre:b,3 tensor:b,6 weightless:b weightless_centre:b,3 subspace:d,6",
    "damping:d friction:d lower:d upper:d mimic_factor:m mimic_offset:m shape_R:k,9 shape_p:k,3 shape_size:k,3",
    "shape_radius:k shape_mu:k floor_mu:k vertices:p,3 extreme:9 base:t,3 gravity:3 numbers:4",
    # targets
    "motor_velocity:d motor_effort:d applied:d position_target:d velocity_target:d kp:d kd:d servo_effort:d",
    "approach_rate:d fastest:d acceleration:d deceleration:d",
    # state
    "s:s v:d memory:a last:a",
    # results of a step
    "effort:d tau:d R:b,9 r:b,3 P:t,3 S:d,6 twist:b,6 bias_acceleration:b,6 composite_mass:b composite_h:b,3",
    "composite_T:b,6 force:b,6 M:e bias:d L:e inverse_diagonal:d factored:b,10 u:d v_start:d s_ahead:s v_ahead:d",
    "slope_s:d slope_v:d sum_s:d sum_v:d block_v:d block_f:d contact_origin:t,3 contact_point:c,3 contact_frame:c,9",
    "contact_gap:c contact_mu:c contact_impulse:c,3 pair_before:c,3 last_point:c,3 shape_middle:k,3",
    f"shape_half:k,3 shape_at:k,3 shape_reach:k,3 tree_low:t,3 tree_high:t,3 still:t,{OBSERVED} strayed:d",
    f"displaced:t,6 targets_at_sleep:d,10 gravity_last_step:3 pair_numbers:n pair_work:{memory.WORK} found_point:24",
    "found_normal:24 found_gap:8 Y:y columns:y row_bias:r g:r low:r high:r mu:r before:r slip:r x:r y:r A:q B:q",
    "row_stiffness:r near_x:r ahead:r velocity:r shape_mu2:k floor_mu2:k shape_along:k,3 ki:d i_min:d i_max:d",
    "antiwindup:d feedforward:d integral:d i_part:d rigid_kd:d turn:b,2",
    f"odometry:t,{ODOMETRY} encoder:t,{ENCODERS},{ENCODER}",
    "K_rows:h K_columns:h push:b,36 reach:b,6 load:b,6 pair:6 u_free:d link_R:l,9 link_p:l,3",
    # poses of links, at any coordinates
    "read_s:s read_R:b,9 read_p:b,3 link_pose:l,7",
)

INTEGERS = _sizes(
    "tree_body:t+1 tree_dof:t+1 tree_s:t+1 tree_shape:t+1 tree_mimic:t+1 tree_floats:t tree_meets:t near:t",
    "sleeps:t asleep:t tree_order:t tree_meet:t+1 meet_a:f meet_b:f meet_tree:f still_near:k island:t",
    "island_next:t island_contact:t block_tree:t tree_block:t block_first:t+1 pair_a:f pair_b:f",
    f"last_a:c last_b:c last_feature:c last_at:c pair_indices:i pair_work_indices:{memory.WORK_INDICES}",
    "found_feature:8 body_tree:b kind:b parent:b first_s:b first_v:b+1 body_last_dof:b dof_parent:d dof_s:d",
    "dof_row:d dof_branch:d dof_depth:d branch:h mimic_dof:m mimic_master:m shape_kind:k shape_body:k",
    "shape_feature:k shape_vertex:k+1",
    "shape_owner:k shape_meets:k shape_data:k contact_body:c contact_other:c contact_shape:c contact_against:c",
    "contact_next:c contact_feature:c contact_row:c slot:r row_a:r row_b:r at_a:r at_b:r of_a:r of_b:r state:r",
    "index:r redundant:r extreme_vertex:9 saturated:d pressed:d motor_row:d counts:12 along_body:k",
    f"block_after:t,{BLOCK_WORDS} first_near:t+1 block_near:t,{NEIGHBOURS} odometer:t,{ODOMETER} tree_link:t+1",
    f"link_body:l attempt:t,{ATTEMPT} unguessed:t,2",
)

# Where in the head of the block of integers the kernel finds sizes and the start of each field.
LETTERS = "bdskpmcrateyqfnilh"
HEAD = len(LETTERS) + 1
(BODIES, DOFS, COORDINATES, SHAPES, VERTICES, MIMICS, CONTACTS, ROWS, SLOTS, TREES) = range(10)
PAIRS, MATRIX, WIDTH = LETTERS.index("f"), LETTERS.index("q"), len(LETTERS)

ADVANCE, TERMS, LINK_POSES = range(3)
"""Actions of a kernel: advance, compute poses and M and bias, or compute the poses of links."""
DT, FLOOR, HAS_FLOOR, HAS_PAIRS = range(4)
"""Entries of ``numbers``: step [s], height of the ground plane [m], whether there is one, whether shapes can meet."""
FOUND_CONTACTS, FOUND_ROWS, GUESSES, ITERATED, STEPS, LAST_PAIRS, OVERFULL, SLEEPING, FOUND_PAIRS = range(9)
"""Entries of ``counts``: of the last step the contacts, rows, and how they were solved; of all how many were hard; how
many contacts of pairs are remembered; whether there were more contacts than there is room for; how many contacts are
kept, from the end of their room on, for trees that sleep; pairs of shapes that were near each other in the last."""

_enumeration: Any = IntEnum
At: Any = _enumeration(
    "At",
    {name: HEAD + k for k, name in enumerate(FLOATS)}
    | {name: HEAD + len(FLOATS) + 1 + k for k, name in enumerate(INTEGERS)},
)
"""Where in the block of integers the start of each field is found."""
FIRST_INTEGER = HEAD + len(FLOATS) + 1 + len(INTEGERS) + 1


@dataclass(frozen=True, eq=False)
class Arrays:
    """The two blocks and the views of them by name.

    Attributes:
        floats: all floats, one after the other.
        integers: sizes, starts of all fields, then all integers.
        views: name → view of its field, in its shape.
    """

    floats: NDArray[np.float64]
    integers: NDArray[np.int64]
    views: Mapping[str, NDArray[Any]]

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the view of a field."""
        return self.views[name]


def _zeros(count: int, kind: type[Any]) -> NDArray[Any]:
    """Return zeros in pages that take memory, and the time to clear it, when they are first used.

    numpy requests pages of 2 MB for large arrays. Of a matrix for all rows that an island may have, most worlds use a
    few kilobytes, and clearing 2 MB for each takes a first step up to 5 ms.
    """
    flags = {"flags": mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS} if hasattr(mmap, "MAP_PRIVATE") else {}
    return np.frombuffer(mmap.mmap(-1, max(8, 8 * count), **flags), dtype=kind, count=count)


def allocate(sizes: Sequence[int], *, width: int) -> Arrays:
    """Return blocks of zeros for these counts, in the order of `LETTERS`; rows of J have `width` entries.

    Raises:
        SimulationError: there is not that much memory.
    """
    counts = dict(zip(LETTERS, sizes, strict=True))

    def number(size: str) -> int:
        if size.isdigit():
            return int(size)
        return counts[size[0]] + (1 if size.endswith("+1") else 0)

    def shape(size: Size) -> tuple[int, ...]:
        return tuple(number(one) for one in size)

    # Fields that are accessed `LANES` entries at a time may be read and written beyond their end.
    lanes: dict[Size, int] = {("r",): LANES, ("q",): LANES * counts["r"], ("y",): LANES * width}
    float_starts = np.cumsum([0, *(int(np.prod(shape(size))) + lanes.get(size, 0) for size in FLOATS.values())])
    integer_starts = FIRST_INTEGER + np.cumsum([0, *(int(np.prod(shape(size))) for size in INTEGERS.values())])
    try:
        floats = _zeros(int(float_starts[-1]), np.float64)
        integers = _zeros(int(integer_starts[-1]), np.int64)
    except (MemoryError, OSError, OverflowError, ValueError):
        needed = 8e-9 * float(float_starts[-1] + integer_starts[-1])
        raise SimulationError(
            f"a world of {counts['t']} robots and bodies with {counts['k']} collision shapes needs {needed:.3g} GB of "
            "memory, which is not available; simulate fewer of them"
        ) from None
    integers[: len(sizes)] = sizes
    integers[WIDTH] = width
    integers[HEAD : HEAD + len(FLOATS) + 1] = float_starts
    integers[HEAD + len(FLOATS) + 1 : FIRST_INTEGER] = integer_starts
    views: dict[str, NDArray[Any]] = {}
    for block, table, starts in ((floats, FLOATS, float_starts), (integers, INTEGERS, integer_starts)):
        for (name, size), start in zip(table.items(), starts, strict=False):
            views[name] = block[start : start + int(np.prod(shape(size)))].reshape(shape(size))
    return Arrays(floats, integers, views)
