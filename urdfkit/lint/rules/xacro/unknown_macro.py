"""X103 unknown-macro."""

from __future__ import annotations

import os

from urdfkit.lint.blamed import is_in_broken_file
from urdfkit.lint.edits import nearest
from urdfkit.lint.finding import Edit, Finding, Fix
from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.model import Model


class UnknownMacro(FaultRule):
    """A macro is called that is not defined there.

    ## What it does
    Reports calls of macros that no file defines before the call, and misspelt directives (``<xacro:proprety>``,
    ``<marco>``), which xacro takes for calls, or for nothing. Where another file of the package, or beside it, defines
    the macro, its include is missing.

    ## Why is this bad?
    xacro stops; its message names the macro but not the line of the call.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name">
        <link name="${name}"/>
      </xacro:macro>
      <xacro:fram name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name">
        <link name="${name}"/>
      </xacro:macro>
      <xacro:frame name="base"/>
    </robot>
    ```

    ## Fix safety
    Unsafe: the directive, or the macro with the nearest name, is taken, or the file of the package that defines the
    macro is included.
    """

    code = "X103"
    name = "unknown-macro"
    fix = "unsafe"
    kinds = ("undefined-macro", "misspelt-directive")
    may_be_elsewhere = True

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; what is misspelt can be mended."""
        if fault.kind == "undefined-macro" and is_in_broken_file(model, "macro", fault.name or ""):
            return  # The file that is broken is a finding of its own.
        right = fault.name
        if fault.kind == "undefined-macro":
            right = fault.details.get("meant") or nearest(fault.name or "", fault.candidates, likeness=0.7)
        changed: dict[str, object] = {}
        fix = self._renamed(model, fault, right) if right and fault.defined_at is None else None
        if fix is None and fault.kind == "undefined-macro" and fault.defined_at is None:
            file = _defining(fault.name or "", model)
            if file is not None:
                changed["help"] = f"`{fault.name}` is defined in {file}: include that file"
                fix = _included(file, fault, model)
        if fix is not None:
            changed["fix"] = fix
        for finding in super().check(fault, model):
            yield Finding(**{**finding.__dict__, **changed}) if changed else finding

    def _renamed(self, model: Model, fault: Fault, right: str) -> Fix | None:
        tag = model.tag(fault.position)
        if tag is None:
            return None
        source = model.document(fault.position.file).source
        ends = [tag.start + 1] if tag.close is None else [tag.start + 1, tag.close + 2]
        name = f"xacro:{right}"
        edits = tuple(Edit(source.span(end, end + len(tag.name)), name) for end in ends)
        return Fix("unsafe", f"Call it <{name}>", edits)


def _defining(name: str, model: Model) -> str | None:
    """Return the one file that nothing includes and that defines a macro, as seen from the entry; None else."""
    files = model.macros_around.get(name, [])
    if len(files) != 1:
        return None
    return os.path.relpath(files[0], model.expanded.path.absolute().parent).replace(os.sep, "/")


def _included(file: str, fault: Fault, model: Model) -> Fix | None:
    """Return the fix that includes a file at the top of the entry, where that is where the macro is called."""
    from urdfkit.description.reading import shown_path

    entry = fault.position.file
    if entry != shown_path(model.expanded.path):
        return None
    root = next((tag for tag in model.document(entry).roots if tag.name == "robot"), None)
    if root is None or root.close is None:
        return None
    source = model.document(entry).source
    text = f'{source.line_end}  <xacro:include filename="{file}"/>'
    return Fix("unsafe", f"Include {file}", (Edit(source.span(root.end, root.end), text),))
