"""G607 mesh-corrupt-or-lfs-pointer."""

import re
from pathlib import Path

from urdfkit.description.lfs_pointer import LFS, POINTER
from urdfkit.description.meshes.bounds import bounds
from urdfkit.description.meshes.format_faults import (
    NOT_FINITE,
    TITLES,
    glb_fault,
    has_infinite_stl_vertex,
    obj_fault,
    other_format,
    text_fault,
    wrong_format,
)
from urdfkit.description.meshes.limits import MAX_BYTES, MAX_TRIANGLES
from urdfkit.description.meshes.stl import is_binary
from urdfkit.description.meshes.unchanged_files import remembered
from urdfkit.description.packages.existence import exists, is_file, is_folder
from urdfkit.lint.model.mesh_files import path_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_LARGE = 64 * 2**20
"""Size in bytes above which files are not searched for triangles."""

_MOST = 3.4e38
"""Size in metres above which coordinates are not finite as 32-bit numbers, as which they are stored."""

_UTF16 = (b"\xff\xfe", b"\xfe\xff")

_FACES = {
    ".obj": re.compile(rb"^[ \t]*(f|fo|l|p|curv|surf)[ \t]", re.MULTILINE),
    ".dae": re.compile(rb"<(\w+:)?(triangles|polylist|polygons|trifans|tristrips|lines|linestrips)\b"),
}
"""Suffix → pattern of the start of a face, line or curve."""


class MeshCorrupt(RobotRule):
    """A mesh file exists but contains no usable mesh.

    ## What it does
    Checks mesh files for these defects:

    - a folder, an empty file or a Git LFS pointer in place of a mesh
    - a format that differs from the suffix, truncated STL and glTF files, and invalid COLLADA files
    - no triangles, or all vertices at one point
    - more than 256 MiB or 5 million triangles
    - vertices that are not finite (STL, OBJ and COLLADA), and faces with missing vertices (OBJ files up to 2 MiB)

    If trimesh is installed, it reads the formats that the linter cannot read.

    ## Why is this bad?
    Viewers show nothing. Simulators stop with an error message that does not name the cause.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
    -    <visual><geometry><mesh filename="meshes/pointer.stl"/></geometry></visual>
    +    <visual><geometry><mesh filename="meshes/whole.stl"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "G607"
    name = "mesh-corrupt-or-lfs-pointer"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each file that contains no mesh."""
        faults: dict[str, str] = {}
        for mesh, element, link in model.meshes:
            if mesh.uri not in faults:
                path = path_of(mesh, model.expanded)
                faults[mesh.uri] = _fault(path) if path is not None and exists(path) else ""
                box = model.box_of(mesh) if path is not None and not faults[mesh.uri] and any(mesh.scale) else None
                if box is not None and not any(box[1]):
                    faults[mesh.uri] = "has all vertices at one point"
                elif box is not None and max(box[1]) > _MOST:
                    faults[mesh.uri] = NOT_FINITE
                elif box is None and path is not None and path.suffix.lower() in TITLES:
                    faults[mesh.uri] = faults[mesh.uri] or model.mesh_boxes.fault(mesh)
            if faults[mesh.uri]:
                message = f"mesh `{mesh.uri.strip()}` {faults[mesh.uri]}"
                yield self.at(model, element, message, attribute="filename", link=link.name)


def _fault(path: Path) -> str:
    """Return the fault of a mesh file; empty if none is found."""
    if not is_file(path):
        return "is a folder" if is_folder(path) else "is not a regular file"
    try:
        return _fault_in(path)
    except OSError as error:
        return f"cannot be read: {error.strerror}"


@remembered
def _fault_in(path: Path) -> str:
    with path.open("rb") as file:
        head = file.read(1024)
    size, suffix = path.stat().st_size, path.suffix.lower()
    if not size:
        return "is empty"
    if size > MAX_BYTES:
        return f"has {size / 2**20:.0f} MiB; at most {MAX_BYTES // 2**20} are supported: decimate it"
    if head.startswith(LFS):
        return POINTER
    if suffix == ".stl":
        return _stl_fault(path, head, size)
    if suffix == ".glb":
        return glb_fault(head, size)
    if suffix in (".dae", ".gltf", ".ply") and (fault := text_fault(suffix, head)):
        return fault
    if suffix == ".dae":
        from urdfkit.description.meshes.collada import contents

        if fault := contents(path).fault:
            return fault
    if suffix == ".obj" and size <= _LARGE and (fault := obj_fault(path.read_bytes())):
        return fault
    faces = _FACES.get(suffix)
    if faces is None or bounds(path, estimated=True) is not None:
        return ""
    if size <= _LARGE and not head.startswith(_UTF16) and not faces.search(path.read_bytes()):
        return "contains no triangles"
    return ""


def _stl_fault(path: Path, head: bytes, size: int) -> str:
    triangles = int.from_bytes(head[80:84], "little")
    is_text = (
        not is_binary(size, head)
        and head.lstrip().startswith(b"solid")
        and (b"facet" in head or (size <= _LARGE and b"facet" in path.read_bytes()))
    )
    if not is_text:
        if head.lstrip().startswith(b"solid") and size < 84:
            return "contains no triangles"
        if size < 84 or size < 84 + 50 * triangles:
            if other_format(head):
                return wrong_format(head, ".stl")
            return f"is truncated: {size} bytes, but {triangles} triangles need {84 + 50 * triangles}"
        if triangles > MAX_TRIANGLES:
            return f"has {triangles} triangles; at most {MAX_TRIANGLES} are supported: decimate it"
        if not triangles:
            return "contains no triangles"
    from mmap import ACCESS_READ, mmap

    with path.open("rb") as file, mmap(file.fileno(), 0, access=ACCESS_READ) as content:
        return NOT_FINITE if has_infinite_stl_vertex(content, is_text=is_text) else ""
