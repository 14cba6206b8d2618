"""G615 visual-offset-from-wheel-axis."""

from urdfkit.description.urdf.geometry import rotation_of, unit
from urdfkit.description.urdf.robot import Cylinder, Sphere, Vector
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule


class WheelOffItsAxis(RobotRule):
    """A wheel is drawn off its axis of rotation.

    ## What it does
    Checks the child links of continuous joints, and of joints without a type, if the only visual shape is a sphere or a
    cylinder along the axis. The centre of the shape must lie on the axis. A sphere is accepted if the collision shape
    has the same offset, because the link is probably a swivel caster.

    ## Why is this bad?
    The wheel orbits its axis instead of rolling. The usual cause is an origin that was copied from another link. The
    offset of a wheel belongs to the ``<origin>`` of its joint.

    ## Example
    ```diff
     <robot name="cart">
       <link name="world"/>
       <link name="wheel">
         <inertial><mass value="1"/><inertia ixx="0.0008" ixy="0" ixz="0" iyy="0.0008" iyz="0" izz="0.0013"/></inertial>
         <visual>
    -      <origin xyz="0.15 0 0.075"/>
           <geometry><cylinder radius="0.05" length="0.04"/></geometry>
         </visual>
         <collision><geometry><cylinder radius="0.05" length="0.04"/></geometry></collision>
       </link>
       <joint name="axle" type="continuous">
         <parent link="world"/>
         <child link="wheel"/>
         <origin xyz="0 0.2 0" rpy="-1.5707963267948966 0 0"/>
         <axis xyz="0 0 1"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix sets the origin to zero, but the origin of the joint may be the wrong one.
    """

    code = "G615"
    name = "visual-offset-from-wheel-axis"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each wheel that is off its axis by more than a tenth of its radius."""
        for joint in model.robot.joints:
            wheel = model.robot.link_by_name.get(joint.child or "")
            if wheel is None or joint.type not in ("continuous", None) or len(wheel.visuals) != 1:
                continue
            visual = wheel.visuals[0]
            shape, offset = visual.geometry, visual.origin.xyz
            axis = unit(joint.axis) if joint.type is not None or joint.element.find("axis") is not None else None
            if isinstance(shape, Cylinder) and shape.length < 2.0 * shape.radius and axis is not None:
                along = tuple(row[2] for row in rotation_of(visual.origin.rpy))
                if abs(sum(a * b for a, b in zip(along, axis, strict=True))) < 0.985:
                    continue  # A swivel caster, or reported by J414.
            elif not isinstance(shape, Sphere) or any(c.origin.xyz == offset for c in wheel.collisions):
                continue
            distance = _distance(axis, offset)
            if distance > 0.1 * shape.radius:
                origin = visual.element.find("origin") or visual.element
                message = f"wheel `{wheel.name}` is drawn {distance:.3g} m off the axis of joint `{joint.name}`"
                help = "move the offset to the <origin> of the joint"
                fix = new_value(model, origin, "xyz", "0 0 0", "unsafe", "Centre the wheel on its axis")
                yield self.at(
                    model, origin, message, attribute="xyz", link=wheel.name, joint=joint.name, help=help, fix=fix
                )


def _distance(axis: Vector | None, offset: Vector) -> float:
    """Return the distance of a point from an axis through the origin, or from the origin [m]."""
    along = sum(a * b for a, b in zip(axis, offset, strict=True)) if axis is not None else 0.0
    return float(max(sum(part * part for part in offset) - along * along, 0.0) ** 0.5)
