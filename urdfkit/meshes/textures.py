"""Textures of meshes, and access to the files that meshes refer to."""

import hashlib
import io
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.packages.existence import is_file
from urdfkit.meshes.collada_effects import has_texture_opacity
from urdfkit.meshes.material_colors import factor_of, linear_of, srgb_bytes, to_bytes
from urdfkit.meshes.picture_files import PICTURES, places, unreadable

MAX_EDGE = 4096
"""Largest edge length of a texture; larger ones are halved until they fit [px]."""

MAX_PIXELS = 2**27
"""Largest number of pixels of an image, which needs 0.7 GB to be read."""
LONGEST_EDGE = 2**16
"""Largest width and height of an image that is read [px]."""

_OWN = (".mtl", ".bin")


@dataclass(frozen=True, eq=False)
class Texture:
    """A texture.

    Attributes:
        pixels: red, green, blue and opacity, the top row first, read-only; shape (height, width, 4).
        hash: hexadecimal digest of the pixels.
    """

    pixels: NDArray[np.uint8] = field(repr=False)
    hash: str = ""

    def __post_init__(self) -> None:
        self.pixels.flags.writeable = False
        digest = hashlib.sha256(f"{self.pixels.shape}".encode())
        digest.update(np.ascontiguousarray(self.pixels).data)
        object.__setattr__(self, "hash", digest.hexdigest()[:32])


def texture_of(material: Any, *, linear: bool) -> Texture | None:
    """Return the texture of a material of trimesh, multiplied by its colour; None without one.

    Args:
        material: the material.
        linear: whether its colour is linear and multiplies linear values, as in glTF; otherwise it is sRGB and
            multiplies sRGB values, as ``Kd`` of an OBJ file in RViz and three.js.

    Raises:
        OSError: the picture is broken.
        ValueError: it is too large.
    """
    picture = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
    if picture is None:
        return None
    pixels = _pixels(picture)
    factor = factor_of(material)
    if getattr(material, "alphaMode", "") in (None, "OPAQUE") and (linear or not has_texture_opacity(material)):
        pixels[..., 3] = 255
    if factor is not None and (factor != 1.0).any():
        scaled = np.arange(256)[:, None] / 255.0 * factor  # each channel is a function of a byte
        table = srgb_bytes(linear_of(np.arange(256) / 255.0)[:, None] * factor) if linear else to_bytes(scaled)
        table[:, 3] = to_bytes(scaled[:, 3])
        pixels = table[pixels, np.arange(4)]
    return Texture(pixels)


def read_texture(path: Path) -> Texture:
    """Return the image of a file.

    Raises:
        OSError: the file is missing or invalid.
        ValueError: it is invalid or too large.
    """
    from PIL import Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Image.open(path) as picture:
                return Texture(_pixels(picture))
    except (OSError, ValueError):
        raise
    except Exception as error:  # any error of the reader of the format
        raise ValueError(f"invalid image: {error}") from error


def _pixels(picture: Any) -> NDArray[np.uint8]:
    """Return red, green, blue and opacity of an image, reduced if it is too large.

    Raises:
        OSError: it is broken.
        ValueError: it is too large.
    """
    if picture.width * picture.height > MAX_PIXELS or max(picture.size) > LONGEST_EDGE:
        raise ValueError(f"the texture is too large: {picture.width} × {picture.height} pixels")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        while max(picture.size) > MAX_EDGE:
            picture = picture.reduce(2)
        return np.array(picture.convert("RGBA"))


class SideFiles(dict[str, bytes]):
    """The files that a mesh may refer to: materials and buffers below its folder, images as `places` yields them.

    Args:
        path: the mesh file.
        limit: size of the largest file that is read [byte].

    Attributes:
        read: the files that have been read, with modification time and size.
        missing: names of images that are missing or invalid.
        broken: names of images that exist and are invalid, each with its fault.
    """

    def __init__(self, path: Path, limit: int) -> None:
        super().__init__()
        self._folder = path.parent.resolve()
        self._limit = limit
        self.read: dict[Path, tuple[int, int]] = {}
        self.missing: list[str] = []
        self.broken: list[tuple[str, str]] = []

    def __missing__(self, name: str) -> bytes:
        if "\0" in name:
            raise KeyError(name)
        picture = name.lower().endswith(PICTURES)
        own = self._folder / name.replace("\\", "/").removeprefix("file://")
        for place, within in places(self._folder, name) if picture else ((own, self._folder),):
            path = place.resolve()
            allowed = picture or path.suffix.lower() in _OWN
            if allowed and path.is_relative_to(within) and is_file(path):
                status = path.stat()
                if status.st_size <= self._limit:
                    self.read[path] = status.st_mtime_ns, status.st_size
                    content = path.read_bytes()
                    if picture and not _opens(content):
                        self.missing.append(name)
                        self.broken.append((name, unreadable(content)))
                    return content
        if picture:
            self.missing.append(name)
        raise KeyError(name)

    get = __missing__  # type: ignore[assignment]  # trimesh calls get(name) of a resolver


def _opens(content: bytes) -> bool:
    from PIL import Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            Image.open(io.BytesIO(content)).verify()
    except Exception:  # any error of the reader of the format
        return False
    return True


def is_as_read(files: dict[Path, tuple[int, int]]) -> bool:
    """Whether files are unchanged since they were read."""
    try:
        return all((s := path.stat()) and (s.st_mtime_ns, s.st_size) == signature for path, signature in files.items())
    except OSError:
        return False
