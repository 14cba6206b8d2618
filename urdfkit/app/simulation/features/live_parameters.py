"""Live parameters: change friction, masses, gravity and gains while the simulation runs."""

from collections.abc import Callable
from typing import Any

from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.sim.construction.loading import MAX_GRAVITY
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.state.pid import Gains
from urdfkit.sim.world.live_tuning import LEAST_MASS, Tuning
from urdfkit.view.protocol.page_requests import Request, Schema, number, numbers, text
from urdfkit.view.server.server import Server


class LiveParameters(Feature):
    """Requests that change parameters."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._tuning = Tuning(self.simulator.world)

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        link = {"link": text()}
        gains = Schema({"path": text(), "p": number(0), "i": number(0), "d": number(0)}, {"clamp": number(0)})
        return {
            "gravity": (Schema({"gravity": numbers(3, bound=MAX_GRAVITY, unit="m/s²")}), self._gravity),
            "mass": (Schema({"name": text(), "mass": number(LEAST_MASS, 1e6, unit="kg")}, link), self._mass),
            "mu": (Schema({"name": text(), "mu": number(0, 1e4)}, link), self._mu),
            "gains": (gains, self._gains),
        }

    def show(self) -> None:
        """Publish all parameters with their values."""
        tuning, rows = self._tuning, []
        for name, robot in self.simulator.world.robots.items():
            if robot.has_plugins or name == self.simulator.name:
                links = [(name, each.name, each.mass, each.mu) for each in tuning.links(name)]
                rows += [_row(name, link, mass, mu) for name, link, mass, mu in links]
        rows += [_row(each.name, "", each.mass, each.mu) for each in tuning.models]
        self.server.publish_latched(
            "parameters",
            gravity=list(tuning.gravity),
            rows=[row for row in rows if row["mass"] is not None or row["mu"] is not None],
            gains=[{"path": path, "p": g.p, "i": g.i, "d": g.d, "clamp": g.i_max} for path, g in tuning.gains.items()],
        )

    def _gravity(self, request: Request) -> Done:
        self._tuning.set_gravity(request.values["gravity"])
        return self._done()

    def _mass(self, request: Request) -> Done:
        self._tuning.set_mass(request.values["name"], request.values["mass"], request.values.get("link", ""))
        return self._done()

    def _mu(self, request: Request) -> Done:
        self._tuning.set_mu(request.values["name"], request.values["mu"], request.values.get("link", ""))
        return self._done()

    def _gains(self, request: Request) -> Done:
        values = request.values
        before = self._tuning.gains.get(values["path"], Gains(0.0))
        most = values.get("clamp", before.i_max)
        least = -most if "clamp" in values else before.i_min
        self._tuning.set_gains(
            values["path"], Gains(values["p"], values["i"], values["d"], least, most, before.antiwindup)
        )
        return self._done()

    def _done(self) -> Done:
        self.show()
        return None


def _row(name: str, link: str, mass: float | None, mu: float | None) -> dict[str, Any]:
    return {"name": name, "link": link, "mass": mass, "mu": mu}
