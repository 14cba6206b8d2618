"""X103 unknown-macro."""

import os

from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.facts.root_cause import is_in_broken_file
from urdfkit.lint.finding import Edit, Finding, Fix
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import FaultRule, Findings, Model


class UnknownMacro(FaultRule):
    """A macro call names an undefined macro.

    ## What it does
    Checks for calls of macros that no file defines before the call. Also checks for misspelt directives
    (``<xacro:proprety>``, ``<marco>``), because xacro treats them as macro calls or copies them to the robot. If
    another file of the package or of a neighbouring package defines the macro, the rule suggests including that file.

    ## Why is this bad?
    xacro aborts with an error that contains the name of the macro, but not the line of the call.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="frame" params="name">
         <link name="${name}"/>
       </xacro:macro>
    -  <xacro:fram name="base"/>
    +  <xacro:frame name="base"/>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the directive or macro with the most similar name, or includes the file that defines the
    macro.
    """

    code = "X103"
    name = "unknown-macro"
    fix = "unsafe"
    kinds = ("undefined-macro", "misspelt-directive")
    may_be_elsewhere = True

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding, with a fix for a misspelt name or a missing include."""
        if fault.kind == "undefined-macro" and is_in_broken_file(model, "macro", fault.name or ""):
            return  # The malformed file is reported instead.
        correct_name = fault.name
        if fault.kind == "undefined-macro":
            correct_name = fault.details.get("meant") or nearest(fault.name or "", fault.candidates, cutoff=0.7)
        changes: dict[str, object] = {}
        fix = self._renaming_fix(model, fault, correct_name) if correct_name and fault.defined_at is None else None
        if fix is None and fault.kind == "undefined-macro" and fault.defined_at is None:
            file = _defining_file(fault.name or "", model)
            if file is not None:
                changes["help"] = f"include {file}, which defines `{fault.name}`"
                fix = _include_fix(file, fault, model)
        if fix is not None:
            changes["fix"] = fix
        for finding in super().check(fault, model):
            yield Finding(**{**finding.__dict__, **changes}) if changes else finding

    def _renaming_fix(self, model: Model, fault: Fault, correct_name: str) -> Fix | None:
        tag = model.tag(fault.position)
        if tag is None:
            return None
        source = model.document(fault.position.file).source
        ends = [tag.start + 1] if tag.close is None else [tag.start + 1, tag.close + 2]
        name = f"xacro:{correct_name}"
        edits = tuple(Edit(source.span(end, end + len(tag.name)), name) for end in ends)
        return Fix("unsafe", f"Replace with <{name}>", edits)


def _defining_file(name: str, model: Model) -> str | None:
    """Return the path, relative to the entry file, of the only file that defines a macro and is not included."""
    files = model.neighbouring_macros.get(name, [])
    if len(files) != 1:
        return None
    return os.path.relpath(files[0], model.expanded.path.absolute().parent).replace(os.sep, "/")


def _include_fix(file: str, fault: Fault, model: Model) -> Fix | None:
    """Return the fix that includes a file at the top of the entry file, if the macro is called there."""
    from urdfkit.description.xml.reader import shown_path

    entry = fault.position.file
    if entry != shown_path(model.expanded.path):
        return None
    root = next((tag for tag in model.document(entry).roots if tag.name == "robot"), None)
    if root is None or root.close is None:
        return None
    source = model.document(entry).source
    text = f'{source.line_end}  <xacro:include filename="{file}"/>'
    return Fix("unsafe", f"Include {file}", (Edit(source.span(root.end, root.end), text),))
