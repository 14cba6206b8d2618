"""E007 unexpected-text."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Finding, Fix
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document, Tag


class UnexpectedText(RobotRule):
    """There is text where URDF has none.

    ## What it does
    Looks for text directly inside ``<robot>``, ``<link>``, ``<joint>`` and what they hold. Extensions
    (``<gazebo>``, ``<transmission>`` …) are left alone.

    ## Why is this bad?
    Readers skip it without a word. Mostly it is the rest of a comment or of a tag that was lost.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual>
          <geometry>robot
            <sphere radius="0.1"/>
          </geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual>
          <geometry>
            <sphere radius="0.1"/>
          </geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the text is taken away, but may be what is left of something that was meant.
    """

    code = "E007"
    name = "unexpected-text"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each piece of text."""
        root = model.robot.element
        if root.text:
            for document in map(model.document, model.expanded.sources):
                for tag in document.roots[:1]:
                    yield from self._pieces(model, document, tag, root.text, root)
        for element in model.elements:
            if element.text and not model.is_unresolved(element):
                position = element.origin.position
                written = model.tag(position)
                if written is not None:
                    yield from self._pieces(model, model.document(position.file), written, element.text, element)

    def _pieces(self, model: Model, document: Document, tag: Tag, expanded: str, element: Element) -> Iterator[Finding]:
        text, source = document.source.text, document.source
        inside = [(child.start, child.close_end) for child in tag.children]
        inside += [
            (start, end) for start, end, _ in document.comments if tag.end <= start < (tag.close or tag.close_end)
        ]
        at = tag.end
        for start, end in [*sorted(inside), (tag.close or tag.close_end, 0)]:
            piece = text[at:start]
            words = " ".join(piece.split())
            if words and words.split()[0] in expanded:
                first = at + len(piece) - len(piece.lstrip())
                span = source.span(first, first + len(piece.strip()))
                shown = words if len(words) <= 40 else words[:39] + "…"
                yield Finding(
                    self.code,
                    self.name,
                    self.severity,
                    f"`{shown}` is text inside <{tag.name}>, which holds none: readers skip it",
                    span,
                    help="take it away, or write what was meant",
                    fix=Fix("unsafe", "Take the text away", (Edit(span, ""),)),
                    chains=(element.origin.expansions,) if element.origin.expansions else (),
                )
            at = end
