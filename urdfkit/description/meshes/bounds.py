"""Bounding boxes of mesh files by quick readers of the usual formats."""

from __future__ import annotations

from stat import S_ISREG

from urdfkit.description.meshes import stl, wavefront
from urdfkit.description.meshes.limits import MAX_BYTES
from urdfkit.description.meshes.points import UnusualFileError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path

    from urdfkit.description.meshes.points import Corners

_cached: dict[tuple[tuple[str, int, int, int, int], bool], Corners | None] = {}
"""Boxes by path, inode, size, times of the file, and whether they may be estimates."""
_MAX_CACHED = 10_000


def bounds(path: Path, *, estimated: bool = False) -> Corners | None:
    """Return the lowest and highest corner of a mesh [m]; None if it needs a full reader, or cannot be read.

    Args:
        path: binary or text STL, OBJ, COLLADA or binary glTF. COLLADA is converted to metres, its up axis is ignored.
        estimated: read a sample of the vertices of a large file; the box is then slightly too small. The sample is the
            same at every call.
    """
    try:
        status = path.stat()
    except OSError:
        return None
    if not S_ISREG(status.st_mode):  # reading a pipe or device might never end
        return None
    version = (str(path), status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns)
    key = (version, estimated)
    if key not in _cached:
        if len(_cached) >= _MAX_CACHED:
            _cached.clear()
        try:
            _cached[key], is_exact = _read(path, status.st_size, estimated)
        except (UnusualFileError, OSError):
            _cached[key], is_exact = None, True
        if is_exact:
            _cached[version, False] = _cached[key]
    return _cached[key]


def _read(path: Path, size: int, estimated: bool) -> tuple[Corners, bool]:
    """Return the corners, and whether they are known to be exact."""
    suffix = path.suffix.lower()
    if size > MAX_BYTES:
        raise UnusualFileError
    samples = {".stl": stl.estimated_corners, ".obj": wavefront.estimated_corners}.get(suffix)
    if estimated and samples is not None:
        with path.open("rb", buffering=0) as file:
            box = samples(file, size)
        if box is not None:
            return box, False
    if suffix == ".stl":
        return stl.corners(path.read_bytes()), True
    if suffix == ".obj":
        return wavefront.corners(path.read_bytes()), True
    if suffix == ".dae":
        from urdfkit.description.meshes import collada

        return collada.corners(path, estimated=estimated), not estimated
    if suffix == ".glb":
        from urdfkit.description.meshes import gltf

        return gltf.corners(path.read_bytes()), True
    raise UnusualFileError
