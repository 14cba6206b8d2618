"""E019 unused-suppression."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from urdfkit.lint.rule import Findings, Model, Rule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.facts.suppressions import Suppression


class UnusedSuppression(Rule):
    """A suppression comment suppresses no finding.

    ## What it does
    Checks for ``urdfkit: ignore …`` comments that match no finding, and for individual codes in such comments that
    match no finding. Codes that are not selected or do not apply to the target are not checked. Robots with missing
    parts are not checked either. A comment in an included file counts as used if it suppresses a finding of any linted
    robot.

    ## Why is this bad?
    An unused comment hides future findings.

    ## Example
    ```diff
     <robot name="arm">
    -  <!-- urdfkit: ignore J403 -->
       <link name="base"/>
     </robot>
    ```
    """

    code = "E019"
    name = "unused-suppression"
    severity = "note"

    def check(self, unused: Iterable[tuple[Suppression, Collection[str]]], model: Model) -> Findings:
        """Yield a finding for each suppression, with its unused codes."""
        for suppression, codes in unused:
            message = f"unused suppression of `{'`, `'.join(codes)}`" if codes else "unused suppression"
            yield self.at(model, suppression.position, message, help="remove it")
