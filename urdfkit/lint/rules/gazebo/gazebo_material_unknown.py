"""Z824 gazebo-material-unknown."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.fix_builders import new_text
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class GazeboMaterialUnknown(RobotRule):
    """A Gazebo material is unknown.

    ## What it does
    Compares ``<material>Gazebo/…</material>`` with the materials of Gazebo Classic. A name without the prefix
    ``Gazebo/`` is reported only if Gazebo has a material of this name with the prefix. Scripts of the robot may define
    other names.

    ## Why is this bad?
    Gazebo logs "Unable to find material" and shows the link in white.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <gazebo reference="base">
    -    <material>Gazebo/Oragne</material>
    +    <material>Gazebo/Orange</material>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest material name, which may not be the intended one.
    """

    code = "Z824"
    name = "gazebo-material-unknown"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO | {"gz"}

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unknown material."""
        from urdfkit.description.plugins.gazebo_materials import unknown_materials

        for element, name, suggestion in unknown_materials(model.robot):
            if not model.is_unresolved(element):
                message = f"unknown Gazebo material `{name}`"
                help = Suggestion(suggestion, before="") if suggestion else None
                yield self.at(model, element, message, help=help, fix=new_text(model, element, suggestion, "unsafe"))
