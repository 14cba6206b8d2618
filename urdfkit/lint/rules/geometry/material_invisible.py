"""G616 material-invisible."""

import re

from urdfkit.description.urdf.robot import Mesh
from urdfkit.description.xml.numbers import numbers
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

_INTENTIONAL = re.compile(r"invis|transparen|hidden|clear|none|ghost|empty", re.IGNORECASE)


class MaterialInvisible(RobotRule):
    """A material has an alpha of 0, so its shapes are invisible.

    ## What it does
    Checks the materials of boxes, cylinders and spheres for an alpha of 0. Black materials, and materials whose name
    indicates the intent (``invisible``, ``transparent``), are accepted. Meshes are not checked, because they have their
    own colours.

    ## Why is this bad?
    The fourth number is the opacity, not the transparency: 1 is opaque. The link exists and collides, but is not drawn.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
         <visual>
           <geometry><box size="1 1 1"/></geometry>
    -      <material name="red"><color rgba="1 0 0 0"/></material>
    +      <material name="red"><color rgba="1 0 0 1"/></material>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix makes the colour opaque, although the shapes may be invisible on purpose.
    """

    code = "G616"
    name = "material-invisible"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invisible colour."""
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
            if name not in used or _INTENTIONAL.search(name):
                continue
            opaque = f"{(color.get('rgba') or '').rsplit(None, 1)[0]} 1"
            message = (
                f"material `{name}` has an alpha of 0: its shapes are invisible"
                if name
                else "colour has an alpha of 0: the shape is invisible"
            )
            help = "set the fourth number, the opacity, to 1"
            fix = new_value(model, color, "rgba", opaque, "unsafe", "Make the colour opaque")
            yield self.at(model, color, message, attribute="rgba", help=help, fix=fix)
