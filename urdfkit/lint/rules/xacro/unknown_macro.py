"""X103 unknown-macro."""

from __future__ import annotations

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
    ``<marco>``), which xacro takes for calls, or for nothing.

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
    Unsafe: the directive, or the macro with the nearest name, is taken.
    """

    code = "X103"
    name = "unknown-macro"
    fix = "unsafe"
    kinds = ("undefined-macro", "misspelt-directive")
    may_be_elsewhere = True

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; what is misspelt can be mended."""
        right = fault.name
        if fault.kind == "undefined-macro":
            right = fault.details.get("meant") or nearest(fault.name or "", fault.candidates, likeness=0.7)
        fix = self._renamed(model, fault, right) if right and fault.defined_at is None else None
        for finding in super().check(fault, model):
            yield Finding(**{**finding.__dict__, "fix": fix}) if fix is not None else finding

    def _renamed(self, model: Model, fault: Fault, right: str) -> Fix | None:
        tag = model.tag(fault.position)
        if tag is None:
            return None
        source = model.document(fault.position.file).source
        ends = [tag.start + 1] if tag.close is None else [tag.start + 1, tag.close + 2]
        name = f"xacro:{right}"
        edits = tuple(Edit(source.span(end, end + len(tag.name)), name) for end in ends)
        return Fix("unsafe", f"Call it <{name}>", edits)
