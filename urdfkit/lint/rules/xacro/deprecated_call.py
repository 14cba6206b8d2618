"""X117 deprecated-xacro-cli-or-call."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Edit, Finding, Fix
from urdfkit.lint.rule import SourceRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document


class DeprecatedCall(SourceRule):
    """A function of xacro is called by a deprecated name.

    ## What it does
    Looks in expressions for ``load_yaml``, ``message``, ``warning`` and ``error`` without ``xacro.`` before them.

    ## Why is this bad?
    xacro warns at each run ("Using load_yaml() directly is deprecated"), and will stop to know it.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="arm" params="file">
        <xacro:property name="lengths" value="${load_yaml(file)}"/>
        <link name="${lengths}"/>
      </xacro:macro>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="arm" params="file">
        <xacro:property name="lengths" value="${xacro.load_yaml(file)}"/>
        <link name="${lengths}"/>
      </xacro:macro>
      <link name="base"/>
    </robot>
    ```

    ## Fix safety
    Safe: both call the same function.
    """

    code = "X117"
    name = "deprecated-xacro-cli-or-call"
    severity = "warning"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield a finding for each call by the old name."""
        text, source = document.source.text, document.source
        if "load_yaml" not in text:
            return
        for at in re.finditer(r"\$\{[^{}]*?(?<![\w.])(load_yaml)\(", text):
            if any(start <= at.start() < end for start, end, _ in document.comments):
                continue
            span = source.span(at.start(1), at.end(1))
            yield Finding(
                self.code,
                self.name,
                self.severity,
                "`load_yaml()` without `xacro.` is deprecated",
                span,
                help="write `xacro.load_yaml()`",
                fix=Fix("safe", "Write `xacro.load_yaml`", (Edit(span, "xacro.load_yaml"),)),
            )
