"""X123 xacro-in-plain-urdf."""

import re

from urdfkit.lint.model.tags import Document
from urdfkit.lint.model.xacro_prefix import URDF_CHILDREN
from urdfkit.lint.rule import Findings, Model, SourceRule


class XacroInPlainUrdf(SourceRule):
    """A ``.urdf`` file contains xacro.

    ## What it does
    Checks files with the extension ``.urdf`` for elements with the ``xacro:`` prefix and for expressions. If the file
    declares the prefix, unknown elements are reported as well, because they are probably macro calls without the
    prefix. A declared but unused prefix is accepted, because xacro itself writes it.

    ## Why is this bad?
    The extension indicates plain URDF. RViz, MoveIt and viewers read the file without expanding it, so macros are
    missing and ``${…}`` takes the place of numbers.

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

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for a ``.urdf`` file that needs xacro."""
        text, source = document.source.text, document.source
        if not source.file.endswith(".urdf") or ("xacro" not in text and "${" not in text) or not document.roots:
            return
        root = document.roots[0]
        declares_prefix = "xmlns:xacro" in root.attributes
        for tag in document.walk():
            start_tag = text[tag.start : tag.end]
            allowed = URDF_CHILDREN.get(tag.parent.name) if tag.parent is not None and tag.parent is not root else None
            is_unprefixed_call = (
                declares_prefix and allowed is not None and tag.name not in allowed and ":" not in tag.name
            )
            if (
                tag.name.startswith("xacro:")
                or ("${" in start_tag and re.search(r"\$\{[^{}]*\}", start_tag))
                or (is_unprefixed_call and tag.attributes)
            ):
                yield self.at(
                    model,
                    source.position(root.start),
                    f"file requires xacro because of <{tag.name}> in line {source.position(tag.start).line}",
                    attribute="xmlns:xacro" if declares_prefix else None,
                    help=f"rename the file to {source.file.rpartition('/')[2]}.xacro",
                )
                return
