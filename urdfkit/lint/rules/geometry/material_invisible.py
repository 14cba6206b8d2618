"""G616 material-invisible."""

from __future__ import annotations

import re

from urdfkit.description.numbers import numbers
from urdfkit.description.robot import Mesh
from urdfkit.lint.edits import new_value
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_MEANT = re.compile(r"invis|transparen|hidden|clear|none|ghost|empty", re.IGNORECASE)


class MaterialInvisible(RobotRule):
    """A colour has the alpha 0: what it is on cannot be seen.

    ## What it does
    Looks for materials with an alpha of 0 that a box, cylinder or sphere has. Those whose name tells that it is meant
    (``invisible``, ``transparent``), and black ones, are left alone; so are meshes, which have colours of their own.

    ## Why is this bad?
    The fourth number is the opacity, not the transparency: 1 is solid. The link is there, collides, and is not drawn.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base">
        <visual>
          <geometry><box size="1 1 1"/></geometry>
          <material name="red"><color rgba="1 0 0 0"/></material>
        </visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base">
        <visual>
          <geometry><box size="1 1 1"/></geometry>
          <material name="red"><color rgba="1 0 0 1"/></material>
        </visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the colour becomes solid.
    """

    code = "G616"
    name = "material-invisible"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each such colour."""
        used = set()
        for link in model.robot.links:
            for visual in link.visuals:
                material = visual.element.find("material")
                if material is not None and visual.geometry is not None and not isinstance(visual.geometry, Mesh):
                    used.add(material.get("name") or "")
        for material in (element for element in model.elements if element.tag == "material"):
            name = material.get("name") or ""
            color = material.find("color")
            rgba = numbers(color.get("rgba") or "") if color is not None else None
            if color is None or rgba is None or len(rgba) != 4 or rgba[3] != 0.0 or not any(rgba[:3]):
                continue
            if name not in used or _MEANT.search(name):
                continue
            solid = f"{(color.get('rgba') or '').rsplit(None, 1)[0]} 1"
            yield self.at(
                model,
                color,
                f"material `{name}` has the alpha 0: nothing of it is seen"
                if name
                else "the alpha 0 lets nothing be seen",
                attribute="rgba",
                help="the fourth number is the opacity: 1 is solid",
                fix=new_value(model, color, "rgba", solid, "unsafe", "Make it solid"),
            )
