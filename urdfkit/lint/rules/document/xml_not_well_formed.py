"""E001 xml-not-well-formed."""

from urdfkit.description.xacro.faults import Fault
from urdfkit.description.xml.misplaced_declaration import CAUSE as MISPLACED
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Document
from urdfkit.lint.rule import FaultRule, Findings, Model


class XmlNotWellFormed(FaultRule):
    """The file is not well-formed XML.

    ## What it does
    Reports where a file, or a file that it includes, is not well-formed: an unclosed tag, an attribute without quotes,
    a stray ``<`` or ``&``, or content before ``<?xml``. Entity declarations and external entities are also reported,
    because they can grow without bound or read other files.

    Bytes that are not UTF-8 (Latin-1, UTF-16) are reported even in comments and regardless of ``<?xml encoding=…?>``.
    They are reported as warnings if only urdfdom reads the file, because urdfdom does not decode it.

    ## Why is this bad?
    Every reader of the description stops at the error. xacro reports the line, but not the name of an included file.

    ## Example
    ```diff
     <robot name="arm">
    -  <link name="base">
    +  <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Safe if the fix deletes white space before ``<?xml``. Unsafe if the fix closes an unclosed root element at the end
    of the file, because more of the file may be missing.
    """

    code = "E001"
    name = "xml-not-well-formed"
    fix = "unsafe"
    kinds = ("xml", "encoding")

    def claims(self, fault: Fault) -> bool:
        """Return whether the fault concerns well-formedness or encoding, not an unbound prefix."""
        return fault.kind in self.kinds and fault.details.get("cause") != "unbound prefix"

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding; for a file that ends too early, at the last character of its text."""
        if fault.kind == "encoding":
            severity, help = fault.details["severity"], "save the file as UTF-8"
            yield self.at(model, fault.position, fault.message, help=help, severity=severity)
            return
        document = model.document(fault.position.file)
        source = document.source
        if fault.details.get("cause") == MISPLACED:
            before = source.text[: source.offset(fault.position.line, fault.position.column)]
            blank = Fix("safe", "Delete the whitespace before it", (Edit(source.span(0, len(before)), ""),))
            yield self.at(model, fault.position, fault.message, fix=None if before.strip() else blank)
            return
        if fault.details.get("cause") != "no element found":
            yield from super().check(fault, model)
            return
        end = len(source.text.rstrip())
        yield self.at(model, source.position(max(end - 1, 0)), fault.message, fix=_closed(document, end))


def _closed(document: Document, end: int) -> Fix | None:
    """Return the fix that closes the root element if no other element is open."""
    root = next(iter(document.roots), None)
    if root is None or root.empty or any(not tag.empty and tag.close is None for tag in root.walk() if tag is not root):
        return None
    end_of_text = document.source.span(end, end)
    return Fix("unsafe", f"Close <{root.name}>", (Edit(end_of_text, f"{document.source.line_end}</{root.name}>"),))
