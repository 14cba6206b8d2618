"""Advance a simulation without a page in real time, while bridges serve their peers."""

import time
from collections.abc import Callable

from urdfkit.app.simulation.clock_rate import ClockRate
from urdfkit.bridges.bridge import Bridges
from urdfkit.sim.simulator import Simulator

WAIT = 0.002
"""Longest pause between two runs of steps [s]."""


class RunControls:
    """Pauses and resets a simulation that has no page.

    Args:
        simulator: the simulation.
    """

    def __init__(self, simulator: Simulator) -> None:
        self._simulator = simulator

    def reset(self) -> None:
        """Reset and continue."""
        self._simulator.reset()
        self._simulator.paused = False

    def pause(self, paused: bool) -> None:
        """Pause or continue."""
        self._simulator.paused = paused


def advance_in_real_time(
    simulator: Simulator, bridges: Bridges, end: Callable[[], bool], *, clock: Callable[[], float] = time.monotonic
) -> None:
    """Advance until `end` returns true, which is called before every step that peers may have changed.

    Raises:
        SimulationError: the simulation diverged.
    """
    pace = ClockRate(simulator.dt, clock)
    pace.begin(simulator.t)
    last = simulator.t
    while not end():
        bridges.take()
        if simulator.paused or simulator.t < last:
            pace.begin(simulator.t)
        steps = 0 if simulator.paused else pace.steps(simulator.t)
        begun = clock()
        for _ in range(steps):
            if end():
                return
            simulator.step()
        pace.took(steps, clock() - begun, simulator.t)
        last = simulator.t
        bridges.calls.wait(WAIT if simulator.paused else min(WAIT, pace.wait(simulator.t)))
