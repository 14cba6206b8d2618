"""The velocity command a drive was sent last."""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite
from typing import TYPE_CHECKING, Any

from urdfkit.messages import TWIST

if TYPE_CHECKING:
    from urdfkit.sim.plugins.setup import Setup

STILL = (0.0, 0.0, 0.0)
"""No velocity."""


class Command:
    """Listens to a topic and holds its last Twist; what is not finite is dropped with a note.

    Args:
        setup: the drive's.
        topic: absolute.
        arrived: called after each command that is taken.

    Attributes:
        topic: where it listens.
        linear: [m/s]; shape (3,).
        angular: [rad/s]; shape (3,).
        count: how many commands were taken.
    """

    def __init__(self, setup: Setup, topic: str, arrived: Callable[[], None]) -> None:
        self.topic = topic
        self._note = setup.note
        self._arrived = arrived
        self.linear: tuple[float, float, float] = STILL
        self.angular: tuple[float, float, float] = STILL
        self.count = 0
        setup.bus.subscribe(topic, TWIST, self._take)

    def _take(self, message: Any) -> None:
        linear, angular = (
            (float(vector.x), float(vector.y), float(vector.z)) for vector in (message.linear, message.angular)
        )
        if not all(isfinite(part) for part in (*linear, *angular)):
            self._note(
                f"dropped a command on {self.topic}: {linear[0]:g} {linear[1]:g} {linear[2]:g} m/s, "
                f"{angular[0]:g} {angular[1]:g} {angular[2]:g} rad/s is not finite"
            )
            return
        self.linear, self.angular = linear, angular
        self.count += 1
        self._arrived()

    def clear(self) -> None:
        """Want to stand still."""
        self.linear = self.angular = STILL
