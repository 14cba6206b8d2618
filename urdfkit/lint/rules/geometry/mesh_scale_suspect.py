"""G604 mesh-scale-suspect."""

from __future__ import annotations

from urdfkit.description.robot import Mesh
from urdfkit.lint.edits import more_attributes, new_value
from urdfkit.lint.meshes import meshes
from urdfkit.lint.placement import shapes_of
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MeshScaleSuspect(RobotRule):
    """A mesh is about a thousand times as large, or small, as the robot around it.

    ## What it does
    Compares the size of a mesh, scale included, with the middle of the distances between joints and of the other
    shapes.

    ## Why is this bad?
    CAD programs write millimetres, URDF means metres: the part fills the sky, or cannot be seen.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
      </link>
      <link name="tool">
        <visual><geometry><mesh filename="meshes/block_in_mm.stl"/></geometry></visual>
      </link>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="tool"/>
        <origin xyz="0 0 0.1"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
      </link>
      <link name="tool">
        <visual><geometry><mesh filename="meshes/block_in_mm.stl" scale="0.001 0.001 0.001"/></geometry></visual>
      </link>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="tool"/>
        <origin xyz="0 0 0.1"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Unsafe: the scale is divided, or multiplied, by 1000.
    """

    code = "G604"
    name = "mesh-scale-suspect"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each mesh that is far too large or small."""
        found = [(mesh, element, link, _diagonal(model, mesh)) for mesh, element, link in meshes(model)]
        if not any(size for *_, size in found):
            return
        sizes = [sum(part * part for part in joint.origin.xyz) ** 0.5 for joint in model.robot.joints]
        for link in model.robot.links:
            if all(not isinstance(shape.geometry, Mesh) for shape in shapes_of(link)) and link.name in model.extents:
                sizes.append(model.extents[link.name].diagonal)
        for mesh, element, link, size in found:
            others = sorted(size for size in (*sizes, *(s for m, *_, s in found if m.uri != mesh.uri)) if size > 1e-4)
            if not others or not size:
                continue
            middle = others[len(others) // 2]
            if not (100.0 < size / middle < 10000.0 or 100.0 < middle / size < 10000.0):
                continue
            factor, what = (0.001, "large") if size > middle else (1000.0, "small")
            scale = " ".join(f"{part * factor:g}" for part in mesh.scale)
            fix = (
                new_value(model, element, "scale", scale, "unsafe", f"Scale by {scale}")
                if element.get("scale") is not None
                else more_attributes(model, element, f'scale="{scale}"', "unsafe", f"Scale by {scale}")
            )
            yield self.at(
                model,
                element,
                f"the mesh of link `{link.name}` is {size:.3g} m across in a robot of parts of about {middle:.2g} m",
                attribute="scale",
                link=link.name,
                help=f'too {what} by 1000? URDF means metres: scale="{scale}"',
                fix=fix,
            )


def _diagonal(model: Model, mesh: Mesh) -> float:
    """Return how large a mesh is [m]; 0 where that is not known."""
    box = model.box_of(mesh)
    return 0.0 if box is None else sum(part * part for part in box[1]) ** 0.5
