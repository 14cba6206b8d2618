"""Frames of the WebSocket and HTTP requests to the server of a simulation or of the viewer.

A case starts a server with its simulation or robot, connects two pages, and sends `FRAMES` changed frames in bursts.
The simulation executes the requests of each burst. The server must answer a valid request after each burst, may close
a connection only because of a malformed frame, and must log no exception.
"""

from __future__ import annotations

import io
import json
import logging
import os
import random
import socket
import struct
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, redirect_stderr
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

import websocket

from tests.bench.fuzz import mutations
from tests.bench.fuzz.frame_messages import sim_messages, view_messages
from urdfkit.errors import UrdfkitError
from urdfkit.view.protocol.websocket_messages import ProtocolError

if TYPE_CHECKING:
    from urdfkit.view.server.server import Server

FRAMES = 100
"""Frames of a case."""
BURST = 20
"""Frames between two executions of the requests."""
HTTP = 5
"""HTTP requests of a case."""
TIMEOUT = 20.0
"""Seconds to wait for the server."""
_STATUS = frozenset((101, 200, 206, 303, 304, 400, 403, 404, 405, 413, 414, 416, 426, 431))
Process = Callable[[], None]


class Errors(logging.Handler):
    """Keeps the records of errors, such as exceptions of a handler."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.texts: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a record."""
        self.texts.append(logging.Formatter().format(record))


def frames(folder: Path, rng: random.Random) -> Counter[str]:
    """Send changed frames and HTTP requests to a server; return the number of frames by their result."""
    before = Path.cwd()
    os.chdir(folder)  # a long recording is written to the working directory
    errors, log = Errors(), logging.getLogger()
    level = log.level
    log.addHandler(errors)
    try:
        log.setLevel(logging.ERROR)
        serving = _simulation if rng.random() < 0.75 else _viewer
        with redirect_stderr(io.StringIO()), serving(rng) as (server, messages, process):
            counts = _counted(server)
            for _ in range(HTTP):
                _request(server, rng)
            _send(server, messages, process, rng, counts)
    except UrdfkitError as error:  # no frame may end the simulation
        raise AssertionError(str(error)) from error
    finally:
        log.removeHandler(errors)
        log.setLevel(level)
        os.chdir(before)
    if errors.texts:
        raise AssertionError("\n".join(errors.texts))
    return counts


@contextmanager
def _simulation(rng: random.Random) -> Iterator[tuple[Server, list[dict[str, Any]], Process]]:
    from urdfkit.app.simulation.clock_rate import FRAME
    from urdfkit.app.simulation.loop import DriveLoop
    from urdfkit.sim import Simulator
    from urdfkit.view.server.server import PERMISSIONS, Server

    seconds = 0.0
    name = rng.choice(("simpleton", "rrbot", "seven_dof_arm"))
    simulator = Simulator(name, world=rng.choice(("empty", "cylinders")), note=lambda _: None)
    with Server("sim", port=0, watchers_may=rng.choice(((), PERMISSIONS))) as server:
        loop = DriveLoop(simulator, server, clock=lambda: seconds, sleep=lambda _: None)
        loop.show()
        loop.sensor_views.find()

        def process() -> None:
            nonlocal seconds
            seconds += FRAME
            loop.tick()

        try:
            yield server, sim_messages(simulator, server), process
        finally:
            loop.replay.close()


@contextmanager
def _viewer(rng: random.Random) -> Iterator[tuple[Server, list[dict[str, Any]], Process]]:
    from urdfkit.app.viewer.findings_panel import FindingsPanel
    from urdfkit.app.viewer.session import Session, request_schemas
    from urdfkit.app.viewer.shown_robot import ShownRobot
    from urdfkit.resources import find_model
    from urdfkit.view.server.server import Server

    model = find_model([rng.choice(("simpleton", "rrbot"))])
    shown = ShownRobot.read(model)
    with Server("view", port=0, requests=request_schemas()) as server:
        session = Session(server, model, shown, FindingsPanel(model, may_write=False))
        session.show()
        session.lint()
        yield server, view_messages(session), lambda: session.process(server.inbox.take())


def _counted(server: Server) -> Counter[str]:
    """Count the results of the frames that a server receives."""
    counts: Counter[str] = Counter()
    receive, answer = server.receive, server.answer

    def counted(*arguments: Any) -> None:
        try:
            receive(*arguments)
        except ProtocolError:
            counts["dropped"] += 1
            raise
        counts["accepted"] += 1

    def answered(request: Any, error: str | None = None, **values: Any) -> None:
        assert error is None or "\n" not in error, f"an answer of several lines: {error}"
        counts["request refused" if error else "request executed"] += 1
        answer(request, error, **values)

    server.receive = counted  # type: ignore[method-assign]
    server.answer = answered  # type: ignore[method-assign]
    return counts


def _connect(server: Server) -> websocket.WebSocket:
    host = f"127.0.0.1:{server.port}"
    cookie = f"{server.access.cookie}={server.access.session}"
    return websocket.create_connection(f"ws://{host}/ws", timeout=TIMEOUT, origin=f"http://{host}", cookie=cookie)


def _send(
    server: Server, messages: list[dict[str, Any]], process: Process, rng: random.Random, counts: Counter[str]
) -> None:
    with ExitStack() as stack:
        pages = [_connect(server), _connect(server)]
        stack.callback(lambda: [page.shutdown() for page in pages])
        for burst in range(FRAMES // BURST):
            for _ in range(BURST):
                k = 0 if rng.random() < 0.8 else 1
                page = pages[k]
                try:
                    page.sock.sendall(_wire(mutations.frame(rng.choice(messages), rng), rng))
                except OSError:  # the server has closed it
                    counts["closed"] += 1
                    page.shutdown()
                    pages[k] = _connect(server)
            process()
            for k, page in enumerate(pages):
                if not _answers(page, 10**6 + burst):
                    counts["closed"] += 1
                    page.shutdown()
                    pages[k] = _connect(server)
                    assert _answers(pages[k], 10**6 + burst), "a new connection gets no answer"


def _answers(page: websocket.WebSocket, number: int) -> bool:
    """Return whether the server answers an unknown request, which it refuses; False if the connection is closed."""
    try:
        page.send(json.dumps({"type": "request", "number": number, "name": "unknown", "values": {}}))
        while True:
            frame = page.recv()
            if isinstance(frame, str) and frame:
                message = json.loads(frame, parse_constant=_reject)
                if message["type"] == "answer" and message["number"] == number:
                    return True
            elif frame in ("", b"") and not page.connected:
                return False
    except websocket.WebSocketTimeoutException:
        raise AssertionError(f"no answer within {TIMEOUT:g} s") from None
    except (websocket.WebSocketException, OSError, UnicodeDecodeError):
        return False


def _reject(constant: str) -> None:
    raise AssertionError(f"the server sent {constant}")


def _wire(frame: str | bytes, rng: random.Random) -> bytes:
    """Return a frame of the WebSocket as bytes, sometimes in fragments, and sometimes malformed."""
    content = frame if isinstance(frame, bytes) else frame.encode("utf-8", "surrogatepass")
    opcode = 2 if isinstance(frame, bytes) else 1
    kind = rng.random()
    if kind < 0.94:
        return _packed(content, opcode)
    if kind < 0.96:
        half = len(content) // 2
        return _packed(content[:half], opcode, last=False) + _packed(content[half:], 0)
    if kind < 0.97:
        return _packed(content[:100], rng.choice((8, 9, 10)))
    packed = _packed(content, rng.randrange(16), last=rng.random() < 0.5, reserved=rng.randrange(8))
    return mutations.binary(packed, rng) if rng.random() < 0.5 else packed


def _packed(content: bytes, opcode: int, *, last: bool = True, reserved: int = 0) -> bytes:
    """Return a masked frame; RFC 6455, section 5.2. With the mask 0 the content stays as it is."""
    first, size = last << 7 | reserved << 4 | opcode, len(content)
    if size < 126:
        head = struct.pack("!BB", first, 0x80 | size)
    elif size < 1 << 16:
        head = struct.pack("!BBH", first, 0x80 | 126, size)
    else:
        head = struct.pack("!BBQ", first, 0x80 | 127, size)
    return head + bytes(4) + content


def _request(server: Server, rng: random.Random) -> None:
    """Send a changed HTTP request; the response, if one comes, has an expected status."""
    host, access = f"127.0.0.1:{server.port}", server.access
    paths = ("/", "/?" + urlsplit(server.url).query, "/frame?" + urlsplit(server.url).query, "/app/app.js", "/ws")
    path = rng.choice((*paths, "/geometry/" + "0" * 64, "/app/../../../etc/passwd", "/%00", "//", "/app/%2e%2e/x"))
    lines = [
        f"{rng.choice(('GET', 'GET', 'GET', 'HEAD', 'POST', 'OPTIONS', 'x'))} {path} HTTP/1.1",
        f"Host: {host}",
        f"Cookie: {access.cookie}={access.session}",
        f"Origin: http://{host}",
        *rng.sample((*_HEADERS, f"Content-Length: {rng.choice((0, 10, -1, 10**9, 'x'))}"), rng.randrange(4)),
    ]
    content = ("\r\n".join(lines) + "\r\n\r\n").encode()
    if rng.random() < 0.5:
        content = mutations.binary(content, rng) if rng.random() < 0.5 else mutations.words(content, rng)
    with socket.create_connection(("127.0.0.1", server.port), timeout=TIMEOUT) as line:
        try:
            line.sendall(content)
            line.shutdown(socket.SHUT_WR)
            answer = line.recv(4096)
        except OSError:  # closed by the server
            return
    answer = answer.removeprefix(b"HTTP/1.1 100 (Continue)\r\n\r\n")
    if answer:
        assert answer.startswith(b"HTTP/1.1 "), answer[:100]
        assert int(answer[9:12]) in _STATUS, f"{content[:300]!r}: {answer[:100]!r}"


_HEADERS = (
    "Upgrade: websocket",
    "Connection: Upgrade",
    "Connection: close",
    "Sec-WebSocket-Version: 13",
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
    "Sec-WebSocket-Extensions: permessage-deflate",
    "Transfer-Encoding: chunked",
    "Accept-Encoding: gzip",
    "Range: bytes=0-1",
    "If-None-Match: *",
    "If-Modified-Since: x",
    "Expect: 100-continue",
    "Origin: null",
    "Host: evil.example",
    "Content-Type: multipart/form-data; boundary=x",
)
