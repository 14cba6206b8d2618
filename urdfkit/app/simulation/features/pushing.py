"""Pushing: forces on links while pages drag them."""

import contextlib
from collections.abc import Callable

from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.errors import SimulationError
from urdfkit.sim.simulator import Simulator
from urdfkit.view.protocol.page_requests import Request, Schema, number, numbers, text
from urdfkit.view.server.server import Server

HOLD = 0.3
"""Duration of a push in simulated time [s] unless it is given; pages repeat it twenty times a second."""
LONGEST = 60.0
"""Maximum duration of a push [s]."""
STRONGEST = 1e5
"""Maximum force [N] and torque [N·m]."""


class Pushing(Feature):
    """Pushes of each page."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._held: dict[int, str] = {}

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        force, torque = numbers(3, bound=STRONGEST, unit="N"), numbers(3, bound=STRONGEST, unit="N·m")
        wrench = {"force": force, "torque": torque, "at": numbers(3, bound=1e3, unit="m")}
        return {
            "push": (Schema({"link": text(), **wrench}, {"seconds": number(1e-3, LONGEST, unit="s")}), self._push),
            "release": (Schema(), self._let_go),
        }

    def forget(self) -> None:
        """Release all links."""
        self._held.clear()

    def _push(self, request: Request) -> Done:
        values = request.values
        seconds = values.get("seconds", HOLD)
        self._release(request.client)
        self.simulator.world.push(
            values["link"], values["force"], values["torque"], at=values["at"], for_seconds=seconds
        )
        self._held[request.client] = values["link"]
        self.server.drive_lock.claim(request.client)
        return None

    def _let_go(self, request: Request) -> Done:
        self._release(request.client)
        return None

    def _release(self, client: int) -> None:
        if (link := self._held.pop(client, None)) is not None:
            with contextlib.suppress(SimulationError):  # its body may have been removed meanwhile
                self.simulator.world.release(link)
