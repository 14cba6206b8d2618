"""HTTP routes: the page, its files, meshes, textures and the WebSocket."""

import gzip
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path

from tornado.ioloop import IOLoop
from tornado.web import Application, HTTPError

from urdfkit.errors import MissingDependencyError
from urdfkit.view.content.mesh_store import EDGES
from urdfkit.view.protocol import websocket_messages
from urdfkit.view.server.authenticated_handler import NO_COOKIE, AuthenticatedHandler, headers
from urdfkit.view.server.page_socket import PageSocket
from urdfkit.view.server.server_interface import PageServer

PING = 5.0
"""Seconds between pings; a browser that has not answered one before the next is disconnected."""

APP = Path(__file__).parents[1] / "app"
TYPES = {
    ".css": "text/css",
    ".html": "text/html",
    ".js": "text/javascript",
    ".svg": "image/svg+xml",
    ".webp": "image/webp",
}
MESHCAT = "meshcat.js"
OFFLINE = "connection/offline.js"
"""The module that only a page in a single file loads first."""
WORKER = "connection/socket_worker.js"
"""The script of the page's worker, which is no module of the page."""


def application(server: PageServer) -> Application:
    """Return the tornado application of a server."""
    files = {path.relative_to(APP).as_posix(): path for path in APP.rglob("*") if path.suffix in TYPES}
    files[MESHCAT] = meshcat_bundle()
    return Application(
        [
            (r"/", PageHandler, {"server": server}),
            (r"/frame", FramedPage, {"server": server}),
            (r"/app/([\w./-]+)", AppFile, {"server": server}),
            (r"/geometry/([0-9a-f]{64})", GeometryHandler, {"server": server}),
            (r"/texture/([0-9a-f]{64})", TextureHandler, {"server": server}),
            (r"/ws", PageSocket, {"server": server}),
        ],
        default_handler_class=NotFound,
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


class NotFound(AuthenticatedHandler):
    """All other paths."""

    def prepare(self) -> None:
        """Respond with 404, but only to authenticated requests."""
        super().prepare()
        if not self._finished:
            raise HTTPError(404)


CONTINUE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>urdfkit</title>
<meta http-equiv="refresh" content="0; url=/"><p><a href="/">Continue to urdfkit</a></p></html>"""


class PageHandler(AuthenticatedHandler):
    """The page. With the token in the URL it sets the cookie and redirects to the URL without the token."""

    open_to_all = True

    def get(self) -> None:
        """Serve the page."""
        if self.get_query_arguments("token"):
            if not self.has_token:
                self.reject("The token in the address is wrong. Each start of urdfkit may create a new one.")
                return
            self.set_cookie(
                self.access.cookie, self.access.session, expires_days=None, path="/", httponly=True, samesite="Strict"
            )
            if self.request.headers.get("Sec-Fetch-Site") == "cross-site":
                # After a redirect of such a request, the browser would not send the cookie, which is SameSite=Strict.
                self.set_header("Content-Type", "text/html; charset=utf-8")
                self.finish(CONTINUE)
            else:
                self.redirect("/", status=303)
        elif not self.access.accepts_session(self.get_cookie(self.access.cookie)):
            self.reject(NO_COOKIE)
        else:
            self.set_header("Content-Type", "text/html; charset=utf-8")
            self.finish(page())


class FramedPage(AuthenticatedHandler):
    """The page for a frame of a notebook; only a page with the token can embed it, which prevents clickjacking."""

    open_to_all = True

    def get(self) -> None:
        """Serve the page; the token stays in its address, and the page sends it with its requests."""
        if not self.has_token:
            self.reject("The token in the address is missing or wrong. Each start of urdfkit may create a new one.")
            return
        for name, value in headers(self.host, framed=True).items():
            self.set_header(name, value)
        self.clear_header("X-Frame-Options")
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.finish(page())


def page() -> str:
    """Return the page with all its modules preloaded, so that a browser need not discover them one by one."""
    text = (APP / "index.html").read_text("utf-8")
    modules = {path.relative_to(APP).as_posix() for path in APP.rglob("*.js")} - {OFFLINE, WORKER}
    links = "".join(f'  <link rel="modulepreload" href="/app/{name}">\n' for name in sorted(modules))
    return text.replace("</head>", f"{links}</head>", 1)


@lru_cache(maxsize=256)
def packed(path: Path, _changed: int) -> bytes:
    """Return a file compressed by gzip; the second argument, its modification time, makes the cache follow changes."""
    return gzip.compress(path.read_bytes(), 6, mtime=0)


class AppFile(AuthenticatedHandler):
    """The files of the page, from a list made at the start: the path in a request is never used as a file path."""

    open_to_all = True  # they contain no secrets, and the page for rejected requests needs its style

    @property
    def files(self) -> dict[str, Path]:
        """Path relative to the folder → file."""
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


class GeometryHandler(AuthenticatedHandler):
    """A mesh by the hash of its content."""

    async def get(self, name: str) -> None:
        """Serve one mesh, packed in another thread so that poses are sent meanwhile."""
        packed = await IOLoop.current().run_in_executor(None, self.server.geometries.get, name)
        if packed is None:
            raise HTTPError(404)
        if "gzip" in self.request.headers.get("Accept-Encoding", ""):
            self.set_header("Content-Encoding", "gzip")
        else:
            packed = gzip.decompress(packed)
        send_immutable(self, "application/octet-stream", packed)


class TextureHandler(AuthenticatedHandler):
    """A texture by the hash of its content."""

    async def get(self, name: str) -> None:
        """Serve one texture; ``edge`` is the largest length of its edges in pixels."""
        edge = self.get_query_argument("edge", str(EDGES[-1]))
        if edge not in map(str, EDGES):
            raise HTTPError(404)
        image = await IOLoop.current().run_in_executor(None, self.server.geometries.image, name, int(edge))
        if image is None:
            raise HTTPError(404)
        send_immutable(self, "image/webp", image)


def send_immutable(handler: AuthenticatedHandler, kind: str, content: bytes) -> None:
    """Send content that browsers may keep, because the name is a hash of it."""
    handler.set_header("Content-Type", kind)
    handler.set_header("Cache-Control", "private, max-age=31536000, immutable")
    handler.finish(content)
