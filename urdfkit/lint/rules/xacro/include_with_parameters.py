"""X118 include-has-macro-params."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import SourceRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document


class IncludeWithParameters(SourceRule):
    """An include is given parameters.

    ## What it does
    Looks for attributes of ``<xacro:include>`` other than ``filename``, ``ns`` and ``optional``.

    ## Why is this bad?
    An include takes none: xacro ignores them. Parameters belong to the call of a macro that the file defines.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base"/>
      <xacro:include filename="nothing.xacro" optional="true" prefix="left_"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base"/>
      <xacro:include filename="nothing.xacro" optional="true"/>
    </robot>
    ```

    ## Fix safety
    Unsafe: the parameters are taken away, as nobody reads them; perhaps a macro was meant to be called.
    """

    code = "X118"
    name = "include-has-macro-params"
    severity = "warning"
    fix = "unsafe"

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield a finding for each parameter of an include."""
        text, source = document.source.text, document.source
        if "xacro:include" not in text:
            return
        for tag in document.walk():
            if tag.name != "xacro:include":
                continue
            place = source.position(tag.start)
            faults = (fault for fault in model.expanded.faults if fault.kind == "directive-attribute")
            spelt = {fault.attribute for fault in faults if fault.position == place}
            for name, written in tag.attributes.items():
                if name not in ("filename", "ns", "optional") and not name.startswith("xmlns") and name not in spelt:
                    start = len(text[: written.start].rstrip())
                    yield self.at(
                        model,
                        place,
                        f"an include takes no parameter `{name}`",
                        attribute=name,
                        help="give it to the macro that the file defines",
                        fix=Fix("unsafe", f"Take `{name}` away", (Edit(source.span(start, written.end), ""),)),
                    )
