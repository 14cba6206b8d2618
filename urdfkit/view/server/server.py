"""Server: tornado in a background thread; the caller's thread shows scenes, publishes poses, takes wishes."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any

from tornado.httpserver import HTTPServer

from urdfkit.view.content.mesh_store import GeometryStore
from urdfkit.view.protocol import websocket_messages as protocol
from urdfkit.view.protocol.page_requests import Order, Schema, check
from urdfkit.view.server.access_control import LOOPBACK_NAMES, Gate, is_loopback
from urdfkit.view.server.broadcast import Hub, pack
from urdfkit.view.server.drive_lock import Driver
from urdfkit.view.server.http_handlers import application
from urdfkit.view.server.listen_address import bind, urls
from urdfkit.view.server.rejection_log import Refusals
from urdfkit.view.server.request_inbox import Inbox
from urdfkit.view.server.saved_tokens import keys_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from tornado.web import Application

    from urdfkit.view.server.send_queue import Channel


class Server:
    """The page and its websocket.

    Every method may be called from the caller's thread at any time; none waits for a browser.

    Args:
        mode: ``view`` (sliders move joints) or ``sim`` (keys drive).
        host: address to bind; anything but loopback lets the network in.
        port: port to bind, 0 for any; None for the first free one from the usual one on.
        settings: further values for the page's first message.
        orders: what pages may order, beside what the protocol has anyway.

    Raises:
        UsageError: the port is busy or the address cannot be bound.
    """

    def __init__(
        self,
        mode: str,
        *,
        host: str = "127.0.0.1",
        port: int | None = None,
        settings: dict[str, Any] | None = None,
        orders: Mapping[str, Schema] | None = None,
    ) -> None:
        self._socket, self.port = bind(host, port)
        loopback = is_loopback(host)
        names = LOOPBACK_NAMES if loopback else (*LOOPBACK_NAMES, *local_names(host))
        # A port that is any port is another one the next time: there is nobody to know again.
        secrets = {} if port == 0 else keys_of(self.port)
        self.gate = Gate(self.port, names=names, open_to_network=not loopback, **secrets)
        self.urls = urls(host, self.port, self.gate.token)
        self.inbox = Inbox()
        self.driver = Driver()
        self.hub = Hub()
        self.refusals = Refusals()
        self.geometries = GeometryStore()
        self.joints: frozenset[str] = frozenset()
        self.mode = mode
        self.orders: dict[str, Schema] = dict(orders or {})
        self._seen = itertools.count(1)
        self._model = itertools.count(1)
        self._model_number = 0
        self._sequence = 0
        self._latest: tuple[int, bytes] | None = None
        self._latest_lock = threading.Lock()
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._serve, name="urdfkit-view", daemon=True)
        self._started: Future[None] = Future()
        self.hub.lasting("hello", protocol.write("hello", protocol=protocol.VERSION, mode=mode, **(settings or {})))

    @property
    def url(self) -> str:
        """The address to open, with the token."""
        return self.urls[0]

    def start(self) -> None:
        """Begin to serve."""
        self._thread.start()
        self._started.result()

    def stop(self) -> None:
        """Close all connections and end the thread; stopping twice is harmless."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._loop.stop)
            self._thread.join()
        self._socket.close()
        if not self._loop.is_closed():
            self._loop.close()

    def __enter__(self) -> Server:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    # What the caller shows

    def send(self, command: Any) -> None:
        """Send a meshcat command: this makes the server the ``window`` of a ``meshcat.Visualizer``."""
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
            name: the robot's.
            nodes: scene paths that poses move, in the order of the rows of `publish`.
            joints: what the joint panel needs of each joint: name, type, lower, upper, position, mimic.
            root: which of the nodes is the root link.
            draw: sends the scene's commands through `send`, its meshes into `geometries`.
        """
        self._model_number = next(self._model)
        self.joints = frozenset(joint["name"] for joint in joints if not joint.get("mimic"))
        self._post(self.hub.forget_poses)
        draw(self)
        message = protocol.write(
            "model", number=self._model_number & 0xFF, name=name, root=root, nodes=list(nodes), joints=list(joints)
        )
        self._post(self.hub.lasting, "model", message)

    def publish(self, time: float, poses: NDArray[np.floating[Any]]) -> None:
        """Send poses to all browsers; costs the caller microseconds, however many watch.

        Args:
            time: simulated time [s].
            poses: shape (n, 7) in the order of the nodes shown, position [m] and quaternion x, y, z, w.
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
        """Send what a source sees to who wants its key, until the next from it; see `pack_sensed`."""
        sequence = next(self._seen) & 0xFFFFFFFF
        self._post(self.hub.view, key, sequence, protocol.pack_sensed(index, time, kind, content, sequence))

    def tell(self, type: str, **values: Any) -> None:
        """Send a text that matters only until the next of its type, such as ``status``."""
        self._post(self.hub.news, type, protocol.write(type, **values))

    def declare(self, type: str, **values: Any) -> None:
        """Send a text that holds until the next of its type; pages that open later get it too."""
        self._post(self.hub.lasting, type, protocol.write(type, **values))

    def tell_who_wants(self, key: str, type: str, **values: Any) -> None:
        """Send a text to who wants its key; it matters only until the next."""
        self._post(self.hub.news_for, key, protocol.write(type, **values))

    def stream(self, key: str, type: str, **values: Any) -> None:
        """Send a part of something that goes on to who wants its key."""
        self._post(self.hub.stream, key, protocol.write(type, **values))

    def answer(self, order: Order, error: str | None = None, **values: Any) -> None:
        """Tell the page that ordered something that it is done, or why not."""
        message = protocol.write("answer", number=order.number, order=order.name, error=error, values=values)
        self._post(self.hub.tell, order.client, message)

    def hand_over(self, order: Order, name: str, content: bytes) -> None:
        """Give a file to the page that ordered it."""
        self._post(self.hub.tell, order.client, protocol.pack_file(name, content))

    # What the pages say, in the server's thread

    def heard(self, client: int, channel: Channel, frame: str | bytes) -> None:
        """Check a frame from a page and pass it on.

        Raises:
            ProtocolError: it makes no sense.
        """
        wish = protocol.read(frame)
        if isinstance(wish, protocol.Ack):
            channel.acknowledge(wish.sequence)
        elif isinstance(wish, protocol.Seen):
            channel.seen(wish.key, wish.sequence)
        elif isinstance(wish, protocol.Watch):
            channel.want(wish.wanted)
        elif isinstance(wish, protocol.Joints):
            self.inbox.put_joints({name: value for name, value in wish.positions.items() if name in self.joints})
        elif isinstance(wish, protocol.Axes):
            self.driver.offer(client, wish)
        elif isinstance(wish, protocol.Control):
            self.inbox.put_action(wish.action)
        else:
            self._ordered(client, wish)

    def _ordered(self, client: int, wish: protocol.Do) -> None:
        try:
            order = check(self.orders, client, wish)
        except protocol.ProtocolError as error:
            self.answer(Order(client, wish.number, wish.order, {}), str(error))
            raise
        if self.orders[order.name].changes and not self.driver.may(client):
            self.answer(order, "somebody else is driving; wait until they let go")
        elif not self.inbox.put_order(order):
            self.answer(order, "too much is waiting to be done; try again in a moment")

    # The thread

    def _post(self, function: Callable[..., None], *arguments: Any) -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed: nobody is left to tell
            self._loop.call_soon_threadsafe(function, *arguments)

    def _serve(self) -> None:
        asyncio.set_event_loop(self._loop)
        try:
            http = self._loop.run_until_complete(self._open())
        except BaseException as error:
            self._started.set_exception(error)
            return
        self._started.set_result(None)
        try:
            self._loop.run_forever()
        finally:
            self._loop.run_until_complete(self._close(http))

    async def _open(self) -> HTTPServer:
        app: Application = application(self)
        http = HTTPServer(
            app, max_header_size=16 * 1024, max_body_size=protocol.MAX_INBOUND, idle_connection_timeout=60
        )
        http.add_socket(self._socket)
        return http

    async def _close(self, http: HTTPServer) -> None:
        http.stop()
        tasks = [task for task in asyncio.all_tasks() if task is not asyncio.current_task()]
        with contextlib.suppress(TimeoutError, asyncio.TimeoutError):
            await asyncio.wait_for(http.close_all_connections(), timeout=1.0)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


def local_names(host: str) -> tuple[str, ...]:
    """Return the names under which the network may address this machine."""
    import socket

    name = socket.gethostname().lower()
    return (name, f"{name.split('.')[0]}.local", host.lower())
