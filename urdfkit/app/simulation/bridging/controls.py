"""Controls: interface of what pauses and resets a running simulation."""

from typing import Protocol


class Controls(Protocol):
    """What pauses and resets a running simulation."""

    def reset(self) -> None:
        """Reset the simulation."""

    def pause(self, paused: bool) -> None:
        """Pause or continue."""
