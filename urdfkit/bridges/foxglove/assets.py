"""Files that clients fetch to draw a robot: meshes and textures in packages."""

from collections.abc import Callable
from pathlib import Path

from urdfkit.errors import UsageError

SUFFIXES = (
    ".stl", ".dae", ".obj", ".mtl", ".glb", ".gltf", ".bin", ".png", ".jpg", ".jpeg", ".tga", ".bmp", ".tif", ".urdf",
)  # fmt: skip
"""File types that are sent; nothing else of a package."""
MAX_SIZE = 256 * 1024 * 1024
"""Size of the largest file that is sent [bytes]."""


def read_asset(uri: str, find_package: Callable[[str], Path]) -> bytes:
    """Return a file of a package.

    Args:
        uri: ``package://name/path``.
        find_package: returns the folder of a package.

    Raises:
        UrdfkitError: unknown package, no such file, or a file of another kind.
    """
    scheme, separator, rest = uri.partition("://")
    name, _, path = rest.partition("/")
    if scheme != "package" or not separator or not path:
        raise UsageError(f"`{uri}` is not a file of a package; use package://NAME/PATH")
    folder = find_package(name).resolve()
    file = (folder / path).resolve()
    if not file.is_relative_to(folder) or file.suffix.lower() not in SUFFIXES:
        raise UsageError(f"`{uri}` is not a mesh or texture inside the package")
    try:
        if file.stat().st_size > MAX_SIZE:
            raise UsageError(f"`{uri}` is larger than {MAX_SIZE >> 20} MB")
        return file.read_bytes()
    except OSError as error:
        raise UsageError(f"cannot read `{uri}`: {error.strerror}") from error
