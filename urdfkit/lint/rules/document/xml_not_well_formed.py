"""E001 xml-not-well-formed."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document


class XmlNotWellFormed(FaultRule):
    """The file is not well-formed XML.

    ## What it does
    Reports the place where a file, or a file it includes, stops being XML: a tag that is not closed, an attribute
    without quotes, a stray ``<`` or ``&``, something before ``<?xml``. Entity declarations and external entities are
    reported too: they can grow without end or read other files. So are bytes that are no UTF-8 (Latin-1,
    UTF-16), even in comments and whatever ``<?xml encoding=…?>`` says; where only urdfdom reads the file, which takes
    bytes as they are, that is a warning.

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

    ## Fix safety
    Unsafe: a root that is never closed is closed at the end; there may be more missing than that.
    """

    code = "E001"
    name = "xml-not-well-formed"
    fix = "unsafe"
    kinds = ("xml", "encoding")

    def claims(self, fault: Fault) -> bool:
        """Return whether the fault is about XML as such, not about an unbound prefix."""
        return fault.kind in self.kinds and "unbound prefix" not in fault.message

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; a file that ends too early is pointed at where what is written ends."""
        if fault.kind == "encoding":
            severity, help = fault.details["severity"], "save it as UTF-8"
            yield self.at(model, fault.position, fault.message, help=help, severity=severity)
            return
        if not fault.message.startswith("the file ends too early"):
            yield from super().check(fault, model)
            return
        document = model.document(fault.position.file)
        source = document.source
        end = len(source.text.rstrip())
        yield self.at(model, source.position(max(end - 1, 0)), fault.message, fix=_closed(document, end))


def _closed(document: Document, end: int) -> Fix | None:
    """Return the fix that closes the root where nothing else is open."""
    root = next(iter(document.roots), None)
    if root is None or root.empty or any(not tag.empty and tag.close is None for tag in root.walk() if tag is not root):
        return None
    there = document.source.span(end, end)
    return Fix("unsafe", f"Close <{root.name}>", (Edit(there, f"{document.source.line_end}</{root.name}>"),))
