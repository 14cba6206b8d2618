"""Curves on the page: any number in any message, from when a page wants it until none does."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from urdfkit.app.simulation.features.feature import Part
from urdfkit.app.simulation.features.message_values import number_at
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.bus import Subscription
    from urdfkit.sim.simulator import Simulator
    from urdfkit.view.server.server import Server

FIELD = "field:"
"""Begins the key of a curve, which goes on with the topic, a colon and the path in its messages."""
PERIOD = 0.05
"""Seconds between two parts of a curve."""
MOST = 400
"""Samples of a curve that are kept until the next part; of more every second is left out."""


class Curves(Part):
    """Listens to the topics that pages plot numbers of."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._curves: dict[str, _Curve] = {}

    def tick(self) -> None:
        """Listen to what pages want, and send what has come."""
        if not self.is_due(PERIOD):
            return
        wanted = {key for key in self.server.hub.wanted if key.startswith(FIELD)}
        for key in [key for key in self._curves if key not in wanted]:
            self._curves.pop(key).close()
        for key in wanted:
            curve = self._curves.get(key)
            if curve is None:
                curve = self._curves[key] = _Curve(self, key)
            curve.send()


class _Curve:
    """One number of one topic."""

    def __init__(self, part: Curves, key: str) -> None:
        self._part, self._key = part, key
        topic, _, self._path = key.removeprefix(FIELD).partition(":")
        self._samples: list[tuple[float, float]] = []
        self._subscription: Subscription | None = None
        self._error: str | None = None
        known = {each.name: each for each in part.simulator.bus.topics}
        if topic not in known:
            self._say(f"there is no topic {topic}")
            return
        self._subscription = part.simulator.bus.subscribe(topic, known[topic].type, self._take)

    def _take(self, message: Any) -> None:
        if self._error is not None:
            return
        try:
            value = number_at(message, self._path)
        except UsageError as error:
            self._say(str(error))
            return
        self._samples.append((self._part.simulator.t, value))
        if len(self._samples) > MOST:
            del self._samples[1::2]

    def _say(self, error: str) -> None:
        self._error = error
        self._part.server.stream(self._key, "samples", curve=self._key, error=error, t=[], values=[])

    def send(self) -> None:
        """Send what has come since the last time; nothing where there is none."""
        samples, self._samples = self._samples, []
        if samples:
            self._part.server.stream(
                self._key,
                "samples",
                curve=self._key,
                error=None,
                t=[round(t, 6) for t, _ in samples],
                values=[value if math.isfinite(value) else None for _, value in samples],
            )

    def close(self) -> None:
        """Listen no more."""
        if self._subscription is not None:
            self._subscription.close()
