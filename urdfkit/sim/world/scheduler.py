"""Scheduler: calls, drives, controllers, sensors and publications between the steps of the engine."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from typing import TYPE_CHECKING

from urdfkit.sim.state.ticks import NEVER

if TYPE_CHECKING:
    from urdfkit.sim.plugins.publishers import Publication
    from urdfkit.sim.state.robot_state import State
    from urdfkit.sim.world.world_builder import WorldBuilder


class Scheduler:
    """Calls at a time, drives and controllers before a step; sensors, drives and publications after it.

    The next due steps are computed once and kept, so that a step without anything due costs the engine's step alone.
    `invalidate` discards them, when something may be due sooner: a message to a plugin, a started controller, a spawn.

    Args:
        builder: the robots.
        state: tells the present step.
        dt: length of a step [s].

    Attributes:
        publications: the simulation's own.
        write_due: before it, `write` has nothing to do.
        read_due: before it, `read` has nothing to do.
    """

    def __init__(self, builder: WorldBuilder, state: State, dt: float) -> None:
        self.publications: tuple[Publication, ...] = ()
        self.write_due = self.read_due = 0
        self._builder, self._state, self._dt = builder, state, dt
        self._calls: list[tuple[int, int, float, Callable[[], None]]] = []
        self._number = 0

    def invalidate(self) -> None:
        """Look at everything again, before and after the next step."""
        self.write_due = self.read_due = 0

    def schedule(self, step: int, period: float, call: Callable[[], None]) -> None:
        """Call `call` before a step, and then every `period` [s] where that is not zero."""
        self._number += 1
        heapq.heappush(self._calls, (step, self._number, period, call))
        self.invalidate()

    def reset(self) -> None:
        """Begin anew at step 0, without the calls."""
        self._calls.clear()
        for publication in self.publications:
            publication.reset()
        self.invalidate()

    def write(self) -> None:
        """Make the calls that are due, and let drives and controllers write targets."""
        step = self._state.step
        self.write_due = 0  # for whoever raises
        while self._calls and self._calls[0][0] <= step:
            due, number, period, call = heapq.heappop(self._calls)
            self.invalidate()
            call()
            if period > 0:
                again = max(step + 1, due + max(1, round(period / self._dt)))
                heapq.heappush(self._calls, (again, number, period, call))
        for robot in self._builder.robot_list:
            robot.write(step)
        self._foresee_writing(step + 1)

    def read(self) -> None:
        """Let whoever is due measure and publish."""
        step = self._state.step
        self.invalidate()  # for whoever raises
        for robot in self._builder.robot_list:
            robot.read(step)
        for publication in self.publications:
            if publication.due <= step:
                publication.catch_up(self._state)
        self._foresee_writing(step)
        self.read_due = self._read_from(step + 1)

    def next_stop(self) -> int:
        """Return the next step at which the simulation has to stop; what nobody listens to has none."""
        step = self._state.step
        if self.write_due == step + 1:
            return step + 1
        nearest = max(step + 1, self._calls[0][0]) if self._calls else NEVER
        for robot in self._builder.robot_list:
            nearest = min(nearest, robot.next_stop(step))
        for publication in self.publications:
            if publication.due < nearest:
                nearest = min(nearest, publication.next_stop(step))
        return nearest

    def _foresee_writing(self, step: int) -> None:
        """Take note of the first step from `step` on before which something is due."""
        nearest = self._calls[0][0] if self._calls else NEVER
        for robot in self._builder.robot_list:
            if nearest <= step:
                break
            nearest = min(nearest, robot.write_due(step))
        self.write_due = nearest

    def _read_from(self, step: int) -> int:
        """Return the first step from `step` on after which something is due."""
        nearest = NEVER
        for publication in self.publications:
            if publication.due < nearest:
                nearest = publication.due
        for robot in self._builder.robot_list:
            if nearest <= step:
                break
            nearest = min(nearest, robot.read_due(step))
        return nearest
