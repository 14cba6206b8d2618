"""G617 shapes-apart."""

from __future__ import annotations

from math import dist

from urdfkit.description.robot import Mesh, Visual
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_HALF = 0.5
"""Of a colour's last number: what has less is seen through."""


class ShapesApart(RobotRule):
    """A shape of a link is far away from the others.

    ## What it does
    Looks for shapes that reach ten times farther from the centre of mass than the others of their link, and so far that
    the inertia denies it (as of I508). Meshes that are too large are G604's, and what is more than half transparent
    only shows something: what a camera sees, for one.

    ## Why is this bad?
    What is seen is not what is hit: mostly a point has been lost, or metres were taken for something else.

    ## Example
    ```xml
    <robot name="arm">
      <link name="arm">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.001667" ixy="0" ixz="0" iyy="0.001667" iyz="0" izz="0.001667"/>
        </inertial>
        <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
        <collision>
          <origin xyz="15 0 0"/>
          <geometry><box size="0.1 0.1 0.1"/></geometry>
        </collision>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="arm">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.001667" ixy="0" ixz="0" iyy="0.001667" iyz="0" izz="0.001667"/>
        </inertial>
        <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
        <collision>
          <origin xyz="0.015 0 0"/>
          <geometry><box size="0.1 0.1 0.1"/></geometry>
        </collision>
      </link>
    </robot>
    ```
    """

    code = "G617"
    name = "shapes-apart"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each shape that is elsewhere, or far larger, than the rest of its link."""
        for link in model.robot.links:
            extent = model.extents.get(link.name)
            if extent is None or all(shape == extent.shapes[0] for shape in extent.shapes):
                continue
            from urdfkit.lint.apart import TIMES, apart

            shapes, far, near = apart(model, link)
            for shape in shapes:
                if isinstance(shape, Visual) and _is_translucent(model, shape):
                    continue  # It shows what a sensor sees.
                box = model.box_of(shape.geometry) if isinstance(shape.geometry, Mesh) else None
                if box is not None and dist(box[1], (0.0, 0.0, 0.0)) > TIMES * near:
                    continue  # It is its scale.
                origin = shape.element.find("origin")
                is_moved = any(shape.origin.xyz) and dist(shape.origin.xyz, (0.0, 0.0, 0.0)) > far / 2.0
                yield self.at(
                    model,
                    (origin if is_moved else None) or shape.element.find("geometry") or shape.element,
                    f"a {shape.element.tag} of link `{link.name}` reaches {far:.3g} m from the centre of mass, the "
                    f"other shapes {near:.3g} m",
                    attribute="xyz" if is_moved else None,
                    link=link.name,
                    help="is a point or a unit missing?",
                )


def _is_translucent(model: Model, visual: Visual) -> bool:
    """Whether more is seen of what is behind a visual than of itself."""
    material = visual.material
    if material is not None and material.rgba is None:
        material = next((one for one in model.robot.materials if one.name == material.name), None)
    return material is not None and material.rgba is not None and material.rgba[3] < _HALF
