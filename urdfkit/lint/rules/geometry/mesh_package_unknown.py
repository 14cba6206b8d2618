"""G602 mesh-package-unknown."""

from urdfkit.lint.model.mesh_files import missing
from urdfkit.lint.rule import Findings, Model, RobotRule


class MeshPackageUnknown(RobotRule):
    """The package of a mesh is not found.

    ## What it does
    Looks up the packages of ``package://`` and ``model://`` in the workspace and the environment. The meshes of
    one package are shown as one finding.

    ## Why is this bad?
    The robot is shown without its meshes. The package name may be misspelt, or the package may be missing on this
    machine only. In the latter case, pass its folder with ``--package-path``.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><mesh filename="package://arm_that_is_nowhere/base.stl"/></geometry></visual>
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

    code = "G602"
    name = "mesh-package-unknown"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each mesh of a missing package; those of one package have one cause."""
        found: dict[str, bool] = {}
        for mesh, element, link in model.meshes:
            uri = mesh.uri.strip()
            if "$" in uri or not uri.startswith(("package://", "model://")):
                continue
            name = uri.partition("://")[2].partition("/")[0]
            if name not in found:
                found[name] = missing(mesh, model.expanded) != ("package", name)
            if not found[name]:
                yield self.at(
                    model,
                    element,
                    f"package `{name}` of the mesh not found in workspace or environment"
                    if name
                    else f"mesh URI `{uri}` has three slashes, so it contains no package",
                    attribute="filename",
                    link=link.name,
                    help="pass the folder that contains it with --package-path" if name else "remove a slash",
                    cause=f"package {name}" if name else "",
                )
