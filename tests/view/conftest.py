"""A running server with a small scene, and clients that can misbehave."""

from __future__ import annotations

import http.client
import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from urllib.parse import urlsplit

import numpy as np
import pytest
import websocket

from tests.time_limit import PATIENCE
from urdfkit.description.urdf.robot import Box, Cylinder
from urdfkit.scene import Scene, Shape
from urdfkit.view.content.meshcat_objects import draw, link_path
from urdfkit.view.server.server import Server

JOINTS = [
    {"name": "lift", "type": "prismatic", "lower": 0.0, "upper": 0.3, "position": 0.1, "unit": "m", "mimic": None},
    {
        "name": "echo",
        "type": "prismatic",
        "lower": 0.0,
        "upper": 0.3,
        "position": 0.1,
        "unit": "m",
        "mimic": "lift",
        "multiplier": 1.0,
        "offset": 0.0,
    },
]


@pytest.fixture(scope="session", autouse=True)
def own_folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep the keys of servers on a port of their own out of the user's folder."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_RUNTIME_DIR", str(tmp_path_factory.mktemp("runtime")))
        yield


@pytest.fixture
def scene() -> Scene:
    return Scene(
        ("base", "mast"),
        (
            Shape("base/visual/0", "base", "visual", Box((0.4, 0.2, 0.1)), np.eye(4), (1.0, 0.5, 0.0, 1.0), True),
            Shape("mast/collision/0", "mast", "collision", Cylinder(0.02, 0.3), np.eye(4)),
        ),
    )


def show(server: Server, scene: Scene) -> None:
    server.show(
        name="toy",
        nodes=[link_path(body) for body in scene.bodies],
        joints=JOINTS,
        draw=lambda window: draw(scene, window, server.geometries),
    )


@pytest.fixture
def server(scene: Scene) -> Iterator[Server]:
    with Server("view", port=0) as running:
        running.drive_lock._clock = lambda: 0.0  # on a busy machine what a page sent may be silence before it is seen
        show(running, scene)
        yield running


@dataclass
class Answer:
    status: int
    headers: dict[str, str]
    body: bytes


@dataclass
class Client:
    """Speaks http to a server, with whatever headers a test likes."""

    server: Server
    cookie: str | None = None
    sockets: list[websocket.WebSocket] = field(default_factory=list)

    @property
    def host(self) -> str:
        return f"127.0.0.1:{self.server.port}"

    def get(self, path: str, *, method: str = "GET", **headers: str | None) -> Answer:
        connection = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=PATIENCE)
        try:
            own = {"Host": self.host, "Cookie": self.cookie} | {k.replace("_", "-"): v for k, v in headers.items()}
            connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
            for name, value in own.items():
                if value is not None:
                    connection.putheader(name, value)
            connection.endheaders()
            answer = connection.getresponse()
            return Answer(answer.status, {k.lower(): v for k, v in answer.getheaders()}, answer.read())
        finally:
            connection.close()

    def log_in(self) -> Client:
        answer = self.get("/?" + urlsplit(self.server.url).query)
        assert answer.status == 303
        self.cookie = answer.headers["set-cookie"].split(";")[0]
        return self

    def socket(self, **options: str | None) -> websocket.WebSocket:
        connected = websocket.create_connection(
            f"ws://127.0.0.1:{self.server.port}/ws",
            timeout=PATIENCE,
            **{"origin": f"http://{self.host}", "cookie": self.cookie, "host": self.host} | options,
        )
        self.sockets.append(connected)
        return connected


@pytest.fixture
def client(server: Server) -> Iterator[Client]:
    made = Client(server)
    yield made
    for connected in made.sockets:
        connected.shutdown()


@pytest.fixture
def page(client: Client) -> websocket.WebSocket:
    """A browser that is let in, without the browser."""
    return client.log_in().socket()


@pytest.fixture
def text() -> Callable[[websocket.WebSocket, str], dict]:
    """Returns the next text frame of a type; other frames are dropped."""

    def next_text(connected: websocket.WebSocket, wanted: str) -> dict:
        while True:
            frame = connected.recv()
            if isinstance(frame, str) and (message := json.loads(frame))["type"] == wanted:
                return message

    return next_text


@pytest.fixture
def poses() -> Callable[[websocket.WebSocket], bytes]:
    """Returns the next pose frame; other frames are dropped."""

    def next_poses(connected: websocket.WebSocket) -> bytes:
        while True:
            frame = connected.recv()
            if isinstance(frame, bytes) and frame[0] == 1:
                return frame

    return next_poses
