"""G607 mesh-corrupt-or-lfs-pointer."""

from __future__ import annotations

import re

from urdfkit.lint.meshes import LFS, meshes, path_of
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_LARGE = 64 * 2**20
"""Files of more bytes are not searched for triangles."""

_UTF16 = (b"\xff\xfe", b"\xfe\xff")

_FACES = {
    ".obj": re.compile(rb"^[ \t]*(f|fo|l|p|curv|surf)[ \t]", re.MULTILINE),
    ".dae": re.compile(rb"<(\w+:)?(triangles|polylist|polygons|trifans|tristrips|lines|linestrips)\b"),
}
"""Ending → what some part of the mesh begins with."""


class MeshCorrupt(RobotRule):
    """A mesh file is there, but holds no mesh.

    ## What it does
    Looks into mesh files: empty ones, pointers of Git LFS, STL files shorter than they say, COLLADA and glTF files
    that are none, files without a triangle, or with all of them in one point.

    ## Why is this bad?
    Viewers show nothing and simulators stop, with a message about the reader instead of the file.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><mesh filename="meshes/pointer.stl"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><mesh filename="meshes/whole.stl"/></geometry></visual>
      </link>
    </robot>
    ```
    """

    code = "G607"
    name = "mesh-corrupt-or-lfs-pointer"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each file that cannot be a mesh."""
        known: dict[str, str] = {}
        for mesh, element, link in meshes(model):
            if mesh.uri not in known:
                path = path_of(mesh, model)
                known[mesh.uri] = _fault(path) if path is not None and path.is_file() else ""
                box = model.box_of(mesh) if path is not None and not known[mesh.uri] and any(mesh.scale) else None
                if box is not None and not any(box[1]):
                    known[mesh.uri] = "has all its triangles in one point"
            if known[mesh.uri]:
                yield self.at(
                    model,
                    element,
                    f"the mesh `{mesh.uri.strip()}` {known[mesh.uri]}",
                    attribute="filename",
                    link=link.name,
                )


def _fault(path: Path) -> str:
    """Return what is wrong with a file, empty where nothing is seen."""
    try:
        size = path.stat().st_size
        with path.open("rb") as file:
            head = file.read(1024)
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    ending = path.suffix.lower()
    if not size:
        return "is empty"
    if head.startswith(LFS):
        return "is a pointer of Git LFS: run `git lfs pull`"
    if ending == ".stl":
        return _fault_of_stl(path, head, size)
    if ending == ".dae" and b"<COLLADA" not in head.replace(b"\0", b"") and b"<?xml" not in head.replace(b"\0", b""):
        return "is no COLLADA file"
    if ending == ".glb" and not head.startswith(b"glTF"):
        return "is no binary glTF file"
    faces = _FACES.get(ending)
    if faces is not None and size <= _LARGE and not head.startswith(_UTF16) and not faces.search(path.read_bytes()):
        return "holds no triangles"
    return ""


def _fault_of_stl(path: Path, head: bytes, size: int) -> str:
    if head.lstrip().startswith(b"solid") and (b"facet" in head or (size <= _LARGE and b"facet" in path.read_bytes())):
        return ""
    if head.lstrip().startswith(b"solid") and size < 84:
        return "holds no triangles"
    triangles = int.from_bytes(head[80:84], "little")
    if size < 84 or size < 84 + 50 * triangles:
        return f"is cut off: {size} bytes, but {triangles} triangles take {84 + 50 * triangles}"
    return "" if triangles else "holds no triangles"
