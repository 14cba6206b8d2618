"""G602 mesh-package-unknown."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.model.mesh_files import missing
from urdfkit.lint.rule import Findings, Model, RobotRule

_HELP = "pass the folder that contains it with --package-path"


class MeshPackageUnknown(RobotRule):
    """The package of a mesh is not found.

    ## What it does
    Looks up the packages of ``package://`` and ``model://`` in the workspace and the environment. All meshes of one
    missing package are reported in a single finding.

    ## Why is this bad?
    The robot is shown without its meshes. The package name may be misspelt, or the package may be missing on this
    machine only. In the latter case, pass its folder with ``--package-path``. A name that differs by one letter from a
    package of the workspace or a common package is reported as an error.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
    -    <visual><geometry><mesh filename="package://arm_that_is_nowhere/base.stl"/></geometry></visual>
    +    <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "G602"
    name = "mesh-package-unknown"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each mesh of a missing package; those of one package have one cause."""
        from urdfkit.description.packages.related_files import neighbours
        from urdfkit.lint.facts.ros_packages import misspelling_of

        exists: dict[str, bool] = {}
        near: dict[str, str | None] = {}
        for mesh, element, link in model.meshes:
            uri = mesh.uri.strip()
            if "$" in uri or not uri.startswith(("package://", "model://")):
                continue
            name = uri.partition("://")[2].partition("/")[0]
            if name not in exists:
                exists[name] = missing(mesh, model.expanded) != ("package", name)
            if exists[name]:
                continue
            if name not in near:
                near[name] = misspelling_of(name, neighbours(model.package) if model.package is not None else ())
            yield self.at(
                model,
                element,
                f"package `{name}` of the mesh is neither in the workspace nor in the environment"
                + Suggestion(near[name])
                if name
                else f"mesh URI `{uri}` has three slashes, so it contains no package",
                attribute="filename",
                link=link.name,
                help=None if near[name] else _HELP if name else "remove a slash",
                severity="error" if near[name] else None,
                cause=f"package {name}" if name else "",
            )
