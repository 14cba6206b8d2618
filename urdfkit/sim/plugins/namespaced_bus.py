"""The bus as one robot's plugins see it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from urdfkit.bus import Bus, Subscription


class OwnBus(Bus):
    """A bus as one robot's plugins see it: the same topics; it knows what they listen to.

    Args:
        bus: everybody's.
        invalidate: called with each message that they hear, before they do: something may be due sooner now.
    """

    def __init__(self, bus: Bus, invalidate: Callable[[], None]) -> None:
        self._topics = bus._topics
        self._subscriptions: list[Subscription] = []
        self._invalidate = invalidate

    def subscribe(self, name: str, type: str, callback: Callable[[Any], None]) -> Subscription:
        """Call `callback` with every message published from now on."""

        def receive(message: Any) -> None:
            self._invalidate()
            callback(message)

        found = super().subscribe(name, type, receive)
        self._subscriptions.append(found)
        return found

    def close(self) -> None:
        """Stop listening to anything."""
        for each in self._subscriptions:
            each.close()
