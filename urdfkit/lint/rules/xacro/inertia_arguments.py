"""X120 macro-arg-vs-sibling-mismatch."""

from urdfkit.description.xml.numbers import number
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Document
from urdfkit.lint.rule import Findings, Model, SourceRule


class InertiaArguments(SourceRule):
    """The mass argument of an inertia macro differs from the mass of the link.

    ## What it does
    Compares the ``m`` or ``mass`` argument of a macro call in ``<inertial>`` with the ``<mass>`` next to it, if both
    are literal numbers.

    ## Why is this bad?
    The inertia tensor belongs to a body of different mass. With half the mass, for example, the angular acceleration
    doubles.

    ## Example
    ```diff
     <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="ball_inertia" params="m r">
         <inertia ixx="${2*m*r*r/5}" ixy="0" ixz="0" iyy="${2*m*r*r/5}" iyz="0" izz="${2*m*r*r/5}"/>
       </xacro:macro>
       <link name="base">
         <inertial>
           <mass value="1"/>
    -      <xacro:ball_inertia m="0.5" r="0.1"/>
    +      <xacro:ball_inertia m="1" r="0.1"/>
         </inertial>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix passes the mass of the link to the macro, but the mass of the link may be the error.
    """

    code = "X120"
    name = "macro-arg-vs-sibling-mismatch"
    severity = "warning"
    fix = "unsafe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each call whose mass differs from that of the link."""
        source = document.source
        if not any("macro" in one.text for one in model.expanded.sources.values()):
            return
        if not any(_may_name_mass(piece) for piece in source.text.split("<inertial")[1:]):
            return
        macros = model.signatures
        for tag in document.walk():
            if tag.name != "inertial":
                continue
            masses = [
                child.attributes["value"]
                for child in tag.children
                if child.name == "mass" and "value" in child.attributes
            ]
            calls = [child for child in tag.children if child.name.removeprefix("xacro:") in macros]
            for call in calls if len(masses) == 1 else ():
                for name in ("m", "mass"):
                    argument = call.attributes.get(name)
                    link_mass, argument_mass = (
                        number(masses[0].value),
                        number(argument.value) if argument is not None else None,
                    )
                    if argument is None or link_mass is None or argument_mass is None or link_mass == argument_mass:
                        continue
                    span = source.span(argument.value_start, argument.value_end)
                    message = f"mass {argument_mass:g} kg of `{call.name}` differs from the link mass, {link_mass:g} kg"
                    help = f"write {masses[0].value}"
                    fix = Fix("unsafe", f"Replace with {masses[0].value}", (Edit(span, masses[0].value),))
                    yield self.at(model, source.position(call.start), message, attribute=name, help=help, fix=fix)


def _may_name_mass(text: str) -> bool:
    """Return whether the text before ``</inertial>`` may contain an ``m`` or ``mass`` attribute."""
    before = text.partition("</inertial")[0]
    if not any(f"{blank}m" in before for blank in " \n\t\r"):
        return False
    return any(word.startswith(("m=", "mass=")) or word in ("m", "mass") for word in before.split())
