"""E001 xml-not-well-formed."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.faults import Fault


class XmlNotWellFormed(FaultRule):
    """The file is not well-formed XML.

    ## What it does
    Reports the place where a file, or a file it includes, stops being XML: a tag that is not closed, an attribute
    without quotes, a stray ``<`` or ``&``, something before ``<?xml``. Entity declarations and external entities are
    reported too: they can grow without end or read other files.

    ## Why is this bad?
    Nothing that reads the description gets any further; xacro names the line, but not the file that was included.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
    </robot>
    ```
    """

    code = "E001"
    name = "xml-not-well-formed"
    kinds = ("xml",)

    def claims(self, fault: Fault) -> bool:
        """Return whether the fault is about XML as such, not about an unbound prefix."""
        return fault.kind == "xml" and "unbound prefix" not in fault.message
