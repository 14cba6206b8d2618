"""I505 inertia-transposed."""

from __future__ import annotations

from urdfkit.lint.edits import new_values
from urdfkit.lint.principal import reordered
from urdfkit.lint.rule import RobotRule
from urdfkit.lint.tensor import COMPONENTS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class InertiaTransposed(RobotRule):
    """The entries of an inertia tensor are in another order than URDF's.

    ## What it does
    Looks at tensors that no body can have, and tries the orders other programs write them in. Where one of them
    alone gives a tensor that a body can have, that is what was meant.

    ## Why is this bad?
    URDF wants ixx, ixy, ixz, iyy, iyz, izz. A moment in the place of a product makes the tensor impossible: MuJoCo
    and sdformat refuse it, others simulate nonsense.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <inertial>
          <mass value="2"/>
          <inertia ixx="0.02" ixy="0.03" ixz="0.04" iyy="0" iyz="0" izz="0"/>
        </inertial>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <inertial>
          <mass value="2"/>
          <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/>
        </inertial>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the entries are put where that order has them.
    """

    code = "I505"
    name = "inertia-transposed"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each tensor that is right in another order."""
        for link in model.robot.links:
            for element in link.inertial.element.find_all("inertia") if link.inertial is not None else ():
                found = reordered(element)
                if found is None:
                    continue
                order, values = found
                texts = {name: f"{value:g}" for name, value in zip(COMPONENTS, values, strict=True)}
                yield self.at(
                    model,
                    element,
                    f"inertia of link `{link.name}` is impossible, but not if its entries were given {order}",
                    link=link.name,
                    help=f"then it is {', '.join(f'{name}={text}' for name, text in texts.items())}",
                    fix=new_values(model, element, texts, "unsafe", "Put the entries in URDF's order"),
                )
