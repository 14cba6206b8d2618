"""G603 mesh-absolute-path."""

import re

from urdfkit.description.packages.existence import is_absolute
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule


class MeshAbsolutePath(RobotRule):
    r"""A mesh is referenced by an absolute path.

    ## What it does
    Checks for ``/…``, ``file:///…`` and ``C:\…`` written literally in ``filename``. ``file://$(find …)/…`` is accepted,
    because it is resolved on every machine.

    ## Why is this bad?
    The path does not exist on other machines or for other users.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
    -    <visual><geometry><mesh filename="file:///home/me/ws/src/arm/meshes/base.stl"/></geometry></visual>
    +    <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes a ``package://`` path with the folder above ``meshes`` as the package, but that folder may
    not be a package. No fix is offered for paths without a folder ``meshes``.
    """

    code = "G603"
    name = "mesh-absolute-path"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each literal absolute path."""
        for mesh, element, link in model.meshes:
            uri = mesh.uri.strip()
            if not is_absolute(uri) or model.literal(element, "filename") is None:
                continue
            match = re.search(r"([\w.-]+)/((?:meshes|mesh|models)/.+)$", uri.replace("\\", "/"))
            package_uri = f"package://{match[1]}/{match[2]}" if match else "package://…"
            message = f"mesh `{uri}` is referenced by an absolute path"
            help = f"write {package_uri}"
            fix = (
                new_value(model, element, "filename", package_uri, "unsafe", f"Replace with {package_uri}")
                if match
                else None
            )
            yield self.at(model, element, message, attribute="filename", link=link.name, help=help, fix=fix)
