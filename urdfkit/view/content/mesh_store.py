"""Triangle meshes and textures for the browser, addressed by the hash of their content."""

import hashlib
import io
from collections.abc import Collection, Iterator
from threading import Lock

from urdfkit.meshes.simplification import simplified
from urdfkit.meshes.textures import Texture
from urdfkit.scene import TriMesh
from urdfkit.view.content.mesh_encoding import FORMAT, pack

EDGES = (512, 1024, 2048)
"""Largest edge lengths of textures that a browser can request [px]."""

QUALITY = 90
"""Quality of compressed textures, of 100."""


class GeometryStore:
    """Meshes and textures by content hash. Written by the thread of the caller, read by the threads of the server.

    A mesh is packed when a browser requests it, so that a hidden collision shape costs nothing.
    """

    def __init__(self) -> None:
        self._meshes: dict[str, TriMesh] = {}
        self._kept: set[str] = set()
        self._packed: dict[str, bytes] = {}
        self._textures: dict[str, Texture] = {}
        self._images: dict[tuple[str, int], bytes] = {}
        self._lock = Lock()

    def add(self, mesh: TriMesh, *, keep: bool = False) -> str:
        """Store a mesh unless it is already stored; return its name, 64 hexadecimal digits.

        Args:
            mesh: the mesh.
            keep: `keep_only` does not remove it.
        """
        name = _name(mesh.hash)
        if keep:
            self._kept.add(name)
        self._meshes.setdefault(name, mesh)
        for texture in mesh.textures:
            self._textures.setdefault(_name(texture.hash), texture)
        return name

    def get(self, name: str) -> bytes | None:
        """Return a mesh, compressed with gzip; None if it is unknown. See `mesh_encoding`."""
        mesh = self._meshes.get(name)
        if mesh is None:
            return None
        with self._lock:
            packed = self._packed.get(name)
            if packed is None:
                packed = self._packed[name] = pack(simplified(mesh), [_name(texture.hash) for texture in mesh.textures])
        return packed

    def image(self, name: str, edge: int = EDGES[-1]) -> bytes | None:
        """Return a texture as WebP file, its longer edge at most `edge` pixels; None if it is unknown."""
        texture = self._textures.get(name)
        if texture is None:
            return None
        with self._lock:
            image = self._images.get((name, edge))
            if image is None:
                image = self._images[name, edge] = _encoded(texture, edge)
        return image

    def keep_only(self, names: Collection[str]) -> None:
        """Remove all other meshes, and the textures that only they use."""
        names = {*names, *self._kept}
        self._meshes = {name: mesh for name, mesh in self._meshes.items() if name in names}
        self._packed = {name: packed for name, packed in self._packed.items() if name in names}
        used = {_name(texture.hash) for mesh in self._meshes.values() for texture in mesh.textures}
        self._textures = {name: texture for name, texture in self._textures.items() if name in used}
        self._images = {key: image for key, image in self._images.items() if key[0] in used}

    def __len__(self) -> int:
        return len(self._meshes)

    def __iter__(self) -> Iterator[tuple[str, bytes]]:
        """Yield names and packed meshes."""
        for name in tuple(self._meshes):
            if (packed := self.get(name)) is not None:
                yield name, packed

    @property
    def images(self) -> Iterator[tuple[str, bytes]]:
        """Names and images of all textures."""
        for name in tuple(self._textures):
            if (image := self.image(name)) is not None:
                yield name, image


def _name(digest: str) -> str:
    return hashlib.sha256(f"{FORMAT} {digest}".encode()).hexdigest()


def _encoded(texture: Texture, edge: int) -> bytes:
    from PIL import Image

    picture = Image.fromarray(texture.pixels)
    if texture.pixels[..., 3].min(initial=255) == 255:
        picture = picture.convert("RGB")
    while max(picture.size) > edge:
        picture = picture.reduce(2)
    file = io.BytesIO()
    picture.save(file, format="WEBP", quality=QUALITY, method=2)
    return file.getvalue()
