"""G602 mesh-package-unknown."""

from __future__ import annotations

from urdfkit.lint.meshes import meshes, missing
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MeshPackageUnknown(RobotRule):
    """A mesh is in a package that is not there.

    ## What it does
    Looks for the packages of ``package://`` and ``model://`` in the workspace and in the environment; each is
    reported once.

    ## Why is this bad?
    The robot is shown without its meshes. The package may be spelt wrong, or missing on this machine only: pass its
    folder with ``--package-path`` then.

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

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each package, at the first mesh that is in it."""
        reported: set[str] = set()
        for mesh, element, link in meshes(model):
            name = mesh.uri.strip().partition("://")[2].partition("/")[0]
            if name in reported or "$" in mesh.uri or not mesh.uri.strip().startswith(("package://", "model://")):
                continue
            reported.add(name)
            if missing(mesh, model) == ("package", name):
                yield self.at(
                    model,
                    element,
                    f"the package `{name}` of this mesh is neither in the workspace nor in the environment",
                    attribute="filename",
                    link=link.name,
                    help="give the folder it is in with --package-path",
                )
