"""S917 joint-contradicts-name."""

import re
from itertools import product

from urdfkit.description.urdf.robot import Joint
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.placement.commented_directions import contradicted_comment, stated_directions
from urdfkit.lint.facts.placement.joint_axes import axis_in_root
from urdfkit.lint.rule import Findings, Model, RobotRule

_START, _END = r"(?:(?<![A-Za-z])|(?<=[a-z])(?=[A-Z]))", r"(?![a-z])"

_SLIDES = re.compile(
    rf"{_START}(?i:slide|slider|sliding|prismatic|telescop\w*|elevator|extension|linear|rail|carriage){_END}"
)
"""Names of joints that move along a line."""

_LIFTS = re.compile(rf"{_START}(?i:lift|elevator|forks?|mast_?(?:lift|stage|extension)){_END}")
"""Names of joints that raise something."""

_ABOUT_VERTICAL = re.compile(rf"{_START}(?i:pan|yaw|turntable|slew|slewing){_END}")
_ABOUT_HORIZONTAL = re.compile(rf"{_START}(?i:tilt|pitch|knee){_END}")
"""Names of joints that turn something about the vertical, and up and down."""

_OTHER = re.compile(
    r"(?i)thumb|finger|hand|gripper|claw|index|middle|ring|little|pinky|wrist|arm|shoulder|elbow|blade|rotor|prop|wing"
    r"|wheel|caster|flap|crank|belt|pulley|screw|gear|spring|^roll|(?<=_)roll|_\d\d[lr]?$"
)
"""Names of parts that may have any direction at zero: hands (also with numbered fingers), arms, blades, mechanisms."""

_BELOW = 0.1
"""Largest part of the height of a hanging part that is above its joint."""

_ALONG, _ACROSS = 0.9, 0.2
"""Cosine of the angle to the vertical: at least the first for vertical axes, at most the second for horizontal ones."""


class JointContradictsName(RobotRule):
    """The motion of a joint contradicts its name, or the comment before it.

    ## What it does
    Compares the type and the axis of joints with the words in their names, with all joints at position zero:

    - A ``slide``, ``prismatic``, ``telescope``, ``elevator``, ``linear``, ``rail`` or ``carriage`` joint does not
      rotate.
    - A prismatic ``lift``, ``elevator`` or ``fork`` moves vertically, and upwards if all its positions are positive,
      unless its child hangs below the joint. A revolute ``lift``, ``elevator`` or ``fork`` does not have a vertical
      axis.
    - ``pan``, ``yaw``, ``slew`` and ``turntable`` joints rotate about a vertical axis; ``tilt``, ``pitch`` and ``knee``
      joints do not.

    Joints of hands, arms, wheels and rotors are not checked, because their axes may have any direction with all joints
    at zero.

    A comment directly before the joint, or before its macro call, may state the direction of positive positions, such
    as ``positive is up``. A joint is reported if it moves the parts in the opposite direction.

    ## Why is this bad?
    The part moves in an unexpected direction: the camera rolls instead of looking to the side, or the lift swings
    through the robot.

    ## Example
    ```diff
     <robot name="head">
       <link name="base">
         <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
       </link>
       <link name="neck">
         <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
       </link>
       <joint name="head_pan_joint" type="revolute">
         <parent link="base"/><child link="neck"/><origin xyz="0 0 0.3"/>
    -    <axis xyz="0 1 0"/>
    +    <axis xyz="0 0 1"/>
         <limit lower="-1.5" upper="1.5" effort="5" velocity="2"/>
       </joint>
     </robot>
    ```
    """

    code = "S917"
    name = "joint-contradicts-name"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that moves differently from what its name suggests."""
        if model.is_incomplete:
            return
        stated = stated_directions(model)
        for joint in model.robot.joints:
            if not joint.is_movable or joint.child not in model.robot.link_by_name:
                continue
            fault = None if _OTHER.search(joint.name) else _fault(joint, model)
            if stated and fault is None and (words := contradicted_comment(joint, model, stated)):
                element = joint.element.find("axis") or joint.element
                message = f"joint `{joint.name}` moves opposite to the direction in its comment, `{words}`"
                help = "check the signs of <axis> and of the rpy of <origin>, or correct the comment"
                yield self.at(model, element, message, attribute="xyz", joint=joint.name, help=help)
            if fault is not None:
                message, element, attribute = fault
                help = "check <axis> and the rpy of <origin>, or correct the name"
                names = tuple(name for name in (joint.parent, joint.child) if name)
                yield self.at(model, element, message, attribute=attribute, joint=joint.name, help=help, names=names)


def _fault(joint: Joint, model: Model) -> tuple[str, Element, str] | None:
    """Return the fault of the motion of a joint, the element with it, and its attribute; None if it suits the name."""
    turns = joint.type in ("revolute", "continuous")
    if turns and _SLIDES.search(joint.name):
        return f"joint `{joint.name}` rotates, but its name suggests that it slides", joint.element, "type"
    about_vertical, about_horizontal = _ABOUT_VERTICAL.search(joint.name), _ABOUT_HORIZONTAL.search(joint.name)
    lifts = _LIFTS.search(joint.name)
    if not (about_vertical or about_horizontal or lifts) or (about_vertical and (about_horizontal or lifts)):
        return None
    axis = axis_in_root(joint, model)
    if axis is None:
        return None
    is_vertical, is_horizontal = abs(axis[2]) > _ALONG, abs(axis[2]) < _ACROSS
    element = joint.element.find("axis") or joint.element
    if about_vertical is not None and turns and is_horizontal:
        return f"joint `{joint.name}` rotates about a horizontal axis instead of a vertical one", element, "xyz"
    if about_horizontal is not None and turns and is_vertical:
        return f"joint `{joint.name}` rotates about a vertical axis instead of a horizontal one", element, "xyz"
    if lifts is not None and turns and is_vertical:
        return f"joint `{joint.name}` rotates about a vertical axis, so it cannot lift", element, "xyz"
    if lifts is not None and joint.type == "prismatic" and is_horizontal:
        return f"joint `{joint.name}` slides horizontally, so it cannot lift", element, "xyz"
    limit = joint.limit
    is_upward = limit is not None and limit.lower is not None and limit.lower >= 0.0 and (limit.upper or 0.0) > 0.0
    slides_down = joint.type == "prismatic" and axis[2] < -_ALONG and is_upward
    if lifts is not None and slides_down and not _hangs(joint, model):
        return f"joint `{joint.name}` slides down at positive positions, so it cannot lift", element, "xyz"
    return None


def _hangs(joint: Joint, model: Model) -> bool:
    """Return whether all shapes of the child of a joint are below the joint, such as a mast that hangs from a rail."""
    frame, extent = model.frames.get(joint.child or ""), model.extents.get(joint.child or "")
    if frame is None or extent is None:
        return False
    corners = product(*zip(extent.low, extent.high, strict=True))
    heights = [sum(a * b for a, b in zip(frame.rotation[2], corner, strict=True)) for corner in corners]
    return max(heights) < _BELOW * (max(heights) - min(heights))
