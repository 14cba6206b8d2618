"""J422 stroke-too-long."""

from math import dist

from urdfkit.lint.model.placement import shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_TIMES = 3.0
"""Ratio of a limit to the size of the robot that only another unit explains."""

_SYMMETRIC = 0.1
"""Largest ratio of the mean of two limits to their difference in a symmetric range."""

_MIN_STROKE = 1.0
"""Shortest stroke that is checked [m]."""


class StrokeTooLong(RobotRule):
    """A prismatic joint moves much farther than the robot extends.

    ## What it does
    Compares the limits of ``prismatic`` joints with the size of the robot with every joint at zero. Reports limits
    of more than three times that size. Joints of a parent link without shapes are not checked, because they often
    place the robot in the world.

    ## Why is this bad?
    Limits of prismatic joints are in metres: a stroke of 30 is 30 m. Usually the limit was written in millimetres,
    and the joint never reaches it.

    ## Example
    ```diff
     <robot name="gripper">
       <link name="palm">
         <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
         <inertial><mass value="0.5"/>
           <inertia ixx="0.000833" ixy="0" ixz="0" iyy="0.000833" iyz="0" izz="0.000833"/>
         </inertial>
       </link>
       <link name="finger">
         <inertial>
           <mass value="0.05"/>
           <inertia ixx="1.54e-05" ixy="0" ixz="0" iyy="1.67e-05" iyz="0" izz="2.08e-06"/>
         </inertial>
       </link>
       <joint name="finger_joint" type="prismatic">
         <parent link="palm"/><child link="finger"/>
         <origin xyz="0 0.01 0.08"/>
         <axis xyz="0 1 0"/>
    -    <limit lower="0" upper="30" effort="20" velocity="0.2"/>
    +    <limit lower="0" upper="0.03" effort="20" velocity="0.2"/>
       </joint>
     </robot>
    ```
    """

    code = "J422"
    name = "stroke-too-long"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each prismatic joint with a limit that is far larger than the robot."""
        joints = [joint for joint in model.robot.joints if joint.type == "prismatic" and joint.limit is not None]
        if not joints or model.is_incomplete:
            return
        size = _size(model)
        for joint in joints:
            limit, parent = joint.limit, model.robot.link_by_name.get(joint.parent or "")
            if limit is None or parent is None or not shapes_of(parent):
                continue
            for side in ("upper", "lower"):
                value = abs(getattr(limit, side) or 0.0)
                if size > 0.0 and value >= max(_MIN_STROKE, _TIMES * size):
                    message = f"{side} limit of joint `{joint.name}` is {getattr(limit, side):g} m, "
                    message += f"but the whole robot extends {size:.3g} m"
                    help = "write limits of prismatic joints in metres"
                    yield self.at(model, limit.element, message, attribute=side, joint=joint.name, help=help)
                    break
            else:
                lower, upper = limit.lower or 0.0, limit.upper or 0.0
                is_symmetric = lower < 0.0 < upper and abs(lower + upper) < _SYMMETRIC * (upper - lower)
                if size > 0.0 and is_symmetric and upper - lower >= max(_MIN_STROKE, _TIMES * size):
                    message = f"joint `{joint.name}` slides from {lower:g} to {upper:g} m, "
                    message += f"but the whole robot extends {size:.3g} m"
                    help = "write the limits in metres, or use the type of a joint that turns"
                    yield self.at(model, limit.element, message, joint=joint.name, help=help)


def _size(model: Model) -> float:
    """Return the size of the robot with every joint at zero: of its frames and of the shapes around them [m]."""
    places = [frame.translation for frame in model.frames.values()]
    if not places:
        return 0.0
    frames = dist(*(tuple(pick(axis) for axis in zip(*places, strict=True)) for pick in (min, max)))
    return frames + max((extent.diagonal for extent in model.extents.values()), default=0.0)
