"""G612 material-undefined."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.urdf.robot import Material
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import Findings, Model, RobotRule

_COLOURS = {
    "black": "0 0 0 1",
    "white": "1 1 1 1",
    "gray": "0.5 0.5 0.5 1",
    "darkgray": "0.3 0.3 0.3 1",
    "lightgray": "0.8 0.8 0.8 1",
    "red": "0.8 0 0 1",
    "green": "0 0.8 0 1",
    "blue": "0 0 0.8 1",
    "yellow": "1 1 0 1",
    "orange": "1 0.5 0 1",
    "brown": "0.5 0.3 0.1 1",
    "silver": "0.75 0.75 0.75 1",
}
"""Colour names, without spaces and underscores → typical RGBA values."""


class MaterialUndefined(RobotRule):
    """A material is used but not defined.

    ## What it does
    Checks for ``<material name="…"/>`` without colour or texture if no other material of the robot defines this name.

    ## Why is this bad?
    check_urdf warns, RViz shows the shape in a default colour, and other readers reject the robot.

    ## Example
    ```diff
     <robot name="arm">
    +  <material name="orange">
    +    <color rgba="1 0.5 0 1"/>
    +  </material>
       <link name="base">
         <visual>
           <geometry><sphere radius="0.1"/></geometry>
           <material name="orange"/>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: if the material is named after a colour, the fix adds a typical value of that colour to its first use. No
    fix is offered for other materials.
    """

    code = "G612"
    name = "material-undefined"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each use of an undefined material."""
        is_fragment = not model.robot.element.get("name") and model.is_incomplete
        if model.missing_file or is_fragment or any(each.name is None for each in model.robot.materials):
            return
        used = [visual.material for link in model.robot.links for visual in link.visuals if visual.material is not None]
        every = (*model.robot.materials, *used)
        defined = {material.name for material in every if _is_definition(material)}
        for material in used:
            name = material.name
            if name is None or name in defined or _is_definition(material) or "$" in name:
                continue
            from urdfkit.lint.facts.root_cause import is_in_broken_file

            if is_in_broken_file(model, "material", name):
                continue
            from urdfkit.errors import nearest

            near = nearest(name, [other for other in defined if other])
            message = f"undefined material `{name}`"
            fix = _with_colour(model, material)
            help = (
                Suggestion(near, before="")
                if near
                else f'add <material name="{name}"><color rgba="…"/></material> to the robot'
            )
            yield self.at(model, material.element, message, attribute="name", fix=fix, help=help)


def _is_definition(material: Material) -> bool:
    return any(child.tag in ("color", "texture") for child in material.element.children)


def _with_colour(model: Model, material: Material) -> Fix | None:
    name = (material.name or "").lower().replace("_", "").replace(" ", "").replace("grey", "gray")
    rgba, position = _COLOURS.get(name), material.element.origin.position
    tag = model.tag(position)
    if rgba is None or tag is None or tag.name != "material" or tag.children:
        return None
    source = model.document(position.file).source
    color = f'<color rgba="{rgba}"/>'
    if tag.close is not None:
        return Fix("unsafe", f"Add the colour {name}", (Edit(source.span(tag.end, tag.close), color),))
    end = len(source.text[: tag.end - 2].rstrip())
    return Fix("unsafe", f"Add the colour {name}", (Edit(source.span(end, tag.end), f">{color}</material>"),))
