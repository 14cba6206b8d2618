"""Transport: one step, so many steps, slower and faster."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from urdfkit.app.simulation.features.feature import Done, Part, Takes
from urdfkit.errors import SimulationError
from urdfkit.view.protocol.page_requests import Order, Schema, number, whole

if TYPE_CHECKING:
    from urdfkit.app.simulation.clock_rate import Pace

MOST_STEPS = 10_000
"""At one order."""
CHUNK, LONGEST = 50, 1.0
"""Steps between two looks at the clock, and seconds that one order of steps may take: everybody waits for it."""


class Transport(Part):
    """Orders about time.

    Attributes:
        pace: how simulated time keeps up with the clock.
    """

    pace: Pace

    @property
    def takes(self) -> Takes:
        """The orders it takes."""
        return {
            "step": (Schema({"steps": whole(1, MOST_STEPS)}), self._step),
            "speed": (Schema({}, {"factor": number(0.01, 1000)}), self._speed),
        }

    def _step(self, order: Order) -> Done:
        if not self.simulator.paused:
            raise SimulationError("the simulation runs: pause it to go by steps")
        wanted, done, begin = order.values["steps"], 0, self.clock()
        while done < wanted and self.clock() - begin < LONGEST:
            chunk = min(CHUNK, wanted - done)
            self.simulator.step(chunk)
            done += chunk
        self.pace.restart(self.simulator.t)
        if done < wanted:
            raise SimulationError(f"{done} of {wanted} steps are done, which took {LONGEST:g} s; order the rest anew")
        return {"time": self.simulator.t}

    def _speed(self, order: Order) -> Done:
        """Change the factor; as fast as it can where there is none."""
        self.pace.factor = order.values.get("factor", inf)
        self.pace.restart(self.simulator.t)
        return None
