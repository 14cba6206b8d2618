"""The http and websocket side: which request gets what."""

from __future__ import annotations

import gzip
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from tornado.web import Application, HTTPError

from urdfkit.errors import MissingDependencyError
from urdfkit.view.protocol import websocket_messages
from urdfkit.view.server.access_control import headers
from urdfkit.view.server.authenticated_handler import Guarded
from urdfkit.view.server.websocket import Socket

if TYPE_CHECKING:
    from urdfkit.view.server.page_server import PageServer

PING = 5.0
"""Seconds between pings; a browser that does not answer one before the next is gone."""

APP = Path(__file__).parents[1] / "app"
TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
MESHCAT = "meshcat.js"
OFFLINE = "page/offline.js"
"""The module that only a page in one file begins with."""


def application(server: PageServer) -> Application:
    """Return the tornado application of a server."""
    files = {path.relative_to(APP).as_posix(): path for path in APP.rglob("*") if path.suffix in TYPES}
    files[MESHCAT] = meshcat_bundle()
    return Application(
        [
            (r"/", Page, {"server": server}),
            (r"/frame", FramedPage, {"server": server}),
            (r"/app/([\w./-]+)", AppFile, {"server": server}),
            (r"/geometry/([0-9a-f]{64})", Geometry, {"server": server}),
            (r"/ws", Socket, {"server": server}),
        ],
        default_handler_class=Nothing,
        default_handler_args={"server": server},
        files=files,
        compress_response=True,
        websocket_max_message_size=websocket_messages.MAX_INBOUND,
        websocket_ping_interval=PING,
        log_function=lambda handler: None,
    )


def meshcat_bundle() -> Path:
    """Return meshcat's JavaScript, without importing meshcat.

    Raises:
        MissingDependencyError: meshcat is not installed.
    """
    spec = find_spec("meshcat")
    if spec is None or not spec.submodule_search_locations:
        raise MissingDependencyError("view needs meshcat: pip install 'urdfkit[view]'")
    return Path(spec.submodule_search_locations[0]) / "viewer" / "dist" / "main.min.js"


class Nothing(Guarded):
    """Every other path."""

    def prepare(self) -> None:
        """Answer 404, but only to those let in."""
        super().prepare()
        if not self._finished:
            raise HTTPError(404)


class Page(Guarded):
    """The page. With the token in the address it sets the cookie and sends the browser to the bare address."""

    open_to_all = True

    def get(self) -> None:
        """Serve the page."""
        if self.get_query_arguments("token"):
            if not self.has_token:
                self.refuse("The key in the address is wrong: it changes whenever urdfkit is started.")
                return
            self.set_cookie(
                self.gate.cookie, self.gate.session, expires_days=None, path="/", httponly=True, samesite="Strict"
            )
            self.redirect("/", status=303)
        elif not self.gate.session_fits(self.get_cookie(self.gate.cookie)):
            self.refuse("This browser has not sent the token yet, or urdfkit has been restarted since.")
        else:
            self.set_header("Content-Type", "text/html; charset=utf-8")
            self.finish(page())


class FramedPage(Guarded):
    """The page for a frame of a notebook; only who knows the token can embed it, which prevents clickjacking."""

    open_to_all = True

    def get(self) -> None:
        """Serve the page; the token stays in its address, and the page sends it with its requests."""
        if not self.has_token:
            self.refuse("The token in the address is missing or wrong: it changes whenever urdfkit is started.")
            return
        for name, value in headers(self.host, framed=True).items():
            self.set_header(name, value)
        self.clear_header("X-Frame-Options")
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.finish(page())


def page() -> str:
    """Return the page, with all its modules named at the top, so that a browser need not find one through another."""
    text = (APP / "index.html").read_text("utf-8")
    modules = {path.relative_to(APP).as_posix() for path in APP.rglob("*.js")} - {OFFLINE}
    links = "".join(f'  <link rel="modulepreload" href="/app/{name}">\n' for name in sorted(modules))
    return text.replace("</head>", f"{links}</head>", 1)


@lru_cache(maxsize=256)
def packed(path: Path, _changed: int) -> bytes:
    """Return a file as gzip packs it; the second argument is when it was changed, so that an old one is not kept."""
    return gzip.compress(path.read_bytes(), 6, mtime=0)


class AppFile(Guarded):
    """The page's own files, from a list made at the start: nothing is looked up by the path in a request."""

    open_to_all = True  # nothing in them is anybody's secret, and the refusal page wants its style

    @property
    def files(self) -> dict[str, Path]:
        """Path below the folder → file."""
        found: dict[str, Path] = self.settings["files"]
        return found

    def get(self, name: str) -> None:
        """Serve one file."""
        path = self.files.get(name)
        if path is None:
            raise HTTPError(404)
        self.set_header("Content-Type", f"{TYPES[path.suffix]}; charset=utf-8")
        if "gzip" in self.request.headers.get("Accept-Encoding", ""):
            self.set_header("Content-Encoding", "gzip")
            self.finish(packed(path, path.stat().st_mtime_ns))
        else:
            self.finish(path.read_bytes())


class Geometry(Guarded):
    """A mesh by the hash of its content."""

    def get(self, name: str) -> None:
        """Serve one mesh."""
        packed = self.server.geometries.get(name)
        if packed is None:
            raise HTTPError(404)
        self.set_header("Content-Type", "application/octet-stream")
        self.set_header("Cache-Control", "private, max-age=31536000, immutable")  # its name is its content
        self.finish(packed)
