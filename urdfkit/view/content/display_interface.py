"""Interfaces of the server for code that only shows a scene or publishes messages."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from urdfkit.view.content.mesh_store import GeometryStore


class StatusDisplay(Protocol):
    """Publishes latched messages; see `Server.publish_latched`."""

    def publish_latched(self, type: str, **values: Any) -> None:
        """Publish a message."""


class Display(StatusDisplay, Protocol):
    """Shows scenes and poses; see `Server`."""

    @property
    def geometries(self) -> GeometryStore:
        """The stored meshes."""

    def send(self, command: Any, /) -> None:
        """Send a meshcat command."""

    def show(
        self,
        *,
        name: str,
        nodes: Sequence[str],
        joints: Sequence[dict[str, Any]] = (),
        root: int = 0,
        draw: Callable[[Display], None],
    ) -> None:
        """Replace the scene."""

    def publish(self, time: float, poses: NDArray[np.floating[Any]], /) -> None:
        """Publish the poses of the nodes."""
