"""PageServer: what the handlers of requests need of the server."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from urdfkit.view.content.mesh_store import GeometryStore
    from urdfkit.view.server.access_control import Gate
    from urdfkit.view.server.broadcast import Hub
    from urdfkit.view.server.drive_lock import Driver
    from urdfkit.view.server.rejection_log import Refusals
    from urdfkit.view.server.send_queue import Channel


class PageServer(Protocol):
    """What serves a page, see `urdfkit.view.server.server.Server`."""

    gate: Gate
    hub: Hub
    driver: Driver
    refusals: Refusals
    geometries: GeometryStore

    def heard(self, client: int, channel: Channel, frame: str | bytes) -> None:
        """Check a frame from a page and pass it on."""
