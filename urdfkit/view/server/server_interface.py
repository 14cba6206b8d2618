"""PageServer: the interface of the server that the request handlers use."""

from typing import Protocol

from urdfkit.network.access_control import AccessControl
from urdfkit.network.rejection_log import RejectionLog
from urdfkit.view.content.mesh_store import GeometryStore
from urdfkit.view.server.broadcast import Hub
from urdfkit.view.server.drive_lock import DriveLock
from urdfkit.view.server.send_queue import Channel


class PageServer(Protocol):
    """Server of a page; see `urdfkit.view.server.server.Server`."""

    access: AccessControl
    hub: Hub
    drive_lock: DriveLock
    rejections: RejectionLog
    geometries: GeometryStore

    def receive(self, client: int, channel: Channel, frame: str | bytes) -> None:
        """Check and process a frame from a page."""
