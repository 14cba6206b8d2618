"""Z821 gazebo-material-in-gz."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class GazeboMaterial(RobotRule):
    """A material script of Gazebo Classic is used with Gazebo Sim.

    ## What it does
    With ``--target gz``, checks for ``<material>Gazebo/…</material>``.

    ## Why is this bad?
    Gazebo Sim does not support these scripts, so the link is white.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <gazebo reference="base">
    -    <material>Gazebo/Orange</material>
    +    <visual>
    +      <material>
    +        <diffuse>1 0.5 0 1</diffuse>
    +      </material>
    +    </visual>
       </gazebo>
     </robot>
    ```
    """

    code = "Z821"
    name = "gazebo-material-in-gz"
    severity = "warning"
    only_for = ("gz",)

    def check(self, model: Model) -> Findings:
        """Yield a finding for each material script."""
        for block in model.robot.gazebo:
            for child in block.element.find_all("material"):
                if (child.text or child.get("value") or "").startswith("Gazebo/"):
                    message = (
                        f"Gazebo Sim has no material script `{child.text or child.get('value')}`: the link is white"
                    )
                    help = "set <visual><material><diffuse> here, or <color> in the URDF"
                    yield self.at(model, child, message, link=block.reference, help=help)
