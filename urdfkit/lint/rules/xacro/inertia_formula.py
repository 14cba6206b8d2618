"""X119 macro-formula-suspect."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import SourceRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document


class InertiaFormula(SourceRule):
    """A formula for inertia has a wrong term.

    ## What it does
    Compares the formulas of ``<inertia>`` with those of a solid box, cylinder and sphere, whatever their variables
    are called. Where two of the three moments are those of one shape and the third is not, the third is wrong.

    ## Why is this bad?
    The most copied box macro of the web has ``x*x+z*z`` in ``izz``: it is right for cubes only, and every link that
    uses it turns wrong.

    ## Example
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="box_inertia" params="m x y z">
        <inertia ixx="${m*(y*y+z*z)/12}" ixy="0" ixz="0"
                 iyy="${m*(x*x+z*z)/12}" iyz="0" izz="${m*(x*x+z*z)/12}"/>
      </xacro:macro>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="box_inertia" params="m x y z">
        <inertia ixx="${m*(y*y+z*z)/12}" ixy="0" ixz="0"
                 iyy="${m*(x*x+z*z)/12}" iyz="0" izz="${m*(x*x+y*y)/12}"/>
      </xacro:macro>
      <link name="base"/>
    </robot>
    ```

    ## Fix safety
    Unsafe: the term that fits the other two is written.

    ## References
    The moments of solid bodies are in any textbook of mechanics.
    """

    code = "X119"
    name = "macro-formula-suspect"
    fix = "unsafe"

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield a finding for each formula with one wrong moment."""
        text = document.source.text
        if not any("${" in piece.partition("<")[0] for piece in text.split("<inertia")[1:]):
            return
        from urdfkit.lint.algebra import slip

        for tag in document.walk():
            if tag.name != "inertia" or "${" not in text[tag.start : tag.end]:
                continue
            written = tag.attributes
            found = slip({name: attribute.value for name, attribute in written.items()})
            if found is None:
                continue
            attribute = written[found.component]
            right = f"${{{found.right}}}"
            span = document.source.span(attribute.value_start, attribute.value_end)
            yield self.at(
                model,
                document.source.position(tag.start),
                f"{found.component} is not that of a {found.shape}, although the other two moments are",
                attribute=found.component,
                help=f"write {right}",
                fix=Fix("unsafe", f"Write {right}", (Edit(span, right),)),
            )
