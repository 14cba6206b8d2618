"""I505 inertia-transposed."""

from urdfkit.description.urdf.principal_moments import reordered
from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS
from urdfkit.lint.fix_builders import new_values
from urdfkit.lint.rule import Findings, Model, RobotRule


class InertiaTransposed(RobotRule):
    """The entries of an inertia tensor are in the wrong order.

    ## What it does
    Reads the entries of physically impossible tensors in the orders that other programs use. Reports the tensor if it
    is physically possible in exactly one of these orders.

    ## Why is this bad?
    URDF expects ixx, ixy, ixz, iyy, iyz, izz. If a moment is in the place of a product, the tensor is physically
    impossible. MuJoCo and sdformat then reject it, and other simulators compute a wrong motion.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <inertial>
           <mass value="2"/>
    -      <inertia ixx="0.02" ixy="0.03" ixz="0.04" iyy="0" iyz="0" izz="0"/>
    +      <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/>
         </inertial>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix moves the entries to the order of URDF, but the values may be wrong for another reason.
    """

    code = "I505"
    name = "inertia-transposed"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each tensor that is possible in another order."""
        for link in model.robot.links:
            for element in link.inertial.element.find_all("inertia") if link.inertial is not None else ():
                reordering = reordered(element)
                if reordering is None:
                    continue
                order, values = reordering
                entries = {name: f"{value:g}" for name, value in zip(COMPONENTS, values, strict=True)}
                message = f"inertia of link `{link.name}` is impossible; its entries appear to be written {order}"
                help = f"write {', '.join(f'{name}={text}' for name, text in entries.items())}"
                fix = new_values(model, element, entries, "unsafe", "Reorder the entries")
                yield self.at(model, element, message, link=link.name, help=help, fix=fix)
