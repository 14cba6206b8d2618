"""X118 include-has-macro-params."""

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Document
from urdfkit.lint.rule import Findings, Model, SourceRule


class IncludeWithParameters(SourceRule):
    """An include has macro parameters.

    ## What it does
    Checks for attributes of ``<xacro:include>`` other than ``filename``, ``ns`` and ``optional``.

    ## Why is this bad?
    xacro ignores the attributes, because an include has no parameters. Parameters belong in the call of a macro that
    the file defines.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <link name="base"/>
    -  <xacro:include filename="nothing.xacro" optional="true" prefix="left_"/>
    +  <xacro:include filename="nothing.xacro" optional="true"/>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix removes attributes without effect, but a macro call may have been intended.
    """

    code = "X118"
    name = "include-has-macro-params"
    severity = "warning"
    fix = "unsafe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each unsupported attribute of an include."""
        text, source = document.source.text, document.source
        if "xacro:include" not in text:
            return
        for tag in document.walk():
            if tag.name != "xacro:include":
                continue
            position = source.position(tag.start)
            faults = (fault for fault in model.expanded.faults if fault.kind == "directive-attribute")
            misspelt = {fault.attribute for fault in faults if fault.position == position}
            for name, attribute in tag.attributes.items():
                if name not in ("filename", "ns", "optional") and not name.startswith("xmlns") and name not in misspelt:
                    start = len(text[: attribute.start].rstrip())
                    message = f"<xacro:include> has no attribute `{name}`"
                    help = "pass it to a macro that the file defines"
                    fix = Fix("unsafe", f"Remove `{name}`", (Edit(source.span(start, attribute.end), ""),))
                    yield self.at(model, position, message, attribute=name, help=help, fix=fix)
