"""I513 com-outside-geometry."""

from math import dist

from urdfkit.description.urdf.robot import Link
from urdfkit.lint.model.placement import Extent, shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

TOLERANCE = 0.1
"""Tolerance relative to the diagonal of the bounding box; simplified shapes omit parts of the body."""

MIN_TOLERANCE = 0.005
"""[m] Smallest tolerance."""

TOLERANCE_WITHOUT_VISUALS = 1.0
"""Tolerance for links without visuals, whose collision shapes often cover only a part of the body."""

OFF_CENTRE = 0.1
"""Distance of the centre of mass from the centre of the shape, relative to the diagonal of the bounding box."""

SAME = 0.02
"""Largest relative difference of moments of inertia that belong to a shape."""

MIN_MASS = 0.01
"""[kg] Smaller masses of links without visuals are placeholders."""


class ComOutsideGeometry(RobotRule):
    """The centre of mass of a link is outside its shapes.

    ## What it does
    Compares the ``<origin>`` of ``<inertial>`` with the bounding box of all visual and collision shapes of the link. A
    centre of mass inside the box is reported in two cases:

    - The link has a single shape and the inertia of this shape, but the centre of mass is not the centre of the shape.
    - The link has several shapes, and the centre of mass would be the centre of one of them if the sign of one
      coordinate changed.

    Collision shapes often cover only a part of the body. Therefore, a link without visual shapes is reported only if
    the distance exceeds the diagonal of the box. Links with an unreadable mesh are not checked.

    ## Why is this bad?
    The robot tips over, or swings as if its mass were next to it. The usual cause is an origin of the shape that was
    not copied to ``<inertial>``.

    ## Example
    ```diff
     <robot name="cart">
       <link name="chassis">
         <inertial>
    +      <origin xyz="0 0 0.15"/>
           <mass value="1"/>
           <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
         </inertial>
         <visual>
           <origin xyz="0 0 0.15"/>
           <geometry><box size="0.3 0.2 0.1"/></geometry>
         </visual>
       </link>
     </robot>
    ```
    """

    code = "I513"
    name = "com-outside-geometry"
    severity = "warning"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each centre of mass outside the shapes."""
        for link in model.robot.links:
            inertial = link.inertial
            if inertial is None or not inertial.mass or inertial.mass < 0.0:
                continue
            extent = model.extents.get(link.name)
            if extent is None:
                continue
            if not link.visuals and inertial.mass < MIN_MASS:
                continue
            distance = extent.outside(inertial.origin.xyz)
            yield from self._off_centre(model, link, extent)
            mirrored = list(self._mirrored(model, link, extent))
            yield from mirrored
            if not mirrored and distance > max(
                (TOLERANCE if link.visuals else TOLERANCE_WITHOUT_VISUALS) * extent.diagonal, MIN_TOLERANCE
            ):
                origin = inertial.element.find("origin")
                yield self.at(
                    model,
                    origin or inertial.element,
                    f"centre of mass of link `{link.name}` is {distance:.3g} m outside its shapes",
                    attribute="xyz" if origin is not None else None,
                    link=link.name,
                    help="correct the <origin> of <inertial>"
                    if any(inertial.origin.xyz)
                    else "copy the <origin> of the shape to <inertial>",
                )

    def _mirrored(self, model: Model, link: Link, extent: Extent) -> Findings:
        """Yield a finding for a centre of mass that is that of a shape with the other sign of one coordinate."""
        inertial, shapes = link.inertial, shapes_of(link)
        if inertial is None or len({shape.origin.xyz for shape in shapes}) < 2:
            return  # The other two checks compare it with a single shape.
        centre = inertial.origin.xyz
        same = max(map(abs, centre)) * SAME
        for shape in shapes:
            pairs = list(zip(centre, shape.origin.xyz, strict=True))
            opposite = [k for k, (a, b) in enumerate(pairs) if abs(a) > MIN_TOLERANCE and abs(a + b) <= SAME * abs(a)]
            if len(opposite) == 1 and sum(abs(a - b) <= same for a, b in pairs) == 2:
                origin, k = inertial.element.find("origin"), opposite[0]
                others = [
                    pose.xyz[k] for other, (_, pose) in zip(shapes, extent.shapes, strict=False) if other is not shape
                ]
                if others and all(abs(other - centre[k]) < 0.2 * abs(centre[k]) for other in others):
                    kind = "collision" if shape in link.collisions else "visual"
                    message = f"{kind} shape of link `{link.name}` has {'xyz'[k]} = {-centre[k]:g} m, but its other "
                    message += f"shape and its centre of mass have {'xyz'[k]} = {centre[k]:g} m"
                    place, help = shape.element.find("origin") or shape.element, "check the sign of the <origin>"
                    yield self.at(model, place, message, attribute="xyz", link=link.name, help=help)
                    return
                message = f"centre of mass of link `{link.name}` has {'xyz'[k]} = {centre[k]:g} m, "
                message += f"but the centre of the shape has {'xyz'[k]} = {-centre[k]:g} m"
                help = "check the sign of the <origin> of <inertial>"
                yield self.at(model, origin or inertial.element, message, attribute="xyz", link=link.name, help=help)
                return

    def _off_centre(self, model: Model, link: Link, extent: Extent) -> Findings:
        """Yield a finding for a centre of mass away from the centre of the shape to which the inertia belongs."""
        from urdfkit.lint.facts.inertia.inertia_from_shapes import tensor_of

        inertial, (shape, pose) = link.inertial, extent.shapes[0]
        if inertial is None or inertial.inertia is None or any(each != (shape, pose) for each in extent.shapes):
            return
        origin, distance = inertial.element.find("origin"), dist(inertial.origin.xyz, pose.xyz)
        is_outside = extent.outside(inertial.origin.xyz) > max(TOLERANCE * extent.diagonal, MIN_TOLERANCE)
        if is_outside or distance <= max(OFF_CENTRE * extent.diagonal, MIN_TOLERANCE) or not inertial.mass:
            return
        computed = tensor_of(link, extent, inertial.mass)
        written = [getattr(inertial.inertia, name) for name in ("ixx", "iyy", "izz")]
        if computed is None or not all(
            abs(a - b) <= SAME * max(abs(b), 1e-12)
            for a, b in zip(written, (computed[0], computed[3], computed[5]), strict=True)
        ):
            return
        place = origin or inertial.element
        message = (
            f"centre of mass of link `{link.name}` is {distance:.3g} m from the centre of the shape with this inertia"
        )
        help = "copy the <origin> of the shape to <inertial>"
        yield self.at(model, place, message, attribute="xyz" if origin is not None else None, link=link.name, help=help)
