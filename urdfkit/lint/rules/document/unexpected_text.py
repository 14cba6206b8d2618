"""E007 unexpected-text."""

from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.rule import Findings, Model, RobotRule


class UnexpectedText(RobotRule):
    """An element contains text that URDF does not allow.

    ## What it does
    Checks for text directly inside ``<robot>``, ``<link>``, ``<joint>`` and their children. Extensions (``<gazebo>``,
    ``<transmission>`` …) are not checked.

    ## Why is this bad?
    Readers ignore the text silently. It is usually the remainder of a comment or of an incomplete tag.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <visual>
    -      <geometry>robot
    +      <geometry>
             <sphere radius="0.1"/>
           </geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix removes the text, which may be the remainder of an intended element.
    """

    code = "E007"
    name = "unexpected-text"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each piece of text."""
        root = model.robot.element
        if root.text:
            for document in map(model.document, model.expanded.sources):
                for tag in document.roots[:1]:
                    yield from self._check_text(model, document, tag, root.text, root)
        for element in model.elements:
            if element.text and not model.is_unresolved(element):
                position = element.origin.position
                written = model.tag(position)
                if written is not None:
                    yield from self._check_text(model, model.document(position.file), written, element.text, element)

    def _check_text(self, model: Model, document: Document, tag: Tag, expanded: str, element: Element) -> Findings:
        text, source = document.source.text, document.source
        skipped = [(child.start, child.close_end) for child in tag.children]
        skipped += [
            (start, end) for start, end, _ in document.comments if tag.end <= start < (tag.close or tag.close_end)
        ]
        offset = tag.end
        for start, end in [*sorted(skipped), (tag.close or tag.close_end, 0)]:
            piece = text[offset:start]
            words = " ".join(piece.split())
            if words and words.split()[0] in expanded:
                first = offset + len(piece) - len(piece.lstrip())
                span = source.span(first, first + len(piece.strip()))
                shown = words if len(words) <= 40 else words[:39] + "…"
                yield self.at_span(
                    span,
                    f"unexpected text `{shown}` in <{tag.name}>: readers ignore it",
                    severity="note" if words.startswith(("#", "//")) else self.severity,
                    help="remove it, or restore the tag or comment it belongs to",
                    fix=Fix("unsafe", "Remove the text", (Edit(span, ""),)),
                    chains=(element.origin.expansions,) if element.origin.expansions else (),
                    kind="text",
                )
            offset = end
