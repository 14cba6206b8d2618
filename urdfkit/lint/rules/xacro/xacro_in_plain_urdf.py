"""X123 xacro-in-plain-urdf."""

from __future__ import annotations

import re

from urdfkit.lint.prefix import URDF_CHILDREN
from urdfkit.lint.rule import SourceRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document


class XacroInPlainUrdf(SourceRule):
    """A file called ``.urdf`` has to be run through xacro.

    ## What it does
    Looks in files that end in ``.urdf`` for elements with ``xacro:`` and for expressions, and for a bound prefix
    together with elements that URDF does not have (a macro call that lost its prefix). A prefix that is bound and
    not used is what xacro itself writes.

    ## Why is this bad?
    By its name nothing has to be expanded: RViz, MoveIt and viewers read it as it is, without macros and with
    ``${…}`` for numbers.

    ## Example
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base"/>
      <xacro:property name="width" value="0.3"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
    </robot>
    ```
    """

    code = "X123"
    name = "xacro-in-plain-urdf"
    severity = "warning"

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield a finding for a plain URDF that is none."""
        text, source = document.source.text, document.source
        if not source.file.endswith(".urdf") or ("xacro" not in text and "${" not in text) or not document.roots:
            return
        root = document.roots[0]
        binds = "xmlns:xacro" in root.attributes
        for tag in document.walk():
            start_tag = text[tag.start : tag.end]
            allowed = URDF_CHILDREN.get(tag.parent.name) if tag.parent is not None and tag.parent is not root else None
            is_lost_call = binds and allowed is not None and tag.name not in allowed and ":" not in tag.name
            if (
                tag.name.startswith("xacro:")
                or ("${" in start_tag and re.search(r"\$\{[^{}]*\}", start_tag))
                or (is_lost_call and tag.attributes)
            ):
                yield self.at(
                    model,
                    source.position(root.start),
                    f"this file has to be run through xacro: line {source.position(tag.start).line} has <{tag.name}",
                    attribute="xmlns:xacro" if binds else None,
                    help=f"call it {source.file.rpartition('/')[2]}.xacro",
                )
                return
