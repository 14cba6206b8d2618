"""Export of the page to one HTML file with all its modules and messages, which opens without a server."""

import base64
import hashlib
import json
import posixpath
import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.view.content.mesh_store import GeometryStore
from urdfkit.view.protocol import websocket_messages as protocol
from urdfkit.view.server.broadcast import pack
from urdfkit.view.server.http_handlers import APP, OFFLINE, meshcat_bundle

_IMPORT = re.compile(r"""(\bfrom\s*|\bimport\s*)(["'])(\.\.?/[\w./-]+\.js)\2""")
_COMMENT = re.compile(r"^[ \t]*(?:/\*.*?\*/|//[^\n]*)[ \t]*\n", re.DOTALL | re.MULTILINE)
_PREFIX = "urdfkit/"


class Recording:
    """Records the messages of a `Server`, as far as a new browser would receive them."""

    def __init__(self) -> None:
        self.geometries = GeometryStore()
        self._commands: dict[tuple[str, str], bytes] = {}
        self._texts: dict[str, str] = {"hello": protocol.write("hello", protocol=protocol.VERSION, mode="view")}
        self._poses: bytes | None = None

    def send(self, command: Any) -> None:
        """Record a meshcat command."""
        path, slot, packed = pack(command)
        if slot is None:
            self._commands = {key: kept for key, kept in self._commands.items() if not _below(key[0], path)}
        else:
            self._commands[path, slot] = packed

    def show(
        self,
        *,
        name: str,
        nodes: Sequence[str],
        joints: Sequence[dict[str, Any]] = (),
        root: int = 0,
        draw: Callable[[Any], None],
    ) -> None:
        """Replace the scene; see `Server.show`."""
        draw(self)
        self.publish_latched("model", number=1, name=name, root=root, nodes=list(nodes), joints=list(joints))

    def publish(self, time: float, poses: NDArray[np.float64]) -> None:
        """Record the poses of the links, shape (n, 7)."""
        self._poses = protocol.pack_poses(1, time, poses, model=1)

    def publish_latched(self, type: str, **values: Any) -> None:
        """Record a message."""
        self._texts[type] = protocol.write(type, **values)

    broadcast = publish_latched

    def html(self) -> str:
        """Return the page.

        Raises:
            MissingDependencyError: meshcat is not installed.
        """
        recording = {
            "commands": [_base64(packed) for packed in self._commands.values()],
            "texts": list(self._texts.values()),
            "poses": _base64(self._poses) if self._poses is not None else None,
            "meshes": {name: _base64(packed) for name, packed in self.geometries},
            "textures": {name: _base64(image) for name, image in self.geometries.images},
        }
        modules = {path.relative_to(APP).as_posix(): path.read_text("utf-8") for path in sorted(APP.rglob("*.js"))}
        imports = {_PREFIX + name: _address("text/javascript", _bare(name, text)) for name, text in modules.items()}
        start = f'import "{_PREFIX}{OFFLINE}";\nimport "{_PREFIX}app.js";\n'
        scripts = [
            ("", meshcat_bundle().read_text("utf-8")),
            (' type="application/json" id="recording"', _json(recording)),
            (' type="importmap"', _json({"imports": imports})),
            (' type="module"', start),
        ]
        page = (APP / "index.html").read_text("utf-8")
        page = re.sub(r"\s*<script\b[^>]*></script>", "", page)
        page = re.sub(r'<link rel="stylesheet" href="/app/([\w/-]+\.css)">', _style, page)
        page = page.replace("/app/icon.svg", _address("image/svg+xml", (APP / "icon.svg").read_text("utf-8")))
        head = f'<meta http-equiv="Content-Security-Policy" content="{_policy([text for _, text in scripts])}">'
        page = page.replace('<meta charset="utf-8">', f'<meta charset="utf-8">\n  {head}', 1)
        written = "\n".join(f"<script{kind}>{_inline(text)}</script>" for kind, text in scripts)
        before, _, after = page.rpartition("</body>")
        return f"{before}{written}\n</body>{after}"


def _below(path: str, above: str) -> bool:
    return path == above or path.startswith(f"{above}/")


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode("ascii")


def _address(kind: str, text: str) -> str:
    return f"data:{kind};base64,{_base64(text.encode())}"


def _json(value: Any) -> str:
    return json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")


def _bare(name: str, text: str) -> str:
    """Return a module without comments on lines of their own, its relative imports as names of the import map."""

    def bare(found: re.Match[str]) -> str:
        path = posixpath.normpath(posixpath.join(posixpath.dirname(name), found[3]))
        return f"{found[1]}{found[2]}{_PREFIX}{path}{found[2]}"

    return _IMPORT.sub(bare, _COMMENT.sub("", text))


def _style(found: re.Match[str]) -> str:
    return f"<style>\n{(APP / found[1]).read_text('utf-8')}</style>"


def _inline(text: str) -> str:
    """Return a script with its end tags escaped, for use in a page."""
    return re.sub(r"</(?=script)", r"<\\/", text, flags=re.IGNORECASE)


def _policy(scripts: Sequence[str]) -> str:
    """Return the content security policy of the page: only these scripts, and no external resources."""
    digests = [hashlib.sha256(_inline(text).encode()).digest() for text in scripts]
    hashes = " ".join(f"'sha256-{_base64(digest)}'" for digest in digests)
    return (
        f"default-src 'none'; script-src {hashes} data:; style-src 'unsafe-inline'; img-src data: blob:; "
        "media-src blob:; base-uri 'none'; form-action 'none'"
    )
