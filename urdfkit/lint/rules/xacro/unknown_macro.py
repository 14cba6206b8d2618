"""X103 unknown-macro."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.finding import Finding
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
    Unsafe: a directive is spelt right. The name of a macro is left to you.
    """

    code = "X103"
    name = "unknown-macro"
    fix = "unsafe"
    kinds = ("undefined-macro", "misspelt-directive")
    may_be_elsewhere = True

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; a directive that is misspelt can be mended."""
        if fault.kind == "undefined-macro":
            yield from super().check(fault, model)
            return
        tag, fix = model.tag(fault.position), None
        if tag is not None:
            source = model.document(fault.position.file).source
            ends = [tag.start + 1] if tag.close is None else [tag.start + 1, tag.close + 2]
            name = f"xacro:{fault.name}"
            fix = Fix(
                "unsafe",
                f"Call it <{name}>",
                tuple(Edit(source.span(end, end + len(tag.name)), name) for end in ends),
            )
        yield self.at(model, fault, fault.message, fix=fix)
