"""Plots: send any number of any message while a page plots it."""

import math
from collections.abc import Callable
from typing import Any

from urdfkit.app.simulation.features.feature import Feature
from urdfkit.app.simulation.features.message_values import number_at
from urdfkit.bus import Subscription
from urdfkit.errors import UsageError
from urdfkit.sim.simulator import Simulator
from urdfkit.view.server.server import Server

FIELD = "field:"
"""Prefix of the key of a plot, followed by the topic, a colon and the path in its messages."""
PERIOD = 0.05
"""Seconds between two messages with samples."""
MOST = 400
"""Maximum number of samples in a message; others are dropped."""


class Plots(Feature):
    """Subscribes to the topics that pages plot."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._curves: dict[str, _Plot] = {}

    def tick(self) -> None:
        """Subscribe to the plotted topics, and send the samples."""
        if not self.is_due(PERIOD):
            return
        wanted = {key for key in self.server.hub.subscribed_keys if key.startswith(FIELD)}
        for key in [key for key in self._curves if key not in wanted]:
            self._curves.pop(key).close()
        for key in wanted:
            curve = self._curves.get(key)
            if curve is None:
                curve = self._curves[key] = _Plot(self, key)
            curve.send()


class _Plot:
    """One number of one topic."""

    def __init__(self, part: Plots, key: str) -> None:
        self._part, self._key = part, key
        topic, _, self._path = key.removeprefix(FIELD).partition(":")
        self._samples: list[tuple[float, float]] = []
        self._subscription: Subscription | None = None
        self._error: str | None = None
        topics = {each.name: each for each in part.simulator.bus.topics}
        if topic not in topics:
            self._report(f"unknown topic {topic}")
            return
        self._subscription = part.simulator.bus.subscribe(topic, topics[topic].type, self._take)

    def _take(self, message: Any) -> None:
        if self._error is not None:
            return
        try:
            value = number_at(message, self._path)
        except UsageError as error:
            self._report(str(error))
            return
        self._samples.append((self._part.simulator.t, value))
        if len(self._samples) > MOST:
            del self._samples[1::2]

    def _report(self, error: str) -> None:
        self._error = error
        self._part.server.send_chunk(self._key, "samples", curve=self._key, error=error, t=[], values=[])

    def send(self) -> None:
        """Send the samples since the last call, if any."""
        samples, self._samples = self._samples, []
        if samples:
            self._part.server.send_chunk(
                self._key,
                "samples",
                curve=self._key,
                error=None,
                t=[round(t, 6) for t, _ in samples],
                values=[value if math.isfinite(value) else None for _, value in samples],
            )

    def close(self) -> None:
        """Unsubscribe."""
        if self._subscription is not None:
            self._subscription.close()
