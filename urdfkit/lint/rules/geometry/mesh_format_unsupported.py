"""G606 mesh-format-unsupported."""

from urdfkit.lint.rule import Findings, Model, RobotRule

_USUAL = frozenset(("stl", "stlb", "dae", "obj", "glb", "gltf", "ply"))
_FORMATS = {
    "mujoco": frozenset(("stl", "obj", "msh")),
    "classic": frozenset(("stl", "stlb", "dae", "obj")),
    "ros1": frozenset(("stl", "stlb", "dae", "obj", "mesh", "ply")),
    "drake": frozenset(("obj", "gltf", "vtk", "stl", "dae")),
}
"""Target → suffixes, by its documentation (drake 1.x only warns about STL and COLLADA)."""


class MeshFormatUnsupported(RobotRule):
    """A mesh has an unsupported format.

    ## What it does
    Checks the suffix of mesh files. Without ``--target``, STL, COLLADA, OBJ, glTF and PLY are accepted. MuJoCo reads
    only STL, OBJ and MSH; Gazebo Classic reads only STL, COLLADA and OBJ.

    ## Why is this bad?
    The mesh is not shown, or the model is rejected.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
    -    <visual><geometry><mesh filename="base.step"/></geometry></visual>
    +    <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "G606"
    name = "mesh-format-unsupported"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each mesh of an unsupported format."""
        formats = _FORMATS.get(model.target or "", _USUAL)
        for mesh, element, link in model.meshes:
            suffix = mesh.uri.strip().rpartition("/")[2].rpartition(".")[2].lower()
            if suffix not in formats and "$" not in suffix and not model.is_unresolved(element, "filename"):
                reader = f"{model.target} does" if model.target in _FORMATS else "most readers do"
                message = f"mesh of link `{link.name}` is a .{suffix} file, which {reader} not read"
                help = f"convert it to one of {', '.join(sorted(formats))}"
                yield self.at(model, element, message, attribute="filename", link=link.name, help=help)
