"""Screen: what of a server somebody needs who only shows something, or only says how it goes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from urdfkit.view.content.mesh_store import GeometryStore


class Board(Protocol):
    """Where something is said that holds until the next of its type; see `Server.declare`."""

    def declare(self, type: str, **values: Any) -> None:
        """Say it."""


class Screen(Board, Protocol):
    """What robots are drawn on; see `Server`."""

    @property
    def geometries(self) -> GeometryStore:
        """The meshes it has."""

    def send(self, command: Any, /) -> None:
        """Send a meshcat command."""

    def show(self, *, name: str, nodes: Sequence[str], root: int = 0, draw: Callable[[Screen], None]) -> None:
        """Replace the scene."""

    def publish(self, time: float, poses: NDArray[np.floating[Any]], /) -> None:
        """Put everything where it is."""
