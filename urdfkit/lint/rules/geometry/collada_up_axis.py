"""G608 collada-unit-or-upaxis."""

import re
from pathlib import Path

from urdfkit.description.packages.existence import is_file
from urdfkit.lint.model.mesh_files import path_of
from urdfkit.lint.rule import Findings, Model, RobotRule


class ColladaUpAxis(RobotRule):
    """A COLLADA mesh has an up axis other than z, or a unit other than the metre.

    ## What it does
    Reads ``<up_axis>`` and ``<unit>`` at the beginning of COLLADA files. A unit other than the metre is reported as a
    note.

    ## Why is this bad?
    RViz and Gazebo do not rotate the mesh, but other readers do. The mesh is upright in one program and lies on its
    side in another.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
    -    <visual><geometry><mesh filename="meshes/lying.dae"/></geometry></visual>
    +    <visual><geometry><mesh filename="meshes/standing.dae"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "G608"
    name = "collada-unit-or-upaxis"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each COLLADA file whose up axis or unit differs from URDF."""
        assets: dict[str, tuple[str, float]] = {}
        for mesh, element, link in model.meshes:
            uri = mesh.uri.strip()
            if not uri.lower().endswith(".dae"):
                continue
            if uri not in assets:
                assets[uri] = _asset(path_of(mesh, model.expanded))
            axis, unit = assets[uri]
            if axis not in ("", "Z_UP"):
                message = f"mesh `{uri}` has {axis[0].lower()} up, which only some readers convert to z up"
                help = "export the mesh with z up"
                yield self.at(model, element, message, attribute="filename", link=link.name, help=help)
            elif abs(unit - 1.0) > 1e-6:
                message = f"mesh `{uri}` is in units of {unit:g} m, which some readers ignore"
                help = "export the mesh in metres"
                yield self.at(model, element, message, attribute="filename", link=link.name, help=help, severity="note")


def _asset(path: Path | None) -> tuple[str, float]:
    """Return the up axis of a file, empty if it has none, and its unit [m]."""
    if path is None or not is_file(path):
        return "", 1.0
    try:
        with path.open("rb") as file:
            head = file.read(65536).decode("utf-8", errors="replace")
    except OSError:
        return "", 1.0
    axis = re.search(r"<up_axis>\s*(\w+)\s*</up_axis>", head)
    unit = re.search(r"<unit\b[^>]*\bmeter\s*=\s*[\"']([0-9.eE+-]+)[\"']", head)
    return axis[1] if axis else "", float(unit[1]) if unit else 1.0
