"""G606 mesh-format-unsupported."""

from __future__ import annotations

from urdfkit.lint.meshes import meshes
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_USUAL = frozenset(("stl", "stlb", "dae", "obj", "glb", "gltf", "ply"))
_FORMATS = {
    "mujoco": frozenset(("stl", "obj", "msh")),
    "classic": frozenset(("stl", "stlb", "dae", "obj")),
    "ros1": frozenset(("stl", "stlb", "dae", "obj", "mesh", "ply")),
    "drake": frozenset(("obj", "gltf", "vtk", "stl", "dae")),
}
"""Endings by target, from the documentation of each (drake 1.x warns of STL and COLLADA, and is not strict)."""


class MeshFormatUnsupported(RobotRule):
    """A mesh is in a format that the consumer does not read.

    ## What it does
    Looks at the ending of mesh files. Without ``--target`` STL, COLLADA, OBJ, glTF and PLY pass; MuJoCo reads STL,
    OBJ and MSH only, Gazebo classic STL, COLLADA and OBJ.

    ## Why is this bad?
    The part is not shown, or the model is refused.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><mesh filename="https://example.com/base.step"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
      </link>
    </robot>
    ```
    """

    code = "G606"
    name = "mesh-format-unsupported"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each mesh of another format."""
        formats = _FORMATS.get(model.target or "", _USUAL)
        for mesh, element, link in meshes(model):
            ending = mesh.uri.strip().rpartition("/")[2].rpartition(".")[2].lower()
            if ending not in formats and "$" not in ending and not model.is_unresolved(element, "filename"):
                who = f"{model.target} does" if model.target in _FORMATS else "most readers do"
                yield self.at(
                    model,
                    element,
                    f"the mesh of link `{link.name}` is a .{ending} file, which {who} not read",
                    attribute="filename",
                    link=link.name,
                    help=f"convert it to one of {', '.join(sorted(formats))}",
                )
