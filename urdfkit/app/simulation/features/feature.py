"""Feature: base class of the features of a simulation's page, with simulator, server and requests."""

from collections.abc import Callable, Mapping
from typing import Any

from urdfkit.sim.simulator import Simulator
from urdfkit.view.protocol.page_requests import Request, Schema
from urdfkit.view.server.server import Server

Done = dict[str, Any] | None
"""Response to the page."""
Takes = Mapping[str, "tuple[Schema, Callable[[Request], Done]]"]
"""Request → its schema and its handler."""


class Feature:
    """A feature of the page. It works in the thread of the simulation, between steps.

    Args:
        simulator: the simulation.
        server: the page.
        clock: wall clock [s].
    """

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        self.simulator, self.server, self.clock = simulator, server, clock
        self._due = 0.0

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        return {}

    def show(self) -> None:
        """Publish the state; called at the start, and when an entity was spawned or removed."""

    def tick(self) -> None:
        """Do periodic work; called in every iteration."""

    def forget(self) -> None:
        """Clear the state; called after a reset."""

    def is_due(self, period: float) -> bool:
        """Whether this period has passed since the last time that this was true."""
        now = self.clock()
        if now < self._due:
            return False
        self._due = now + period
        return True
