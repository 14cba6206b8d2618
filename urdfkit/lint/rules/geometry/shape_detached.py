"""G617 shape-detached."""

from math import dist

from urdfkit.description.urdf.robot import Collision, Link, Mesh, Sphere, Visual
from urdfkit.lint.rule import Findings, Model, RobotRule

_MIN_ALPHA = 0.5
"""Visuals with a smaller alpha are translucent."""

PLACEHOLDER = 0.002
"""Largest reach of shapes that only stand in for a missing one [m]: exporters write spheres of one millimetre."""

_MAX_HULL = 100.0
"""Ratio to the reach of the other shapes from which a sphere is a wrong unit, not a safety hull."""


class ShapeDetached(RobotRule):
    """A shape of a link is far from the other shapes of the link.

    ## What it does
    Checks for shapes that extend ten times farther from the centre of mass than the other shapes of their link, if the
    inertia of the link is also too small for this distance (by the criterion of I508). Meshes that are too large are
    reported by G604. Two kinds of shapes are not checked:

    - visual shapes that are more than half transparent, because they often represent the field of view of a sensor
    - collision spheres around the whole link, of up to a hundred times its size, because they keep obstacles away

    ## Why is this bad?
    The robot collides where nothing is visible, or passes through visible parts. The usual
    cause is a missing decimal point or a wrong unit.

    ## Example
    ```diff
     <robot name="arm">
       <link name="arm">
         <inertial>
           <mass value="1"/>
           <inertia ixx="0.001667" ixy="0" ixz="0" iyy="0.001667" iyz="0" izz="0.001667"/>
         </inertial>
         <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
         <collision>
    -      <origin xyz="15 0 0"/>
    +      <origin xyz="0.015 0 0"/>
           <geometry><box size="0.1 0.1 0.1"/></geometry>
         </collision>
       </link>
     </robot>
    ```
    """

    code = "G617"
    name = "shape-detached"
    severity = "warning"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each shape that is far from the other shapes of its link, or far larger."""
        for link in model.robot.links:
            extent = model.extents.get(link.name)
            if extent is None or all(shape == extent.shapes[0] for shape in extent.shapes):
                continue
            from urdfkit.lint.facts.detached_shapes import TIMES, detached_shapes

            shapes, far, near = detached_shapes(model, link)
            if near <= PLACEHOLDER:
                continue
            for shape in shapes:
                if isinstance(shape, Visual) and _is_translucent(model, shape):
                    continue  # It probably shows the view of a sensor.
                box = model.box_of(shape.geometry) if isinstance(shape.geometry, Mesh) else None
                if box is not None and dist(box[1], (0.0, 0.0, 0.0)) > TIMES * near:
                    continue  # Reported by G604.
                if far < _MAX_HULL * near and _is_safety_hull(link, shape, far):
                    continue
                origin = shape.element.find("origin")
                is_moved = any(shape.origin.xyz) and dist(shape.origin.xyz, (0.0, 0.0, 0.0)) > far / 2.0
                place = (origin if is_moved else None) or shape.element.find("geometry") or shape.element
                message = (
                    f"<{shape.element.tag}> of link `{link.name}` extends {far:.3g} m from the centre of mass, but the "
                )
                message += f"other shapes extend only {near:.3g} m"
                help = "check the decimal points and units of the shape"
                yield self.at(model, place, message, attribute="xyz" if is_moved else None, link=link.name, help=help)


def _is_safety_hull(link: Link, shape: Visual | Collision, far: float) -> bool:
    """Return whether a collision shape is a sphere around the whole link that repeats no visual sphere."""
    if not isinstance(shape, Collision) or not isinstance(shape.geometry, Sphere):
        return False
    radius = shape.geometry.radius or 0.0
    is_centred = dist(shape.origin.xyz, (0.0, 0.0, 0.0)) < radius and far < 2.0 * radius
    return is_centred and not any(isinstance(visual.geometry, Sphere) for visual in link.visuals)


def _is_translucent(model: Model, visual: Visual) -> bool:
    """Whether a visual is more than half transparent."""
    material = visual.material
    if material is not None and material.rgba is None:
        material = next((defined for defined in model.robot.materials if defined.name == material.name), None)
    return material is not None and material.rgba is not None and material.rgba[3] < _MIN_ALPHA
