"""Copies of a simulation in its present state, by `copy.deepcopy` and `pickle`."""

from collections.abc import Callable
from typing import Any

from urdfkit.scene import Scene
from urdfkit.sim.snapshots.snapshot import Snapshots
from urdfkit.sim.state.notes import Notes
from urdfkit.sim.world.live_world import LiveWorld, SpawnCall


class Copyable:
    """Base of `Simulator`: a copy has its own bus, and neither subscriptions nor scheduled calls."""

    world: LiveWorld
    note: Notes
    paused: bool
    _arguments: dict[str, Any]
    _scene: Scene | None
    _snapshots: Snapshots

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        """Return a simulation in the same state, which shares the descriptions."""
        return _copy(type(self), {**self._arguments, "scene": self._scene, "note": self.note}, *self._copied())

    def __reduce__(self) -> Any:
        """Pickle the descriptions and the state."""
        return _copy, (type(self), self._arguments, *self._copied())

    def _copied(self) -> tuple[tuple[str, ...], tuple[SpawnCall, ...], bytes, bool]:
        return self.world.removed, tuple(self.world.spawned.values()), self._snapshots.take(calls=False), self.paused


def _copy(
    of: Callable[..., Any],
    arguments: dict[str, Any],
    removed: tuple[str, ...],
    spawned: tuple[SpawnCall, ...],
    snapshot: bytes,
    paused: bool,
) -> Any:
    """Return a simulation with these arguments, after these changes of its entities, in the state of a snapshot."""
    simulator = of(**arguments)
    for name in removed:
        simulator.world.remove(name)
    for request, start, fixed_base in spawned:
        simulator.world.spawn(request, start, fixed_base=fixed_base)
    simulator.restore(snapshot)
    simulator.paused = paused
    return simulator
