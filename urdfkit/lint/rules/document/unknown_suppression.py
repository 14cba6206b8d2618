"""E018 unknown-suppression."""

from __future__ import annotations

from collections.abc import Iterable

from urdfkit.lint.rule import Findings, Model, Rule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.facts.suppressions import Suppression


class UnknownSuppression(Rule):
    """A suppression comment is malformed or names an unknown rule.

    ## What it does
    Checks comments that begin with ``urdfkit:``. Two forms are valid. ``ignore CODE …`` applies to its own line and, if
    it is alone on the line, also to the next element. ``ignore-file CODE …`` applies to the whole file. Without codes,
    a comment suppresses every rule.

    ## Why is this bad?
    The comment does not suppress the intended finding, and may later suppress a new rule with this code.

    ## Example
    ```diff
     <robot name="arm">
    -  <!-- urdfkit: ignore J4O2 -->
       <link name="base"/>
    +  <link name="arm"/>
    +  <joint name="shoulder" type="hinge"> <!-- urdfkit: ignore J402 our reader supports it -->
    +    <parent link="base"/>
    +    <child link="arm"/>
    +  </joint>
     </robot>
    ```
    """

    code = "E018"
    name = "unknown-suppression"
    severity = "warning"

    def check(self, suppressions: Iterable[Suppression], codes: Iterable[str], model: Model) -> Findings:
        """Yield a finding for each malformed suppression and each unknown code."""
        from urdfkit.errors import did_you_mean
        from urdfkit.lint.project.rule_selection import similar_code

        rule_codes = tuple(codes)
        for suppression in suppressions:
            if suppression.verb not in ("ignore", "ignore-file"):
                message = f"unknown suppression `urdfkit: {suppression.verb}`" + did_you_mean(suppression.verb, _VERBS)
                yield self.at(
                    model, suppression.position, message, help="write ignore or ignore-file, followed by rule codes"
                )
            for code in suppression.codes:
                if code not in rule_codes:
                    message = f"unknown rule `{code}` in suppression" + similar_code(code, rule_codes)
                    yield self.at(model, suppression.position, message)


_VERBS = ("ignore", "ignore-file")
