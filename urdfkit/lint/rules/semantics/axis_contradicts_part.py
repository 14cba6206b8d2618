"""S904 axis-contradicts-part."""

import re

from urdfkit.description.urdf.geometry import rotate, rotation_of, unit
from urdfkit.description.urdf.robot import Cylinder, Joint, Vector
from urdfkit.lint.facts.placement.joint_axes import axis_in_root
from urdfkit.lint.facts.placement.mirrored_chains import asymmetric_axis, odd_axis
from urdfkit.lint.facts.twins import Twins, links_of, twins
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.placement import shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_MIN_UPRIGHT = 0.7
"""Cosine of the largest angle between an axis and the vertical at which the axis is about vertical (45 degrees)."""

_MAX_ACROSS = 0.2
"""Cosine of an angle at which two lines are about perpendicular."""

_UNLIKE = 0.3
"""Difference of the components of two unit axes along different lines."""

_OTHER = r"(?i)cast[eo]r|swivel|steer|fork|roll|pan|yaw|rotac|suspension"
"""Names of joints next to wheels that turn about other axes, and of wheels that turn freely."""


class AxisContradictsPart(RobotRule):
    """The axis of a steering joint or wheel joint has an implausible direction.

    ## What it does
    Checks the axes with every joint at zero. Joints with ``steer`` in their names must have an approximately vertical
    axis. Continuous joints of wheels must have an approximately horizontal axis that is not perpendicular to the line
    from the wheel to its counterpart on the other side. Casters, forks and rollers are not checked. Also reports
    counterparts, such as ``left_wheel_joint`` and ``right_wheel_joint``, whose axes are not parallel, and front and
    rear wheels of one side that turn in opposite directions. If a single joint of two mirrored chains, such as arms or
    legs, has an axis that is not mirrored, this joint is reported.

    ## Why is this bad?
    The wheel tumbles or scrapes over the ground instead of rolling, or the robot does not steer.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
         <inertial>
           <mass value="8"/>
           <inertia ixx="0.0667" ixy="0" ixz="0" iyy="0.1733" iyz="0" izz="0.2267"/>
         </inertial>
       </link>
       <link name="left_wheel">
         <inertial><mass value="1"/><inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial>
       </link>
       <link name="right_wheel">
         <inertial><mass value="1"/><inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial>
       </link>
       <joint name="left_wheel_joint" type="continuous">
    -    <parent link="base"/><child link="left_wheel"/><origin xyz="0 0.2 0"/><axis xyz="1 0 0"/>
    +    <parent link="base"/><child link="left_wheel"/><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/>
       </joint>
       <joint name="right_wheel_joint" type="continuous">
    -    <parent link="base"/><child link="right_wheel"/><origin xyz="0 -0.2 0"/><axis xyz="1 0 0"/>
    +    <parent link="base"/><child link="right_wheel"/><origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```
    """

    code = "S904"
    name = "axis-contradicts-part"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint with a wrong axis."""
        if model.is_incomplete:
            return
        pairs = [pair for pair in twins(model) if pair.first.is_movable and links_of(pair, model) is not None]
        partners = {joint.name: pair for pair in pairs if pair.are_sides for joint in (pair.first, pair.second)}
        found: set[str] = set()
        for joint in model.robot.joints:
            is_whole = joint.is_movable and joint.child in model.robot.link_by_name
            axis = axis_in_root(joint, model) if is_whole else None
            message = _defect(joint, axis, partners.get(joint.name), model) if axis is not None else None
            if message is not None and (joint.name in partners or not _is_disc(joint, model)):
                found.add(joint.name)
                yield self._at(joint, message, model)
        for pair in pairs:
            first, second = pair.first, pair.second
            message = None if found & {first.name, second.name} else _contradiction(pair)
            if message is not None and not (_is_disc(first, model) and _is_disc(second, model)):
                found |= {first.name, second.name}
                wrong = _odd_one(pair, pairs, model)
                yield self._at(wrong, message, model, (first.name, second.name), _place(pair))

        unlike = asymmetric_axis(model) if not found else None
        if unlike is not None:
            wrong, right = unlike
            message = f"the axes of `{wrong.name}` and `{right.name}` are not mirrored, unlike the axes of "
            message += "all other joints on the two sides"
            yield self._at(wrong, message, model, (wrong.name, right.name))

    def _at(
        self, joint: Joint, message: str, model: Model, names: tuple[str, ...] = (), place: str = "axis"
    ) -> Finding:
        element = joint.element.find(place) or joint.element
        attribute = "rpy" if place == "origin" else "xyz"
        help = "check <axis> and the rpy of <origin>"
        return self.at(model, element, message, attribute=attribute, joint=joint.name, help=help, names=names)


def _odd_one(pair: Twins, pairs: list[Twins], model: Model) -> Joint:
    """Return the joint of a pair whose axis differs from that of more counterparts."""
    odd = dict.fromkeys((pair.first.name, pair.second.name), 0)
    for each in pairs:
        for joint, other in ((each.first, each.second), (each.second, each.first)):
            if joint.name in odd and _cosine(_axis_in_parent(joint), _axis_in_parent(other)) < _MIN_UPRIGHT:
                odd[joint.name] += 1
    if pair.second.element.find(_place(pair)) is None:
        return pair.first
    if odd[pair.first.name] == odd[pair.second.name]:
        return odd_axis(pair.first, pair.second, model)
    return pair.first if odd[pair.first.name] > odd[pair.second.name] else pair.second


def _place(pair: Twins) -> str:
    """Return the tag of the element in which the joints of a pair differ."""
    return "origin" if pair.first.axis == pair.second.axis else "axis"


def _defect(joint: Joint, axis: Vector, pair: Twins | None, model: Model) -> str | None:
    """Return the fault of the axis of a steering joint or wheel; None if it suits its part."""
    name = f"{joint.name} {joint.child}"
    if re.search(r"steer(?!ing_?wheel)", joint.name, re.IGNORECASE):
        return f"axis of steering joint `{joint.name}` is not vertical" if abs(axis[2]) < _MIN_UPRIGHT else None
    if joint.type != "continuous" or not re.search("wheel", name, re.IGNORECASE) or re.search(_OTHER, name):
        return None
    if abs(axis[2]) > _MIN_UPRIGHT:
        return f"axis of wheel joint `{joint.name}` is vertical"
    if pair is None:
        return None
    x, y, z = (a - b for a, b in zip(pair.first.origin.xyz, pair.second.origin.xyz, strict=True))
    between = unit((x, y, z))
    frame = model.frames.get(joint.parent or "")
    if between is None or frame is None:
        return None
    along = abs(sum(a * b for a, b in zip(axis, rotate(frame.rotation, between), strict=True)))
    if along > _MAX_ACROSS:
        return None
    ends = f"`{pair.first.name}` to `{pair.second.name}`"
    return f"axis of wheel joint `{joint.name}` is perpendicular to the line from {ends}"


def _contradiction(pair: Twins) -> str | None:
    """Return how the axes of twins contradict each other; None if they do not."""
    first, second = pair.first, pair.second
    in_parent = [_axis_in_parent(joint) for joint in (first, second)]
    names = f"`{first.name}` and `{second.name}`"
    both = ((first.axis, second.axis), tuple(in_parent))
    if all(max(abs(abs(a) - abs(b)) for a, b in zip(*axes, strict=True)) > _UNLIKE for axes in both):
        return f"the axes of {names} are not parallel"
    cosine = _cosine(*in_parent)
    if first.type == "continuous" and not pair.are_sides and cosine < -_MIN_UPRIGHT and "heel" in first.name:
        return f"the axes of {names} point in opposite directions"
    return None


def _axis_in_parent(joint: Joint) -> Vector:
    return rotate(rotation_of(joint.origin.rpy), joint.axis)


def _cosine(first: Vector, second: Vector) -> float:
    return sum(a * b for a, b in zip(first, second, strict=True))


def _is_disc(joint: Joint, model: Model) -> bool:
    """Return whether a wheel has the shape of a disc, whose axis J414 checks."""
    link = model.robot.link_by_name.get(joint.child or "")
    shapes = [shape.geometry for shape in shapes_of(link)] if link is not None else []
    return bool(shapes) and all(isinstance(one, Cylinder) and one.length < 2.0 * one.radius for one in shapes)
