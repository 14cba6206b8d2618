"""Everything a robot needs to be simulated, in one block of floats and one of integers.

The kernel takes the two blocks, so that a call costs the same for every robot; Python sees the same memory through
named views. A copy of the blocks is a copy of the whole simulation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.sim.engine.compilation import inlined

Size = tuple[str, ...]

# name → shape; the letters are counts: b bodies, d dofs, s coordinates, k shapes, p vertices, m mimic joints,
# c contacts, r rows, a slots of remembered impulses.
FLOATS: dict[str, Size] = {
    # the robot
    "place_R": ("b", "9"),
    "place_p": ("b", "3"),
    "mass": ("b",),
    "centre": ("b", "3"),
    "tensor": ("b", "6"),
    "subspace": ("d", "6"),
    "damping": ("d",),
    "friction": ("d",),
    "lower": ("d",),
    "upper": ("d",),
    "mimic_factor": ("m",),
    "mimic_offset": ("m",),
    "shape_R": ("k", "9"),
    "shape_p": ("k", "3"),
    "shape_size": ("k", "3"),
    "shape_radius": ("k",),
    "shape_mu": ("k",),
    "vertices": ("p", "3"),
    "extreme": ("8",),
    "base": ("3",),
    "gravity": ("3",),
    "numbers": ("4",),
    # targets
    "motor_velocity": ("d",),
    "motor_effort": ("d",),
    "applied": ("d",),
    "position_target": ("d",),
    "velocity_target": ("d",),
    "kp": ("d",),
    "kd": ("d",),
    "servo_effort": ("d",),
    # state
    "s": ("s",),
    "v": ("d",),
    "memory": ("a",),
    # what a step found
    "effort": ("d",),
    "tau": ("d",),
    "R": ("b", "9"),
    "r": ("b", "3"),
    "P": ("3",),
    "S": ("d", "6"),
    "twist": ("b", "6"),
    "bias_acceleration": ("b", "6"),
    "composite_mass": ("b",),
    "composite_h": ("b", "3"),
    "composite_T": ("b", "6"),
    "force": ("b", "6"),
    "M": ("d", "d"),
    "bias": ("d",),
    "L": ("d", "d"),
    "inverse_diagonal": ("d",),
    "u": ("d",),
    "v_start": ("d",),
    "s_ahead": ("s",),
    "v_ahead": ("d",),
    "contact_origin": ("3",),
    "contact_point": ("c", "3"),
    "contact_frame": ("c", "9"),
    "contact_gap": ("c",),
    "contact_mu": ("c",),
    "Y": ("r", "d"),
    "row_bias": ("r",),
    "g": ("r",),
    "low": ("r",),
    "high": ("r",),
    "mu": ("r",),
    "before": ("r",),
    "slip": ("r",),
    "x": ("r",),
    "y": ("r",),
    "A": ("r", "r"),
    "B": ("r", "r"),
}

INTEGERS: dict[str, Size] = {
    "kind": ("b",),
    "parent": ("b",),
    "first_s": ("b",),
    "first_v": ("b+1",),
    "body_last_dof": ("b",),
    "dof_parent": ("d",),
    "dof_s": ("d",),
    "mimic_dof": ("m",),
    "mimic_master": ("m",),
    "shape_kind": ("k",),
    "shape_body": ("k",),
    "shape_feature": ("k",),
    "shape_vertex": ("k+1",),
    "contact_body": ("c",),
    "contact_feature": ("c",),
    "contact_row": ("c",),
    "slot": ("r",),
    "state": ("r",),
    "index": ("r",),
    "extreme_vertex": ("8",),
    "saturated": ("d",),
    "counts": ("8",),
}

# Where in the head of the block of integers the kernel finds sizes and the start of each field.
HEAD = 10
(BODIES, DOFS, COORDINATES, SHAPES, VERTICES, MIMICS, CONTACTS, ROWS, SLOTS, FLOATING) = range(HEAD)
LETTERS = "bdskpmcra"

DT, FLOOR, HAS_FLOOR = range(3)
"""Entries of ``numbers``: step [s], height of the ground plane [m], whether there is one."""
FOUND_CONTACTS, FOUND_ROWS, GUESSES, ITERATED, STEPS = range(5)
"""Entries of ``counts``: of the last step the contacts, rows, and how they were solved; of all how many were hard."""

_enumeration: Any = IntEnum
At: Any = _enumeration(
    "At",
    {name: HEAD + k for k, name in enumerate(FLOATS)}
    | {name: HEAD + len(FLOATS) + 1 + k for k, name in enumerate(INTEGERS)},
)
"""Where in the block of integers the start of each field is found."""
FIRST_INTEGER = HEAD + len(FLOATS) + 1 + len(INTEGERS) + 1


@inlined
def field(block: Any, integers: Any, at: int) -> Any:
    """Return the part of a block that holds one field."""
    return block[integers[at] : integers[at + 1]]


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


def allocate(sizes: Sequence[int], *, floating: bool) -> Arrays:
    """Return blocks of zeros for these counts, in the order of `LETTERS`."""
    counts = dict(zip(LETTERS, sizes, strict=True))

    def number(size: str) -> int:
        if size.isdigit():
            return int(size)
        return counts[size[0]] + (1 if size.endswith("+1") else 0)

    def shape(size: Size) -> tuple[int, ...]:
        return tuple(number(one) for one in size)

    float_starts = np.cumsum([0, *(int(np.prod(shape(size))) for size in FLOATS.values())])
    integer_starts = FIRST_INTEGER + np.cumsum([0, *(int(np.prod(shape(size))) for size in INTEGERS.values())])
    floats = np.zeros(int(float_starts[-1]))
    integers = np.zeros(int(integer_starts[-1]), dtype=np.int64)
    integers[: len(sizes)] = sizes
    integers[FLOATING] = floating
    integers[HEAD : HEAD + len(FLOATS) + 1] = float_starts
    integers[HEAD + len(FLOATS) + 1 : FIRST_INTEGER] = integer_starts
    views: dict[str, NDArray[Any]] = {}
    for block, table, starts in ((floats, FLOATS, float_starts), (integers, INTEGERS, integer_starts)):
        for (name, size), start, end in zip(table.items(), starts, starts[1:], strict=False):
            views[name] = block[start:end].reshape(shape(size))
    return Arrays(floats, integers, views)
