"""J414 axis-not-along-wheel."""

from urdfkit.description.urdf.geometry import rotate, rotation_of, unit
from urdfkit.description.urdf.robot import Cylinder, Joint, Mesh, Vector
from urdfkit.description.xml.numbers import numbers
from urdfkit.lint.model.placement import shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

PARALLEL = 0.985
"""Cosine of 10 degrees, the largest accepted deviation, so that cambered wheels pass."""


class AxisNotAlongWheel(RobotRule):
    """The axis of a wheel joint is not the axis of the wheel.

    ## What it does
    Compares the axis of each continuous joint with the symmetry axis of its child link. The rule checks a link if all
    its shapes are discs, that is, cylinders that are wider than they are long. A link whose name contains ``wheel`` is
    also checked if it has meshes. Deviations of up to 10 degrees, such as the camber of a wheel, are accepted.

    ## Why is this bad?
    The wheel tumbles instead of rolling, and the robot does not drive.

    ## Example
    ```diff
     <robot name="cart">
       <link name="world"/>
       <link name="wheel">
         <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
         <visual>
           <origin rpy="1.5707963267948966 0 0"/>
           <geometry><cylinder radius="0.1" length="0.04"/></geometry>
         </visual>
       </link>
       <joint name="axle" type="continuous">
         <parent link="world"/>
         <child link="wheel"/>
    -    <axis xyz="0 0 1"/>
    +    <axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```
    """

    code = "J414"
    name = "axis-not-along-wheel"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each wheel whose axis is off by more than 10 degrees."""
        for joint in model.robot.joints:
            axis = unit(joint.axis)
            wheel = model.robot.link_by_name.get(joint.child or "")
            if joint.type != "continuous" or wheel is None or axis is None:
                continue
            axis_element = joint.element.find("axis")
            if axis_element is not None and len(numbers(axis_element.get("xyz") or "1 0 0") or ()) != 3:
                continue  # The axis is malformed: reported by bad-number or wrong-arity.
            discs = [
                tuple(row[2] for row in rotation_of(shape.origin.rpy))
                for shape in shapes_of(wheel)
                if isinstance(shape.geometry, Cylinder) and shape.geometry.length < 2.0 * shape.geometry.radius
            ]
            others = [shape for shape in shapes_of(wheel) if not isinstance(shape.geometry, Mesh)]
            is_wheel = "wheel" in f"{joint.name} {wheel.name}".lower()
            if not discs or len(discs) != (len(others) if is_wheel else len(shapes_of(wheel))):
                continue  # The link has other shapes, and any of them may be the wheel.
            cosines = [abs(sum(a * b for a, b in zip(axis, disc, strict=True))) for disc in discs]
            if max(cosines) < PARALLEL:
                forward_axis = _forward_axis(model, joint, discs[0])
                expected = " ".join(f"{round(part, 3) + 0.0:g}" for part in forward_axis)
                place, attribute = joint.element.find("axis") or joint.element, "xyz"
                if _is_across(joint, axis, model):
                    shape = next(each for each in shapes_of(wheel) if isinstance(each.geometry, Cylinder))
                    place, attribute = shape.element.find("origin") or shape.element, "rpy"
                message = f"joint `{joint.name}` does not turn the wheel `{wheel.name}` about the axis of the wheel, "
                message += f"{expected} in the joint frame"
                help = f'write <axis xyz="{expected}"/>, or rotate the shape: a cylinder extends along its z axis'
                yield self.at(model, place, message, attribute=attribute, joint=joint.name, help=help)


def _is_across(joint: Joint, axis: Vector, model: Model) -> bool:
    """Return whether the axis of a wheel points to the wheel on the other side, so that its shape is wrong."""
    from urdfkit.lint.facts.twins import mirrored

    for name in mirrored(joint.name):
        other = model.robot.joint_by_name.get(name)
        if other is not None and other.parent == joint.parent:
            (x, y, z), (x2, y2, z2) = joint.origin.xyz, other.origin.xyz
            offset = unit((x2 - x, y2 - y, z2 - z))
            across = rotate(rotation_of(joint.origin.rpy), axis)
            if offset is not None and abs(sum(a * b for a, b in zip(offset, across, strict=True))) > PARALLEL:
                return True
    return False


def _forward_axis(model: Model, joint: Joint, axis: tuple[float, ...]) -> Vector:
    """Return the axis with the sign that makes positive rotation drive forward, where y points left (REP 103)."""
    x, y, z = axis
    parent = model.frames.get(joint.parent or "")
    frame = parent.moved(joint.origin) if parent is not None else None
    axis_in_root = rotate(frame.rotation, (x, y, z)) if frame is not None else (x, y, z)
    largest = max(axis_in_root, key=abs)
    return (x, y, z) if largest > 0.0 else (-x, -y, -z)
