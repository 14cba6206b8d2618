"""G603 mesh-absolute-path."""

from __future__ import annotations

import re

from urdfkit.lint.edits import new_value
from urdfkit.lint.meshes import is_absolute, meshes
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MeshAbsolutePath(RobotRule):
    r"""A mesh is named by a path that only one machine has.

    ## What it does
    Looks for ``/…``, ``file:///…`` and ``C:\…`` written out in ``filename``. ``file://$(find …)/…`` is found anew
    on every machine and fine.

    ## Why is this bad?
    On any other machine, and for any other user, the mesh is not there.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><mesh filename="file:///home/me/ws/src/arm/meshes/base.stl"/></geometry></visual>
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

    ## Fix safety
    Unsafe: ``package://`` and the folder before ``meshes`` are written, where the path has one.
    """

    code = "G603"
    name = "mesh-absolute-path"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each absolute path that is written out."""
        for mesh, element, link in meshes(model):
            uri = mesh.uri.strip()
            if not is_absolute(uri) or model.literal(element, "filename") is None:
                continue
            inside = re.search(r"([\w.-]+)/((?:meshes|mesh|models)/.+)$", uri.replace("\\", "/"))
            better = f"package://{inside[1]}/{inside[2]}" if inside else "package://…"
            yield self.at(
                model,
                element,
                f"the mesh `{uri}` is named by a path that only one machine has",
                attribute="filename",
                link=link.name,
                help=f"write {better}",
                fix=new_value(model, element, "filename", better, "unsafe", f"Write {better}") if inside else None,
            )
