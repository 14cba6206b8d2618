"""J429 effort-below-weight."""

from urdfkit.lint.facts.placement.joint_axes import axis_in_root
from urdfkit.lint.model.placement import links_below
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_GRAVITY = 9.8
"""Acceleration of gravity in Gazebo's default world [m/s²] (SDFormat, world.sdf)."""

_UPRIGHT = 0.9
"""Smallest vertical component of the axis of a joint that lifts."""


class EffortBelowWeight(RobotRule):
    """A lift is too weak for its load.

    ## What it does
    Compares the effort limit of each ``prismatic`` joint with the weight of all links that the joint carries, if the
    axis of the joint is vertical while every joint is at zero. Effort limits of zero and links without a mass are not
    reported here.

    ## Why is this bad?
    The lift sinks in simulation, regardless of the commands of its controller. Usually a digit of the effort limit or
    of a mass is wrong.

    ## Example
    ```diff
     <robot name="lift">
       <link name="base">
         <inertial><mass value="30"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
       </link>
       <link name="platform">
         <inertial><mass value="20"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
       </link>
       <joint name="lift_joint" type="prismatic">
         <parent link="base"/><child link="platform"/><axis xyz="0 0 1"/>
    -    <limit lower="0" upper="0.4" effort="50" velocity="0.1"/>
    +    <limit lower="0" upper="0.4" effort="500" velocity="0.1"/>
       </joint>
     </robot>
    ```
    """

    code = "J429"
    name = "effort-below-weight"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each lift that its effort limit cannot hold."""
        if model.is_incomplete:
            return
        for joint in model.robot.joints:
            effort = (joint.limit.effort or 0.0) if joint.type == "prismatic" and joint.limit is not None else 0.0
            axis = axis_in_root(joint, model) if effort > 0.0 and joint.mimic is None else None
            if axis is None or abs(axis[2]) < _UPRIGHT or joint.limit is None:
                continue
            names = links_below(model.robot, joint.child or "")
            carried = [link for name, link in model.robot.link_by_name.items() if name in names]
            mass = sum((link.inertial.mass or 0.0) if link.inertial is not None else 0.0 for link in carried)
            if effort < mass * _GRAVITY * abs(axis[2]):
                message = f"effort limit {effort:g} N of joint `{joint.name}` is less than the weight of its load, "
                message += f"{mass * _GRAVITY:.4g} N ({mass:.4g} kg)"
                loaded = tuple(link.name for link in carried)
                yield self.at(model, joint.limit.element, message, attribute="effort", joint=joint.name, names=loaded)
