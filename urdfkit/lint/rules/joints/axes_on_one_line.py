"""J428 axes-on-one-line."""

import re
from collections import Counter

from urdfkit.lint.rule import Findings, Model, RobotRule

_SPINNING = r"(?i)lidar|laser|scan|velodyne|rotor|propell|fan|wheel|cast[eo]r|swivel|roller|brush|motor|gear"
"""Names of parts that spin on their own, on whatever carries them."""


class AxesOnOneLine(RobotRule):
    """Two consecutive joints turn about the same line.

    ## What it does
    Checks for a ``revolute`` or ``continuous`` joint whose axis is on the same line as the axis of the moving joint
    that carries it. Mimic joints and parts that spin on their own, such as wheels, rotors and lidars, are not checked.
    If three joints are on one line, the middle joint is reported.

    ## Why is this bad?
    Both joints make the same motion, so the robot has fewer degrees of freedom than joints, and inverse kinematics has
    no unique solution. Usually the ``<axis>`` was copied from the neighbouring joint.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
       </link>
       <link name="upper">
         <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
       </link>
       <link name="lower">
         <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
       </link>
       <joint name="shoulder" type="revolute">
         <parent link="base"/><child link="upper"/>
         <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="10" velocity="1"/>
       </joint>
       <joint name="elbow" type="revolute">
         <parent link="upper"/><child link="lower"/><origin xyz="0 0 0.3"/>
    -    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="10" velocity="1"/>
    +    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="1"/>
       </joint>
     </robot>
    ```
    """

    code = "J428"
    name = "axes-on-one-line"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that repeats the motion of a neighbour."""
        from urdfkit.lint.facts.placement.joint_axes import on_one_line

        if model.is_incomplete:
            return
        pairs = [
            pair
            for pair in on_one_line(model)
            if not any(re.search(_SPINNING, f"{joint.name} {joint.child}") for joint in pair)
        ]
        counts = Counter(joint.name for pair in pairs for joint in pair)
        found: set[str] = set()
        for upper, lower in pairs:
            if found & {upper.name, lower.name}:
                continue
            joint = upper if counts[upper.name] > counts[lower.name] else lower
            found.add(joint.name)
            names = f"`{upper.name}` and `{lower.name}`"
            message = f"joints {names} turn about the same line, so one of them is redundant"
            element = joint.element.find("axis") or joint.element
            help = "check <axis> and the rpy of <origin>"
            yield self.at(model, element, message, attribute="xyz", joint=joint.name, help=help)
