"""T202 child-link-undefined."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.urdf.queries import dangling, meant_child
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import Findings, Model, RobotRule


class ChildLinkUndefined(RobotRule):
    """The child link of a joint is undefined.

    ## What it does
    Checks for joints whose ``<child>`` names an undefined link, and suggests the nearest link name.

    ## Why is this bad?
    The joint has no child link: urdfdom, Pinocchio and every viewer reject the robot.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
    +  <link name="upper"/>
       <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest link name, which may not be the intended one.
    """

    code = "T202"
    name = "child-link-undefined"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint with an undefined child link."""
        for joint, name, element in dangling(model.robot, "child"):
            meant = meant_child(model.robot, name)
            message = f"undefined child link `{name}` of joint `{joint.name}`" + Suggestion(meant, name)
            fix = new_value(model, element, "link", meant, "unsafe")
            finding = self.at(model, element, message, attribute="link", joint=joint.name, names=(name,), fix=fix)
            is_repaired = model.target == "urdfkit"
            yield from unless_masked(model, name, meant, finding, is_repaired=is_repaired)
