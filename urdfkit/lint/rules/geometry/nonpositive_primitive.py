"""G611 nonpositive-primitive."""

from urdfkit.description.urdf.robot import Collision, Link, Sphere, Visual
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import numbers
from urdfkit.description.xml.source import Position
from urdfkit.lint.facts.root_cause import is_not_positive, root_cause
from urdfkit.lint.finding import Severity
from urdfkit.lint.model.placement import shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_SIZES = {
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "sphere": ("radius",),
    "capsule": ("radius", "length"),
    "mesh": ("scale",),
}


class NonpositivePrimitive(RobotRule):
    """A box, cylinder, sphere or capsule has a size that is not positive, or a mesh has a scale of zero.

    ## What it does
    Checks for sizes, radii and lengths that are zero or negative, and for zeros in the scale of a mesh. A negative
    scale is accepted, because it mirrors the mesh. A size of zero is reported as a warning. A collision sphere with a
    radius of zero is reported as a note, because exporters write such spheres for contact points. With ``--target
    mujoco``, both are reported as errors.

    ## Why is this bad?
    MuJoCo and other physics engines reject the shape ("size must be positive"). In other tools, the shape is invisible
    and does not collide.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
    -    <visual><geometry><cylinder radius="0.1" length="0"/></geometry></visual>
    +    <visual><geometry><cylinder radius="0.1" length="0.001"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "G611"
    name = "nonpositive-primitive"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each size that is not positive, once per property or argument that several shapes use."""
        reported: set[tuple[Position, str]] = set()
        for link in model.robot.links:
            for shape in shapes_of(link):
                geometry = shape.element.find("geometry")
                for element in geometry.children if geometry is not None else ():
                    for attribute in _SIZES.get(element.tag, ()):
                        text = element.get(attribute, "") or ""
                        values = numbers(text) or []
                        is_mesh = element.tag == "mesh"
                        if any(
                            value == 0.0 if is_mesh else value <= 0.0 for value in values
                        ) and not model.is_unresolved(element, attribute):
                            severity = _severity(model, link, shape, element, values)
                            rule = "must not be zero" if is_mesh else "must be positive"
                            message = f'link `{link.name}`: {attribute}="{text}" of <{element.tag}> {rule}'
                            place = root_cause(model, element, attribute, is_not_positive)
                            if place is None:
                                yield self.at(
                                    model, element, message, attribute=attribute, link=link.name, severity=severity
                                )
                            elif place not in reported:
                                reported.add(place)
                                help = f"the value is used at {model.shown(element.origin.position)}"
                                yield self.at(
                                    model,
                                    place[0],
                                    message,
                                    attribute=place[1],
                                    link=link.name,
                                    help=help,
                                    severity=severity,
                                )


def _severity(model: Model, link: Link, shape: Visual | Collision, element: Element, values: list[float]) -> Severity:
    """Return ``error`` for a size that a reader of the target rejects; urdfkit leaves out shapes of size zero."""
    if model.target == "mujoco" or (element.tag != "mesh" and any(value < 0.0 for value in values)):
        return "error"
    if model.target == "urdfkit":
        return "warning"
    geometries = [each.geometry for each in link.collisions]
    is_placeholder = any(isinstance(geometry, Sphere) and geometry.radius == 0.0 for geometry in geometries)
    return "note" if element.tag == "sphere" and (shape.element.tag == "collision" or is_placeholder) else "warning"
