"""X119 macro-formula-suspect."""

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Document
from urdfkit.lint.rule import Findings, Model, SourceRule


class InertiaFormula(SourceRule):
    """A formula for a moment of inertia has a wrong term.

    ## What it does
    Compares the formulas in ``<inertia>`` with the formulas for a solid box, cylinder and sphere, regardless of the
    names of the variables. If two of the three moments match a shape and the third does not, the third is reported.

    ## Why is this bad?
    A widely copied macro for boxes has ``x*x+z*z`` in ``izz``, which is correct only for cubes. Every link that uses
    the macro has a wrong inertia.

    ## Example
    ```diff
     <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="box_inertia" params="m x y z">
         <inertia ixx="${m*(y*y+z*z)/12}" ixy="0" ixz="0"
    -             iyy="${m*(x*x+z*z)/12}" iyz="0" izz="${m*(x*x+z*z)/12}"/>
    +             iyy="${m*(x*x+z*z)/12}" iyz="0" izz="${m*(x*x+y*y)/12}"/>
       </xacro:macro>
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the formula that matches the other two moments.

    ## References
    The moments of inertia of solid bodies are listed in textbooks on mechanics.
    """

    code = "X119"
    name = "macro-formula-suspect"
    fix = "unsafe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each wrong moment of inertia."""
        text = document.source.text
        if "${" not in text or not any("${" in piece.partition("<")[0] for piece in text.split("<inertia")[1:]):
            return
        from urdfkit.lint.facts.inertia.inertia_formulas import slip

        for tag in document.walk():
            if tag.name != "inertia" or "${" not in text[tag.start : tag.end]:
                continue
            attributes = tag.attributes
            error = slip({name: attribute.value for name, attribute in attributes.items()})
            if error is None:
                continue
            attribute = attributes[error.component]
            formula = f"${{{error.right}}}"
            span = document.source.span(attribute.value_start, attribute.value_end)
            message = f"wrong formula for {error.component}: the other two moments match a {error.shape}"
            help = f"write {formula}"
            fix = Fix("unsafe", f"Replace with {formula}", (Edit(span, formula),))
            yield self.at(
                model, document.source.position(tag.start), message, attribute=error.component, help=help, fix=fix
            )
