"""State of a simulation as bytes: a header that identifies the robots and the world, the engine's memory, and objects.

The state consists of the memory of the engine, the objects of plugins, the scheduled calls and the counts of topics.
"""

import hashlib
import json
import struct
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from urdfkit.bus import Bus
from urdfkit.errors import SimulationError
from urdfkit.sim.engine.simulation_memory import FLOATS, Arrays, At
from urdfkit.sim.plugins.controllers.control_loop import ControlLoop
from urdfkit.sim.snapshots.object_state import Registry, dumps, loads
from urdfkit.sim.world.live_world import LiveWorld
from urdfkit.sim.world.simulated_robot import SimulatedRobot

MAGIC = b"urdfkit snapshot"
VERSION = 2
HEADER = struct.Struct("<16sI32sQQQQ")
"""`MAGIC`, `VERSION`, the digest of the model, and the sizes of names, floats, integers and objects [bytes]."""

CONSTANTS = (
    "place_R", "place_p", "mass", "centre", "tensor", "damping", "friction", "lower", "upper", "mimic_factor",
    "mimic_offset", "shape_R", "shape_p", "shape_size", "shape_radius", "shape_mu", "vertices", "numbers",
    "tree_body", "kind", "parent", "shape_kind", "shape_body",
)  # fmt: skip
"""Arrays of the engine that describe robots and bodies, not their state."""


SCRATCH = {"A", "B", "Y", "columns", "read_s", "read_R", "read_p", "link_pose"}
"""Arrays of the engine that a step writes before it reads them: most of the memory of a large world."""


class Snapshots:
    """Saves and restores the state of a simulation.

    Args:
        world: the world of the simulation.
        bus: its topics.
    """

    def __init__(self, world: LiveWorld, bus: Bus) -> None:
        self._world, self._bus = world, bus
        self._digest: tuple[Any, bytes] = None, b""
        self._spans: tuple[Any, list[slice]] = None, []

    def take(self, *, calls: bool = True) -> bytes:
        """Return the state as bytes.

        Args:
            calls: include the times of scheduled calls.

        Raises:
            SimulationError: the state of a plugin cannot be saved.
        """
        world, arrays, robots = self._world, self._world.builder.engine.arrays, self._robots
        registry = self._registry()
        names = {
            "world": world.name,
            "entities": world.names,
            "controllers": [list(loop.controllers) for loop in self._loops],
        }
        content = {
            "objects": registry.states(),
            "robots": [(each.state.step, each.articulation.set_twist) for each in robots],
            "publications": [(each.done, each.next_message, each.due) for each in world.scheduler.publications],
            "topics": {each.name: (each.type, each.count) for each in self._bus.topics},
            "forces": world.forces.acting,
            "calls": world.scheduler.save() if calls else (0, ()),
        }
        floats = [arrays.floats[span].data for span in self._state_spans()]
        ends = json.dumps(names).encode(), dumps(content, registry)
        sizes = len(ends[0]), sum(part.nbytes for part in floats), arrays.integers.nbytes, len(ends[1])
        header = HEADER.pack(MAGIC, VERSION, self._model_digest(), *sizes)
        return b"".join((header, ends[0], *floats, arrays.integers.data, ends[1]))

    def restore(self, snapshot: bytes) -> None:
        """Restore a state. After an error the simulation is as before, except for loaded controllers.

        Raises:
            SimulationError: the bytes are not a snapshot of these robots in this world.
        """
        world, arrays = self._world, self._world.builder.engine.arrays
        names, floats, integers, objects = self._parts(snapshot)
        for loop, controllers in zip(self._loops, names["controllers"], strict=True):
            _load(loop, controllers)
        registry = self._registry()
        content = loads(objects, registry)
        world.scheduler.restore(*content["calls"])
        arrays.integers[:] = np.frombuffer(integers, dtype=np.int64)
        values, start = np.frombuffer(floats), 0
        for span in self._state_spans():
            end = start + span.stop - span.start
            arrays.floats[span], start = values[start:end], end
        registry.restore(content["objects"])
        world.forces.acting = content["forces"]
        for robot, (step, twist) in zip(self._robots, content["robots"], strict=True):
            robot.articulation.set_twist = twist
            robot.state.advance(step - robot.state.step)
        for publication, values in zip(world.scheduler.publications, content["publications"], strict=True):
            publication.done, publication.next_message, publication.due = values
        for name, (kind, count) in {
            **{each.name: (each.type, 0) for each in self._bus.topics},
            **content["topics"],
        }.items():
            self._bus.advertise(name, kind).restore(count)
        world.restore_gravity()

    @property
    def _robots(self) -> Sequence[SimulatedRobot]:
        return self._world.builder.robot_list

    @property
    def _loops(self) -> list[ControlLoop]:
        controllers = [each for robot in self._robots for each in robot.plugins.controllers]
        return [each.loop for each in controllers if each.loop is not None]

    def _registry(self) -> Registry:
        return Registry({robot.name: robot.live for robot in self._robots})

    def _parts(self, snapshot: bytes) -> tuple[Any, bytes, bytes, bytes]:
        """Return names, floats, integers and objects of a snapshot of this model.

        Raises:
            SimulationError: the bytes are not a snapshot of this model.
        """
        view = memoryview(snapshot)
        if len(view) < HEADER.size or bytes(view[: len(MAGIC)]) != MAGIC:
            raise SimulationError("not a snapshot: use the bytes that `snapshot` returned")
        _, version, digest, *sizes = HEADER.unpack_from(view)
        if version != VERSION:
            raise SimulationError(f"the snapshot has format {version}; this version of urdfkit reads format {VERSION}")
        if len(view) != HEADER.size + sum(sizes):
            raise SimulationError(f"the snapshot is damaged: it has {len(view)} bytes of {HEADER.size + sum(sizes)}")
        ends = HEADER.size + np.cumsum([0, *sizes])
        names, floats, integers, objects = (view[start:end] for start, end in pairwise(ends.tolist()))
        found = json.loads(bytes(names))
        world = self._world
        if digest != self._model_digest():
            here = f"{', '.join(world.names)} in world {world.name}"
            there = f"{', '.join(found['entities'])} in world {found['world']}"
            differs = "with other descriptions, options or live parameters" if here == there else f"not {here}"
            raise SimulationError(f"the snapshot contains {there}, {differs}; restore it in an equal simulation")
        return found, bytes(floats), bytes(integers), bytes(objects)

    def _model_digest(self) -> bytes:
        """Return a digest of the descriptions and of all constants, which changes with entities and live parameters."""
        engine = self._world.builder.engine
        if self._digest[0] is not engine:
            digest = hashlib.sha256(repr((engine.dt, self._world.names)).encode())
            for name in CONSTANTS:
                digest.update(engine.arrays[name].tobytes())
            for robot in self._robots:
                digest.update(robot.name.encode())
                for element in robot.robot.element.walk():
                    digest.update(repr((element.tag, element.attributes, element.text)).encode())
            self._digest = engine, digest.digest()
        return self._digest[1]

    def _state_spans(self) -> list[slice]:
        """Return the ranges of the engine's floats that are part of the state."""
        engine = self._world.builder.engine
        if self._spans[0] is not engine:
            self._spans = engine, _spans(engine.arrays)
        return self._spans[1]


def _spans(arrays: Arrays) -> list[slice]:
    """Return the ranges of the floats that are part of the state."""
    first = int(At[next(iter(FLOATS))])
    starts = arrays.integers[first : first + len(FLOATS) + 1].tolist()
    spans: list[slice] = []
    for name, (start, end) in zip(FLOATS, pairwise(starts), strict=True):
        if name not in SCRATCH:
            joined = spans and spans[-1].stop == start
            spans.append(slice(spans.pop().start if joined else start, end))
    return spans


def _load(loop: ControlLoop, controllers: Sequence[str]) -> None:
    """Load and unload controllers of a loop; the restored state contains which of them run."""
    for name in [name for name in loop.controllers if name not in controllers]:
        loop.controllers[name].running = False
        loop.unload(name)
    for name in controllers:
        loop.load(name)
