"""Playback: single steps, N steps, and the speed of the simulation."""

from math import inf

from urdfkit.app.simulation.clock_rate import ClockRate
from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.errors import SimulationError
from urdfkit.view.protocol.page_requests import Request, Schema, number, whole

MOST_STEPS = 10_000
"""Maximum number of steps of one request."""
CHUNK, LONGEST = 50, 1.0
"""Steps between two readings of the clock, and maximum duration of one request [s]."""


class Playback(Feature):
    """Requests about time.

    Attributes:
        pace: ratio of simulated time to the clock.
    """

    pace: ClockRate

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        return {
            "step": (Schema({"steps": whole(1, MOST_STEPS)}), self._step),
            "speed": (Schema({}, {"factor": number(0.01, 1000)}), self._speed),
        }

    def _step(self, request: Request) -> Done:
        if not self.simulator.paused:
            raise SimulationError("the simulation is running: pause it to step")
        wanted, done, begin = request.values["steps"], 0, self.clock()
        while done < wanted and self.clock() - begin < LONGEST:
            chunk = min(CHUNK, wanted - done)
            self.simulator.step(chunk)
            done += chunk
        self.pace.restart(self.simulator.t)
        if done < wanted:
            raise SimulationError(
                f"stopped after {LONGEST:g} s with {done} of {wanted} steps done; request the remaining steps"
            )
        return {"time": self.simulator.t}

    def _speed(self, request: Request) -> Done:
        """Change the factor; without one, run as fast as possible."""
        self.pace.factor = request.values.get("factor", inf)
        self.pace.restart(self.simulator.t)
        return None
