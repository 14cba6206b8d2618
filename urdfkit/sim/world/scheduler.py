"""Scheduler: calls, drives, controllers, sensors and publications between the steps of the engine."""

import heapq
from collections.abc import Callable, Sequence

from urdfkit.errors import SimulationError
from urdfkit.sim.plugins.builtin_publishers import Publication
from urdfkit.sim.state.periodic_steps import NEVER
from urdfkit.sim.state.robot_state import State
from urdfkit.sim.world.world_builder import WorldBuilder

ScheduledCall = tuple[int, int, float]
"""Step of a call, its number in the order of scheduling, and its period [s]; zero for one call."""


class Scheduler:
    """Calls, drives and controllers before a step; sensors, drives and publications after it.

    The next due steps are computed once and stored, so that a step without due work costs only the engine's step.
    `invalidate` discards them when work may become due earlier, as after a message to a plugin or a spawn.

    Args:
        builder: the robots.
        state: state of the first robot.
        dt: length of a step [s].

    Attributes:
        publications: the simulation's own.
        write_due: first step at which `write` has work to do.
        read_due: first step at which `read` has work to do.
    """

    def __init__(self, builder: WorldBuilder, state: State, dt: float) -> None:
        self.publications: tuple[Publication, ...] = ()
        self.write_due = self.read_due = 0
        self._builder, self._state, self._dt = builder, state, dt
        self._calls: list[tuple[int, int, float, Callable[[], None]]] = []
        self._number = 0
        self._saved: dict[int, Callable[[], None]] = {}

    def invalidate(self) -> None:
        """Check all work again, before and after the next step."""
        self.write_due = self.read_due = 0

    def schedule(self, step: int, period: float, call: Callable[[], None]) -> None:
        """Call `call` before a step, and then every `period` [s] if that is not zero."""
        self._number += 1
        heapq.heappush(self._calls, (step, self._number, period, call))
        self.invalidate()

    def save(self) -> tuple[int, tuple[ScheduledCall, ...]]:
        """Return the number of calls scheduled so far and the pending calls, as arguments of `restore`."""
        self._saved |= {number: call for _, number, _, call in self._calls}
        return self._number, tuple(sorted((step, number, period) for step, number, period, _ in self._calls))

    def restore(self, number: int, pending: Sequence[ScheduledCall]) -> None:
        """Schedule pending calls again, as `save` returned them; the calls are identified by their numbers.

        Raises:
            SimulationError: this simulation has not scheduled one of the calls.
        """
        calls = self._saved | {number: call for _, number, _, call in self._calls}
        if missing := [(step, period) for step, number, period in pending if number not in calls]:
            step, period = missing[0]
            every = f" every {period:g} s" if period else ""
            raise SimulationError(
                f"the snapshot has a call at t = {step * self._dt:g} s{every}; functions cannot be saved: "
                "schedule the same calls in the same order before `restore`"
            )
        self._calls = [(step, number, period, calls[number]) for step, number, period in pending]
        heapq.heapify(self._calls)
        self._number = number
        self.invalidate()

    def reset(self) -> None:
        """Begin again at step 0, without the calls."""
        self._calls.clear()
        for publication in self.publications:
            publication.reset()
        self.invalidate()

    def write(self) -> None:
        """Make the calls that are due, and let drives and controllers write targets."""
        state = self._state
        step = state.step
        self.write_due = 0  # stays so if a call raises
        while self._calls and self._calls[0][0] <= step:
            due, number, period, call = heapq.heappop(self._calls)
            self.invalidate()
            call()
            if period > 0:
                again = max(step + 1, due + max(1, round(period / self._dt)))
                heapq.heappush(self._calls, (again, number, period, call))
        for robot in self._builder.robot_list:
            for task in robot.writes:
                if task.next(step) <= step:
                    task.act(robot.state)
        self._update_write_due(step + 1)

    def read(self) -> None:
        """Let sensors, drives and publishers with work to do measure and publish."""
        step = self._state.step
        self.invalidate()  # stays so if a callback raises
        for robot in self._builder.robot_list:
            for tasks in robot.reads:
                for task in tuple(tasks):  # a callback may load or unload a controller
                    if task.due <= step and task.next(step) <= step:
                        task.act(robot.state)
        for publication in self.publications:
            if publication.due <= step:
                publication.act(self._state)
        self._update_write_due(step)
        self.read_due = self._next_read(step + 1)

    def next_stop(self) -> int:
        """Return the next step at which the simulation has to stop; publishers without subscribers have none."""
        step = self._state.step + 1
        if self.write_due == step:
            return step
        nearest = max(step, self._calls[0][0]) if self._calls else NEVER
        for robot in self._builder.robot_list:
            for tasks in (robot.writes, *robot.reads):
                for task in tasks:
                    if task.due < nearest and (due := task.stop(step)) < nearest:
                        nearest = due
                        if due <= step:  # nothing can be due before
                            return step
        for publication in self.publications:
            if publication.due < nearest:
                nearest = min(nearest, publication.stop(step))
        return nearest

    def _update_write_due(self, step: int) -> None:
        nearest = self._calls[0][0] if self._calls else NEVER
        for robot in self._builder.robot_list:
            for task in robot.writes:
                if nearest <= step:
                    break
                nearest = min(nearest, task.next(step))
        self.write_due = nearest

    def _next_read(self, step: int) -> int:
        """Return the first step from `step` on after which a task has work to do."""
        nearest = NEVER
        for publication in self.publications:
            if publication.due < nearest:
                nearest = publication.due
        for robot in self._builder.robot_list:
            for tasks in robot.reads:
                for task in tasks:
                    if task.due < nearest and (due := task.next(step)) < nearest:
                        nearest = due
                        if due <= step:
                            return step
        return nearest
