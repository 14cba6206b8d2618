"""Images that mesh files refer to: their names, and the places where an image is searched."""

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.lfs_pointer import LFS, POINTER
from urdfkit.description.meshes.limits import MAX_BYTES
from urdfkit.description.meshes.unchanged_files import remembered
from urdfkit.description.packages.existence import is_file

PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".tga", ".gif", ".tif", ".tiff", ".webp")
"""Suffixes of images."""

_NAMES = {
    ".obj": re.compile(rb"^[ \t]*mtllib[ \t]+(.+?)[ \t\r]*$", re.MULTILINE),
    ".mtl": re.compile(rb"^[ \t]*map_Kd[ \t]+(\S.*?)[ \t\r]*$", re.MULTILINE),
    ".gltf": re.compile(rb'"uri"\s*:\s*"(?!data:)([^"]+)"'),
}
"""Suffix → pattern of a name of an image, or of a material library."""


def places(folder: Path, name: str) -> Iterator[tuple[Path, Path]]:
    """Yield the paths at which an image is searched, each with the folder in which it has to be.

    Gazebo finds images of ``meshes/`` by their name in the neighbouring folder ``materials/textures/`` (gazebo:
    SystemPaths::FindFile in ColladaLoader).

    Args:
        folder: folder of the mesh.
        name: name of the image in the mesh; in a material library, options such as ``-clamp on`` may precede it.
    """
    wanted = re.sub(r"^(-\S+\s+\S+\s+)+", "", name).replace("\\", "/").removeprefix("file://")
    own = wanted.rpartition("/")[2]
    yield folder / wanted, folder.parent
    yield folder.parent / "materials" / "textures" / own, folder.parent
    yield folder / own, folder


def picture_names(path: Path) -> tuple[str, ...]:
    """Return the names of the images that give an OBJ, COLLADA or glTF file its colours, except embedded ones.

    Raises:
        OSError: the file cannot be read.
    """
    names = _references(path)
    if path.suffix.lower() == ".obj":
        names = tuple(name for library in names for name in _references(path.parent / library))
    return tuple(dict.fromkeys(name for name in names if name.lower().endswith(PICTURES)))


def _references(path: Path) -> tuple[str, ...]:
    suffix = path.suffix.lower()
    if not is_file(path) or path.stat().st_size > MAX_BYTES:
        return ()
    if suffix == ".dae":
        from urdfkit.description.meshes.collada import contents

        return contents(path).pictures
    return _references_in(path) if suffix in _NAMES else ()


@remembered
def _references_in(path: Path) -> tuple[str, ...]:
    found = _NAMES[path.suffix.lower()].findall(path.read_bytes())
    return tuple(name.decode(errors="replace") for name in found)


_BEGINNINGS = (b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"GIF8", b"BM", b"II*\0", b"MM\0*", b"RIFF")


def picture_fault(path: Path) -> str:
    """Return why a file cannot be an image, by its first bytes; empty if it can.

    Raises:
        OSError: the file cannot be read.
    """
    with path.open("rb") as file:
        head = file.read(64)
    is_unmarked = path.suffix.lower() == ".tga"  # the format has no fixed beginning
    return "" if is_unmarked or head.startswith(_BEGINNINGS) else unreadable(head)


def unreadable(head: bytes) -> str:
    """Return the fault of an image that cannot be read, from its first bytes."""
    if not head:
        return "is empty"
    return POINTER if head.startswith(LFS) else "is not a readable picture"
