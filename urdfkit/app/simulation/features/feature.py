"""Part: one thing that the page of a simulation can do. What they share: the simulation, the server, orders."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from urdfkit.sim.simulator import Simulator
    from urdfkit.view.protocol.page_requests import Order, Schema
    from urdfkit.view.server.server import Server

Done = dict[str, Any] | None
"""What the page is answered."""
Takes = Mapping[str, "tuple[Schema, Callable[[Order], Done]]"]
"""Order → what it takes, and what does it."""


class Part:
    """A part of the page. Works in the thread of the simulation, between steps.

    Args:
        simulator: what it is about.
        server: the page.
        clock: wall clock [s].
    """

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        self.simulator, self.server, self.clock = simulator, server, clock
        self._due = 0.0

    @property
    def takes(self) -> Takes:
        """The orders it takes."""
        return {}

    def show(self) -> None:
        """Tell the pages what there is; called at the start, and when something came or went."""

    def tick(self) -> None:
        """Do what is due; called in every round."""

    def forget(self) -> None:
        """Start again; called after a reset."""

    def is_due(self, period: float) -> bool:
        """Whether so many seconds have passed since this was last true."""
        now = self.clock()
        if now < self._due:
            return False
        self._due = now + period
        return True
