"""Bus of one robot's plugins, which records their subscriptions."""

from collections.abc import Callable
from typing import Any

from urdfkit.bus import Build, Bus, Subscription


class OwnBus(Bus):
    """Bus of one robot's plugins: shares the topics of the simulation's bus, and records the plugins' subscriptions.

    Args:
        bus: bus of the simulation.
        invalidate: called before each message is delivered to a plugin, as the message may make work due earlier.
    """

    def __init__(self, bus: Bus, invalidate: Callable[[], None]) -> None:
        self._topics = bus._topics
        self._subscriptions: list[Subscription] = []
        self._invalidate = invalidate

    def subscribe(
        self, name: str, type: str, callback: Callable[[Any], None], *, defer: Callable[[Build], None] | None = None
    ) -> Subscription:
        """Call `callback` with every message published from now on."""

        def receive(message: Any) -> None:
            self._invalidate()
            callback(message)

        found = super().subscribe(name, type, receive, defer=defer)
        self._subscriptions.append(found)
        return found

    def close(self) -> None:
        """Close all subscriptions of the plugins."""
        for each in self._subscriptions:
            each.close()
