"""X117 deprecated-xacro-cli-or-call."""

import re

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Document
from urdfkit.lint.rule import Findings, Model, SourceRule


class DeprecatedCall(SourceRule):
    """A xacro function is called without the prefix ``xacro.``.

    ## What it does
    Checks expressions for calls of ``load_yaml`` without the prefix ``xacro.``.

    ## Why is this bad?
    xacro logs a warning at every run ("Using load_yaml() directly is deprecated"), and a future version will remove the
    name without the prefix.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="arm" params="file">
    -    <xacro:property name="lengths" value="${load_yaml(file)}"/>
    +    <xacro:property name="lengths" value="${xacro.load_yaml(file)}"/>
         <link name="${lengths}"/>
       </xacro:macro>
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Safe: both names refer to the same function.
    """

    code = "X117"
    name = "deprecated-xacro-cli-or-call"
    severity = "warning"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each call by the deprecated name."""
        text, source = document.source.text, document.source
        if "load_yaml" not in text:
            return
        for match in re.finditer(r"\$\{[^{}]*?(?<![\w.])(load_yaml)\(", text):
            if any(start <= match.start() < end for start, end, _ in document.comments):
                continue
            span = source.span(match.start(1), match.end(1))
            message = "`load_yaml()` without `xacro.` is deprecated"
            fix = Fix("safe", "Replace with `xacro.load_yaml`", (Edit(span, "xacro.load_yaml"),))
            yield self.at_span(span, message, help="write `xacro.load_yaml()`", fix=fix)
