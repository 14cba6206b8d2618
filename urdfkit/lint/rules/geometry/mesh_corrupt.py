"""G607 mesh-corrupt-or-lfs-pointer."""

from __future__ import annotations

from urdfkit.lint.meshes import LFS, meshes, path_of
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MeshCorrupt(RobotRule):
    """A mesh file is there, but holds no mesh.

    ## What it does
    Looks at the beginning and the size of mesh files: empty ones, pointers of Git LFS, STL files shorter than they
    say, COLLADA and glTF files that are none.

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
    if not head:
        return "is empty"
    if head.startswith(LFS):
        return "is a pointer of Git LFS: run `git lfs pull`"
    if ending == ".stl" and not (head.lstrip().startswith(b"solid") and b"facet" in head):
        triangles = int.from_bytes(head[80:84], "little")
        if size < 84 or size < 84 + 50 * triangles:
            return f"is cut off: {size} bytes, but {triangles} triangles take {84 + 50 * triangles}"
    if ending == ".dae" and b"<COLLADA" not in head.replace(b"\0", b"") and b"<?xml" not in head.replace(b"\0", b""):
        return "is no COLLADA file"
    if ending == ".glb" and not head.startswith(b"glTF"):
        return "is no binary glTF file"
    return ""
