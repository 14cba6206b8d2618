"""X107 macro-args-mismatch."""

from __future__ import annotations

from urdfkit.lint.edits import nearest
from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MacroArgsMismatch(FaultRule):
    """A macro is called with other arguments than it has.

    ## What it does
    Reports calls that leave out a parameter without default, name a parameter the macro does not have, or bring too few
    or too many blocks. Where the macro inserts a block that its parameters have without the star, that is said once, at
    the macro.

    ## Why is this bad?
    xacro stops with "Undefined parameters" and does not say which call is meant.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name parent">
        <link name="${parent}_${name}"/>
      </xacro:macro>
      <xacro:frame name="tool"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name parent">
        <link name="${parent}_${name}"/>
      </xacro:macro>
      <xacro:frame name="tool" parent="hand"/>
    </robot>
    ```
    """

    code = "X107"
    name = "macro-args-mismatch"
    kinds = ("macro-arguments", "undefined-block")

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; one for a parameter that is written under another name, or that lacks its star."""
        if (starless := self._starless(fault, model)) is not None:
            place = model.expanded.macros[fault.name or ""].position
            message = f"macro `{fault.name}` inserts the block `{starless}`, and has it without the star"
            yield self.at(model, place, message, attribute="params", help=f"write `*{starless}` into its params")
            return
        unknown, missing = self._of_call(fault, model)
        if not unknown or not missing:
            yield from super().check(fault, model)
            return
        meant = {name: nearest(name, missing) for name in unknown}
        if len(unknown) == len(missing) == 1:
            meant[unknown[0]] = missing[0]
        if fault.attribute in meant and meant[fault.attribute] is not None:
            macro, name = fault.name, meant[fault.attribute]
            message = f"macro `{macro}` has no parameter `{fault.attribute}`, and needs `{name}`"
            yield self.at(model, fault, message, attribute=fault.attribute, help=f"is `{name}` meant?")
        elif fault.attribute is not None:
            yield from super().check(fault, model)
        elif lacking := [name for name in missing if name not in meant.values()]:
            names = ", ".join(f"`{name}`" for name in lacking)
            yield self.at(model, fault, f"macro `{fault.name}` needs {names}")

    def _starless(self, fault: Fault, model: Model) -> str | None:
        """Return the parameter that a call lacks and gives as a block, because the macro has it without its star."""
        macro = model.expanded.macros.get(fault.name or "")
        tag = model.tag(macro.position) if macro is not None else None
        if macro is None or tag is None or fault.kind != "macro-arguments":
            return None
        inserted = {
            each.attributes["name"].value
            for each in tag.walk()
            if each.name.rpartition(":")[2] == "insert_block" and "name" in each.attributes
        }
        unknown, missing = self._of_call(fault, model)
        call = model.tag(fault.position)
        if unknown or len(missing) != 1 or call is None or not call.children:
            return None
        return missing[0] if missing[0] in inserted and missing[0] in macro.parameters else None

    def _of_call(self, fault: Fault, model: Model) -> tuple[list[str], list[str]]:
        """Return the parameters that the call of a fault gives too many, and those that it lacks."""
        unknown: list[str] = []
        missing: list[str] = []
        for other in model.expanded.faults:
            if (other.kind, other.position, other.expansions) == (fault.kind, fault.position, fault.expansions):
                unknown += other.details.get("unknown", ())
                missing += other.details.get("missing", ())
        return unknown, missing
