"""X107 macro-args-mismatch."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.finding import suggestion_of
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import FaultRule, Findings, Model


class MacroArgsMismatch(FaultRule):
    """The arguments of a macro call do not match the parameters of the macro.

    ## What it does
    Checks for macro calls that omit a parameter without a default, pass an unknown parameter, or pass too few or too
    many blocks. If a macro inserts a block whose parameter lacks the asterisk, the rule reports the macro once, not
    each call.

    ## Why is this bad?
    xacro aborts with "Undefined parameters" and does not report which call is wrong.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="frame" params="name parent">
         <link name="${parent}_${name}"/>
       </xacro:macro>
    -  <xacro:frame name="tool"/>
    +  <xacro:frame name="tool" parent="hand"/>
     </robot>
    ```
    """

    code = "X107"
    name = "macro-args-mismatch"
    kinds = ("macro-arguments", "undefined-block")

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding; a misspelt parameter and a missing asterisk are one finding each."""
        if (block := self._block_without_asterisk(fault, model)) is not None:
            position = model.expanded.macros[fault.name or ""].position
            message = f"macro `{fault.name}` inserts the block `{block}`, but its parameter lacks the asterisk"
            yield self.at(model, position, message, attribute="params", help=f"write `*{block}` in params")
            return
        if (block := _only_unused_block(fault, model)) is not None and not suggestion_of(fault.message):
            written = fault.name or ""
            message = f"block `{written}` is not defined" + Suggestion(block, written)
            yield self.at(model, fault, message, attribute=fault.attribute, names=(written,))
            return
        unknown, missing = self._mismatched_parameters(fault, model)
        if not unknown or not missing:
            yield from super().check(fault, model)
            return
        suggestions = {name: nearest(name, missing) for name in unknown}
        if len(unknown) == len(missing) == 1:
            suggestions[unknown[0]] = missing[0]
        if fault.attribute in suggestions and suggestions[fault.attribute] is not None:
            suggestion = suggestions[fault.attribute]
            message = f"unknown parameter `{fault.attribute}` of macro `{fault.name}`, which requires `{suggestion}`"
            help, words = f"rename the attribute to `{suggestion}`", (fault.attribute, fault.name or "")
            yield self.at(model, fault, message, attribute=fault.attribute, help=help, names=words)
        elif fault.attribute is not None:
            yield from super().check(fault, model)
        elif unmatched := [name for name in missing if name not in suggestions.values()]:
            names = ", ".join(f"`{name}`" for name in unmatched)
            message = f"the call of macro `{fault.name}` lacks {names}"
            yield self.at(model, fault, message, help=f"pass {names} in the call")

    def _block_without_asterisk(self, fault: Fault, model: Model) -> str | None:
        """Return the parameter that a call passes as a block although the macro declares it without an asterisk."""
        macro = model.expanded.macros.get(fault.name or "")
        tag = model.tag(macro.position) if macro is not None else None
        if macro is None or tag is None or fault.kind != "macro-arguments":
            return None
        unknown, missing = self._mismatched_parameters(fault, model)
        call = model.tag(fault.position)
        if unknown or len(missing) != 1 or call is None or not call.children or missing[0] not in macro.parameters:
            return None
        is_inserted = any(
            child.attributes["name"].value == missing[0]
            for child in tag.walk()
            if child.name.rpartition(":")[2] == "insert_block" and "name" in child.attributes
        )
        return missing[0] if is_inserted else None

    def _mismatched_parameters(self, fault: Fault, model: Model) -> tuple[list[str], list[str]]:
        """Return the unknown and the missing parameters of the call that caused a fault."""
        unknown: list[str] = []
        missing: list[str] = []
        for other in model.faults_by_call[fault.kind, fault.position, fault.expansions]:
            unknown += other.details.get("unknown", ())
            missing += other.details.get("missing", ())
        return unknown, missing


def _only_unused_block(fault: Fault, model: Model) -> str | None:
    """Return the block of a macro that it does not insert, if it inserts another, undefined block instead."""
    tag = model.tag(fault.position) if fault.kind == "undefined-block" else None
    macro = next((each for each in tag.ancestors() if each.name == "xacro:macro"), None) if tag is not None else None
    if macro is None or "params" not in macro.attributes:
        return None
    inserted = {
        each.attributes["name"].value
        for each in macro.walk()
        if each.name == "xacro:insert_block" and "name" in each.attributes
    }
    words = (word.partition(":=")[0] for word in macro.attributes["params"].value.split() if word.startswith("*"))
    unused = [word.lstrip("*") for word in words if word.lstrip("*") not in inserted]
    return unused[0] if len(unused) == 1 else None
