"""G602 mesh-package-unknown."""

from urdfkit.lint.model.mesh_files import missing
from urdfkit.lint.rule import Findings, Model, RobotRule


class MeshPackageUnknown(RobotRule):
    """The package of a mesh is not found.

    ## What it does
    Looks up the packages of ``package://`` and ``model://`` in the workspace and the environment. Each package is
    reported once.

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
        """Yield a finding for each missing package, at its first mesh."""
        reported: set[str] = set()
        for mesh, element, link in model.meshes:
            name = mesh.uri.strip().partition("://")[2].partition("/")[0]
            if name in reported or "$" in mesh.uri or not mesh.uri.strip().startswith(("package://", "model://")):
                continue
            reported.add(name)
            if missing(mesh, model.expanded) == ("package", name):
                yield self.at(
                    model,
                    element,
                    f"package `{name}` of the mesh not found in workspace or environment"
                    if name
                    else f"mesh URI `{mesh.uri.strip()}` has three slashes, so it contains no package",
                    attribute="filename",
                    link=link.name,
                    help="pass the folder that contains it with --package-path" if name else "remove a slash",
                )
