"""X120 macro-arg-vs-sibling-mismatch."""

from __future__ import annotations

from urdfkit.description.numbers import number
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import SourceRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document


class InertiaArguments(SourceRule):
    """A macro for inertia is given another mass than the link has.

    ## What it does
    Compares the ``m`` or ``mass`` that a macro is called with in ``<inertial>`` with the ``<mass>`` beside it,
    where both are written out.

    ## Why is this bad?
    The tensor is that of another body: twice too light it turns twice too fast.

    ## Example
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="ball_inertia" params="m r">
        <inertia ixx="${2*m*r*r/5}" ixy="0" ixz="0" iyy="${2*m*r*r/5}" iyz="0" izz="${2*m*r*r/5}"/>
      </xacro:macro>
      <link name="base">
        <inertial>
          <mass value="1"/>
          <xacro:ball_inertia m="0.5" r="0.1"/>
        </inertial>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="ball_inertia" params="m r">
        <inertia ixx="${2*m*r*r/5}" ixy="0" ixz="0" iyy="${2*m*r*r/5}" iyz="0" izz="${2*m*r*r/5}"/>
      </xacro:macro>
      <link name="base">
        <inertial>
          <mass value="1"/>
          <xacro:ball_inertia m="1" r="0.1"/>
        </inertial>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the mass of the link is given to the macro, but it may be that mass that is wrong.
    """

    code = "X120"
    name = "macro-arg-vs-sibling-mismatch"
    severity = "warning"
    fix = "unsafe"

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield a finding for each call with another mass than that beside it."""
        source = document.source
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
                    given = call.attributes.get(name)
                    own, other = number(masses[0].value), number(given.value) if given is not None else None
                    if given is None or own is None or other is None or own == other:
                        continue
                    span = source.span(given.value_start, given.value_end)
                    yield self.at(
                        model,
                        source.position(call.start),
                        f"`{call.name}` is given the mass {other:g} kg, but the link has {own:g} kg",
                        attribute=name,
                        fix=Fix("unsafe", f"Write {masses[0].value}", (Edit(span, masses[0].value),)),
                    )


def _may_name_mass(text: str) -> bool:
    """Whether something between an ``<inertial>`` and its end may have an attribute for the mass."""
    words = text.partition("</inertial")[0].split()
    return any(word.startswith(("m=", "mass=")) or word in ("m", "mass") for word in words)
