"""J425 dynamics-exceed-effort."""

from urdfkit.lint.rule import Findings, Model, RobotRule

_PART = 0.02
"""Smallest part of the velocity limit that the effort limit must reach against the damping."""


class DynamicsExceedEffort(RobotRule):
    """The friction or damping of a joint is too large for its effort limit.

    ## What it does
    Compares ``friction``, and the effort of ``damping`` at the velocity limit, with the effort limit. Reports joints
    that the effort limit cannot move, or can move only at less than 2 % of the velocity limit.

    ## Why is this bad?
    The joint does not move in simulation although its controller works. Usually a decimal point or a unit is wrong.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="continuous">
         <parent link="base"/>
         <child link="arm"/>
         <limit effort="10" velocity="2"/>
    -    <dynamics damping="5000"/>
    +    <dynamics damping="0.5"/>
       </joint>
     </robot>
    ```
    """

    code = "J425"
    name = "dynamics-exceed-effort"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that its effort limit cannot move."""
        for joint in model.robot.joints:
            limit, dynamics = joint.limit, joint.dynamics
            if dynamics is None or limit is None or not limit.effort or not limit.velocity:
                continue
            effort, velocity = limit.effort, limit.velocity
            if min(effort, velocity) <= 0.0 or model.is_unresolved(dynamics.element):
                continue
            force, speed = ("N", "m/s") if joint.type == "prismatic" else ("N·m", "rad/s")
            if dynamics.friction > effort:
                message = f"friction {dynamics.friction:g} {force} of joint `{joint.name}` exceeds its effort"
                message += f" limit of {effort:g} {force}"
                yield self.at(model, dynamics.element, message, attribute="friction", joint=joint.name)
            elif dynamics.damping > 0.0 and effort < _PART * velocity * dynamics.damping:
                message = f"damping {dynamics.damping:g} of joint `{joint.name}` limits the velocity to"
                message += f" {effort / dynamics.damping:.2g} {speed} at its effort limit; its velocity limit is"
                message += f" {velocity:g} {speed}"
                help = "check the decimal point of the damping"
                yield self.at(model, dynamics.element, message, attribute="damping", joint=joint.name, help=help)
