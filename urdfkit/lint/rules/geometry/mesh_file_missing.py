"""G601 mesh-file-missing."""

from __future__ import annotations

import re

from urdfkit.lint.edits import new_value
from urdfkit.lint.meshes import is_absolute, meshes, missing
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MeshFileMissing(RobotRule):
    """A mesh file is not there.

    ## What it does
    Resolves the ``filename`` of every mesh (``package://``, ``model://``, ``file://``, paths) and looks whether it
    exists; upper and lower case count, and the nearest name is given.

    ## Why is this bad?
    check_urdf does not look. Viewers show nothing, simulators stop, and what was named with the wrong case works on
    the machine it was made on only.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><mesh filename="meshes/base.stl"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><mesh filename="meshes/Base.stl"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the file with the nearest name in the same folder is taken.
    """

    code = "G601"
    name = "mesh-file-missing"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each mesh that is not there."""
        known: dict[str, tuple[str, str] | None] = {}
        for mesh, element, link in meshes(model):
            if model.is_unresolved(element, "filename") or "$" in mesh.uri:
                continue
            if mesh.uri not in known:
                known[mesh.uri] = missing(mesh, model)
            lack = known[mesh.uri]
            if lack is None or lack[0] != "file":
                continue
            if is_absolute(mesh.uri) and model.literal(element, "filename") is not None:
                continue  # That it is on nobody else's machine is the matter.
            near = re.search(r"did you mean `([^`]+)`", lack[1])
            uri = f"{mesh.uri.strip().rpartition('/')[0]}/{near[1]}".lstrip("/") if near else ""
            is_name = (
                near is not None and near[1].rpartition(".")[2].lower() == mesh.uri.strip().rpartition(".")[2].lower()
            )
            yield self.at(
                model,
                element,
                f"the mesh `{mesh.uri.strip()}` is not there{f'; did you mean `{near[1]}`?' if near else ''}",
                attribute="filename",
                link=link.name,
                fix=new_value(model, element, "filename", uri, "unsafe", f"Write `{uri}`") if is_name else None,
            )
