"""J419 dynamics-empty-or-negative."""

from urdfkit.lint.rule import Findings, Model, RobotRule

_LINEAR_UNITS = {"damping": "N·s/m", "friction": "N"}
_ANGULAR_UNITS = {"damping": "N·m·s/rad", "friction": "N·m"}


class DynamicsEmptyOrNegative(RobotRule):
    """``<dynamics>`` is empty, or has a negative value.

    ## What it does
    Checks for ``<dynamics>`` with neither ``damping`` nor ``friction``, and for negative values of these attributes.

    ## Why is this bad?
    urdfdom rejects an empty element ("specified with no damping and no friction"). With a negative value the joint
    gains energy as it moves, and simulations become unstable.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="continuous">
         <parent link="base"/>
         <child link="arm"/>
    -    <dynamics damping="-0.1"/>
    +    <dynamics damping="0.1"/>
       </joint>
     </robot>
    ```
    """

    code = "J419"
    name = "dynamics-empty-or-negative"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each ``<dynamics>`` that is empty, and for each negative value."""
        for joint in model.robot.joints:
            dynamics = joint.dynamics
            if dynamics is None:
                continue
            attributes = dynamics.element.attributes
            if "damping" not in attributes and "friction" not in attributes:
                message = f"<dynamics> of joint `{joint.name}` has neither damping nor friction"
                help = "add one of them, or remove the element"
                yield self.at(model, dynamics.element, message, joint=joint.name, help=help)
            units = _LINEAR_UNITS if joint.type == "prismatic" else _ANGULAR_UNITS
            for name in ("damping", "friction"):
                value = getattr(dynamics, name)
                if value < 0.0:
                    message = f"{name} {value:g} {units[name]} of joint `{joint.name}` is negative"
                    help = "write a value of zero or more"
                    yield self.at(model, dynamics.element, message, attribute=name, joint=joint.name, help=help)
