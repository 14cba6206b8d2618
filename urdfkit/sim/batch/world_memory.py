"""Memory of the worlds of a batch: one block of floats and one of integers, with a row for each world."""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.compilation.native import bind
from urdfkit.sim.engine.simulation_memory import FLOATS, INTEGERS, Arrays, At

SCRATCH = frozenset({"A", "B", "Y", "columns", "pair_work", "pair_work_indices", "read_R", "read_p"})
"""Arrays that a step writes before it reads them: worlds that advance one after the other share them."""
CONSTANT = frozenset({"vertices", "link_R", "link_p", "pair_numbers", "pair_indices"})
"""Arrays that are never written, and are large in worlds with meshes: all worlds share them."""
ALIGNMENT = 8
"""Entries to which the rows are rounded up: a line of the processor's cache."""


class Block:
    """Block of a batch, with a row of fields for each world and fields that several worlds share.

    Compiled code finds each field by its start relative to the row. The start of a shared field lies behind the rows.

    Args:
        values: the block of one world.
        names: names of all fields, in their order.
        bounds: start of each field in `values`, and the end of the last.
        groups: number of the group of each world; the worlds of a group share their scratch.

    Attributes:
        rows: the fields of each world that are its own; shape (n, size).
        scratch: the scratch of all groups.
        starts: start of each field, relative to the row of each world; shape (n, fields).
    """

    def __init__(self, values: NDArray[Any], names: Sequence[str], bounds: Sequence[int], groups: NDArray[Any]) -> None:
        n = len(groups)
        spans = dict(zip(names, pairwise(bounds), strict=True))
        self._own: dict[str, int] = {}
        at = bounds[0]
        for name, (start, end) in spans.items():
            if name not in SCRATCH | CONSTANT:
                self._own[name], at = at, at + end - start
        self._size = size = -(-at // ALIGNMENT) * ALIGNMENT
        shared: dict[str, int] = {}
        constants = scratch = 0
        for name, (start, end) in spans.items():
            if name in CONSTANT:
                shared[name], constants = constants, constants + end - start
        for name, (start, end) in spans.items():
            if name in SCRATCH:
                shared[name], scratch = scratch, scratch + end - start
        count = int(groups.max()) + 1
        self._values = np.zeros(n * size + constants + count * scratch, dtype=values.dtype)
        self.rows = self._values[: n * size].reshape(n, size)
        self.rows[:, : bounds[0]] = values[: bounds[0]]
        self.scratch = self._values[n * size + constants :]
        first, behind = size * np.arange(n), n * size
        self.starts = np.zeros((n, len(names)), dtype=np.int64)
        for k, (name, (start, end)) in enumerate(spans.items()):
            if name in self._own:
                self.starts[:, k] = self._own[name]
                self.rows[:, self._own[name] : self._own[name] + end - start] = values[start:end]
            elif name in CONSTANT:
                self.starts[:, k] = behind + shared[name] - first
                self._values[behind + shared[name] : behind + shared[name] + end - start] = values[start:end]
            else:
                self.starts[:, k] = behind + constants + scratch * groups + shared[name] - first

    def field(self, name: str, shape: Sequence[int]) -> NDArray[Any]:
        """Return the view of a field of all worlds; shape (n, *shape)."""
        start = self.column(name)
        return self.rows[:, start : start + int(np.prod(shape))].reshape(len(self.rows), *shape)

    def column(self, name: str) -> int:
        """Return the place in `rows` where a field starts."""
        return self._own[name]

    def tail(self, world: int) -> NDArray[Any]:
        """Return the memory from the row of a world to the end of the block, which contains all its fields."""
        return self._values[world * self._size :]


class WorldMemory:
    """Memory of a number of worlds that begin as copies of one.

    Args:
        arrays: memory of the world that is copied.
        groups: number of the group of each world; only one world of a group may advance at a time.
        kernel: the compiled function that advances a world.

    Attributes:
        floats: the floats of all worlds.
        integers: the integers of all worlds.
        advance: for each world, a function of the number of steps and of an action, see `world_step.advance`.
    """

    def __init__(self, arrays: Arrays, groups: NDArray[Any], kernel: Callable[..., int]) -> None:
        self._shapes: Mapping[str, Sequence[int]] = {name: view.shape for name, view in arrays.views.items()}
        first = int(At[next(iter(FLOATS))]), int(At[next(iter(INTEGERS))])
        tables = [slice(at, at + len(fields)) for at, fields in zip(first, (FLOATS, INTEGERS), strict=True)]
        bounds = [arrays.integers[table.start : table.stop + 1].tolist() for table in tables]
        self.floats = Block(arrays.floats, list(FLOATS), bounds[0], groups)
        self.integers = Block(arrays.integers, list(INTEGERS), bounds[1], groups)
        for table, block in zip(tables, (self.floats, self.integers), strict=True):
            self.integers.rows[:, table] = block.starts
        self._initial = self.floats.rows[0].copy(), self.integers.rows[0, bounds[1][0] :].copy()
        self._first_integer = bounds[1][0]
        worlds = range(len(groups))
        self.advance = [bind(kernel, self.floats.tail(world), self.integers.tail(world)) for world in worlds]

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the view of a field of all worlds; shape (n, …)."""
        block = self.floats if name in FLOATS else self.integers
        return block.field(name, self._shapes[name])

    def restore(self, worlds: NDArray[Any]) -> None:
        """Restore the initial state of some worlds."""
        self.floats.rows[worlds] = self._initial[0]
        self.integers.rows[worlds, self._first_integer :] = self._initial[1]
