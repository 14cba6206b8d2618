"""Server: tornado in a background thread; the caller's thread shows scenes, publishes poses and reads requests."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.network.access_control import LOOPBACK_NAMES, AccessControl, is_loopback
from urdfkit.network.listen_address import bind, urls
from urdfkit.network.rejection_log import RejectionLog
from urdfkit.network.server_thread import ServerThread
from urdfkit.view.content.mesh_store import GeometryStore
from urdfkit.view.protocol import websocket_messages as protocol
from urdfkit.view.protocol.page_requests import Request, Schema, check
from urdfkit.view.server.broadcast import Hub, pack
from urdfkit.view.server.drive_lock import DriveLock
from urdfkit.view.server.http_handlers import application
from urdfkit.view.server.request_inbox import Inbox
from urdfkit.view.server.saved_tokens import tokens_of
from urdfkit.view.server.send_queue import Channel

PERMISSIONS = ("pause", "reset", "change")
"""What pages may be permitted to do while another page drives: pause, step and set the speed; reset; all else that
changes the simulation."""
PERMISSION_OF = {"play": "pause", "pause": "pause", "reset": "reset", "step": "pause", "speed": "pause"}
"""Button or request → the permission that it needs while another page drives."""
OTHER_DRIVES = "another page is driving; wait until it stops"


class Server:
    """The page and its WebSocket.

    Every method may be called from the caller's thread at any time; no method waits for a browser.

    Args:
        mode: ``view`` (sliders move joints) or ``sim`` (keys drive).
        host: address to bind; with any other than a loopback address the page is open to the network.
        port: port to bind, 0 for any free port; None for the first free one starting at the default port.
        settings: additional values of the first message to the page.
        requests: the requests that pages may send, with the schemas of their values.
        watchers_may: names from `PERMISSIONS`: what pages may do while another page drives.

    Raises:
        UsageError: the port is in use or the address cannot be bound.
    """

    def __init__(
        self,
        mode: str,
        *,
        host: str = "127.0.0.1",
        port: int | None = None,
        settings: dict[str, Any] | None = None,
        requests: Mapping[str, Schema] | None = None,
        watchers_may: Iterable[str] = (),
    ) -> None:
        socket, self.port = bind(host, port)
        loopback = is_loopback(host)
        names = LOOPBACK_NAMES if loopback else (*LOOPBACK_NAMES, *local_names(host))
        # With port 0 the next start has another port, so no page can reconnect.
        secrets = {} if port == 0 else tokens_of(self.port)
        self.access = AccessControl(self.port, names=names, open_to_network=not loopback, **secrets)
        self.urls = urls(host, self.port, self.access.token)
        self.inbox = Inbox()
        self.drive_lock = DriveLock()
        self.hub = Hub()
        self.rejections = RejectionLog()
        self.geometries = GeometryStore()
        self.joints: frozenset[str] = frozenset()
        self.mode = mode
        self.requests: dict[str, Schema] = dict(requests or {})
        self.watchers_may = frozenset(watchers_may)
        self._seen = itertools.count(1)
        self._model = itertools.count(1)
        self._model_number = 0
        self._sequence = 0
        self._latest: tuple[int, bytes] | None = None
        self._latest_lock = threading.Lock()
        self._thread = ServerThread(
            "urdfkit-view", socket, lambda: application(self), max_body_size=protocol.MAX_INBOUND
        )
        self._post = self._thread.post
        may = {"watchers_may": sorted(self.watchers_may)} if self.watchers_may else {}
        self._settings = {**(settings or {}), **may}
        self.hub.latch("hello", self._hello())

    @property
    def url(self) -> str:
        """The URL to open, with the token."""
        return self.urls[0]

    def start(self) -> None:
        """Start the server."""
        self._thread.start()

    def stop(self) -> None:
        """Close all connections and end the thread; may be called twice."""
        self._thread.stop()

    def __enter__(self) -> Server:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    # Messages of the caller

    def change_mode(self, mode: str) -> None:
        """Change the mode; open pages load again. Scene, latched messages and requests of the old mode are dropped."""
        self.mode = mode
        self.requests.clear()
        self.joints = frozenset()
        self.drive_lock.release()
        self.inbox.take()
        self._post(self.hub.restart, "hello", self._hello())

    def _hello(self) -> str:
        return protocol.write("hello", protocol=protocol.VERSION, mode=self.mode, **self._settings)

    def send(self, command: Any) -> None:
        """Send a meshcat command; with this method the server is the ``window`` of a ``meshcat.Visualizer``."""
        packed = pack(command)
        self._post(self.hub.command, *packed)

    def show(
        self,
        *,
        name: str,
        nodes: Sequence[str],
        joints: Sequence[dict[str, Any]] = (),
        root: int = 0,
        draw: Callable[[Server], None],
    ) -> None:
        """Replace the scene.

        Args:
            name: name of the robot.
            nodes: scene paths that poses move, in the order of the rows of `publish`.
            joints: rows of the joint panel: name, type, lower, upper, position, mimic.
            root: index of the root link in `nodes`.
            draw: function that sends the scene with `send` and adds its meshes to `geometries`.
        """
        self._model_number = next(self._model)
        self.joints = frozenset(joint["name"] for joint in joints if not joint.get("mimic"))
        self._post(self.hub.forget_poses)
        draw(self)
        message = protocol.write(
            "model", number=self._model_number & 0xFF, name=name, root=root, nodes=list(nodes), joints=list(joints)
        )
        self._post(self.hub.latch, "model", message)

    def publish(self, time: float, poses: NDArray[np.floating[Any]]) -> None:
        """Send poses to all browsers; takes the caller microseconds, independent of the number of browsers.

        Args:
            time: simulated time [s].
            poses: shape (n, 7) in the order of the shown nodes, position [m] and quaternion x, y, z, w.
        """
        self._sequence = (self._sequence + 1) & 0xFFFFFFFF
        frame = protocol.pack_poses(self._sequence, time, poses, model=self._model_number & 0xFF)
        with self._latest_lock:
            idle = self._latest is None
            self._latest = self._sequence, frame
        if idle:
            self._post(self._send_latest)

    def _send_latest(self) -> None:
        with self._latest_lock:
            latest, self._latest = self._latest, None
        if latest is not None:
            self.hub.poses(*latest)

    def sense(self, key: str, index: int, time: float, kind: int, content: bytes) -> None:
        """Send a frame of a source to its subscribers; only the newest one is kept; see `pack_sensed`."""
        sequence = next(self._seen) & 0xFFFFFFFF
        self._post(self.hub.view, key, sequence, protocol.pack_sensed(index, time, kind, content, sequence))

    def broadcast(self, type: str, **values: Any) -> None:
        """Send a message to all pages; slow pages get only the newest of its type, such as ``status``."""
        self._post(self.hub.update, type, protocol.write(type, **values))

    def publish_latched(self, type: str, **values: Any) -> None:
        """Send a message to all pages without loss; pages that open later get the last one of its type."""
        self._post(self.hub.latch, type, protocol.write(type, **values))

    def send_to_subscribers(self, key: str, type: str, **values: Any) -> None:
        """Send a message to the subscribers of a key; slow pages get only the newest one."""
        self._post(self.hub.update_subscribers, key, protocol.write(type, **values))

    def send_chunk(self, key: str, type: str, **values: Any) -> None:
        """Send the next part of a stream to the subscribers of a key, in order."""
        self._post(self.hub.send_chunk, key, protocol.write(type, **values))

    def answer(self, request: Request, error: str | None = None, **values: Any) -> None:
        """Answer the page that sent a request, with values or an error."""
        message = protocol.write("answer", number=request.number, name=request.name, error=error, values=values)
        self._post(self.hub.send_to, request.client, message)

    def send_file(self, request: Request, name: str, content: bytes) -> None:
        """Send a file to the page that requested it."""
        self._post(self.hub.send_to, request.client, protocol.pack_file(name, content))

    # Frames of the pages, in the thread of the server

    def receive(self, client: int, channel: Channel, frame: str | bytes) -> None:
        """Check and process a frame from a page.

        Raises:
            ProtocolError: the frame is invalid.
        """
        message = protocol.read(frame)
        if isinstance(message, protocol.Ack):
            channel.acknowledge(message.sequence)
        elif isinstance(message, protocol.Seen):
            channel.seen(message.key, message.sequence)
        elif isinstance(message, protocol.Subscribe):
            channel.subscribe(message.keys)
        elif isinstance(message, protocol.Joints):
            if self.drive_lock.allows(client):
                self.inbox.put_joints({name: at for name, at in message.positions.items() if name in self.joints})
        elif isinstance(message, protocol.Axes):
            self.drive_lock.update(client, message)
        elif isinstance(message, protocol.Control):
            self._receive_control(client, message.action)
        else:
            self._receive_request(client, message)

    def _receive_control(self, client: int, action: str) -> None:
        """Queue a button; ``stop`` is accepted from every page, the others while no other page drives."""
        permission = PERMISSION_OF.get(action)
        if permission is None or permission in self.watchers_may or self.drive_lock.allows(client):
            self.inbox.put_action(action)
        else:
            refusal = protocol.write("notice", text=f"{action} rejected: {OTHER_DRIVES}", tone="error")
            self._post(self.hub.send_to, client, refusal)

    def _receive_request(self, client: int, raw: protocol.RawRequest) -> None:
        try:
            request = check(self.requests, client, raw)
        except protocol.ProtocolError as error:
            self.answer(Request(client, raw.number, raw.name, {}), str(error))
            raise
        permission = PERMISSION_OF.get(request.name, "change")
        if (
            self.requests[request.name].changes
            and permission not in self.watchers_may
            and not self.drive_lock.allows(client)
        ):
            self.answer(request, OTHER_DRIVES)
        elif not self.inbox.put_request(request):
            self.answer(request, "too many requests are waiting; try again in a moment")


def local_names(host: str) -> tuple[str, ...]:
    """Return the host names of this machine that other machines may use."""
    import socket

    name = socket.gethostname().lower()
    return (name, f"{name.split('.')[0]}.local", host.lower())
