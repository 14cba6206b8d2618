"""Base classes of periodic work in a simulation: calls and publishers with a rate."""

from abc import ABC, abstractmethod

from urdfkit.bus import Topic
from urdfkit.sim.state.periodic_steps import NEVER, PeriodicSteps
from urdfkit.sim.state.robot_state import State


class Periodic(ABC):
    """Work that is due at certain steps: the common interface of drives, controllers, sensors and publishers.

    Attributes:
        due: step before which no work is due; zero if it is not known in advance.
    """

    due: int = 0

    @abstractmethod
    def next(self, step: int) -> int:
        """Return the first step from `step` on at which `act` has work to do; `NEVER` for none."""

    def stop(self, step: int) -> int:
        """Return the first step from `step` on at which the simulation has to stop for this work; `NEVER` for none."""
        return self.next(step)

    @abstractmethod
    def act(self, state: State) -> None:
        """Do the work that is due at the step of the state."""


class Publisher(Periodic):
    """Measures or builds messages at a fixed rate, for one topic or several.

    A simulation stops for a publisher only while a topic has subscribers. Messages that became due without subscribers
    are counted together at the next stop, so a message may depend on its number (`done`), but never on the number of
    calls of `act`.

    Attributes:
        rate: rate of the messages [Hz]; zero or less means every step.
        topics: topics of the messages. Without any, the simulation stops at each due step.
        lead: number of steps before a message at which measuring begins; `NEVER` means at every step.
        done: number of messages so far.
        next_message: step of the next message.
    """

    rate: float = 0.0
    topics: tuple[Topic, ...] = ()
    lead: int = 0
    done: int = 0
    next_message: int = 0

    def schedule(self, dt: float, step: int = 0) -> None:
        """Start at a step of a simulation with steps of `dt` [s]."""
        self._ticks = PeriodicSteps(self.rate, dt)
        self.reset(step)
        self.due = 0  # `act` gets the first state

    def reset(self, step: int = 0) -> None:
        """Restart at a step; messages due until then count as published."""
        self.done = self._ticks.until(step)
        self.next_message = self._ticks.after(step)
        self.due = self.next_message - self.lead

    def next(self, step: int) -> int:
        """Return the first step from `step` on at which a measurement is due, with or without subscribers."""
        return self.due if self.due > step else step

    def stop(self, step: int) -> int:
        """Return the next step at which the simulation has to stop for the publisher; `NEVER` without subscribers."""
        for topic in self.topics:
            if topic.subscribers:
                return max(step, self._ticks.next(step) - self.lead)
        return NEVER if self.topics else max(step, self._ticks.next(step) - self.lead)

    def act(self, state: State) -> None:
        """Publish the messages that are due."""
        if state.step >= self.next_message:
            count = self._ticks.until(state.step) - self.done
            self.done += count
            self.next_message = self._ticks.after(state.step)
            self.measure(state, count)
        self.due = self.next_message - self.lead

    @abstractmethod
    def measure(self, state: State, count: int) -> None:
        """Publish a measurement of this state, which counts as `count` messages."""
