"""E019 unused-suppression."""

from __future__ import annotations

from urdfkit.lint.rule import Rule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.suppress import Suppression


class UnusedSuppression(Rule):
    """A comment suppresses what is not found any more.

    ## What it does
    Looks for comments ``urdfkit: ignore …`` that no finding meets, and for codes in them that none does. Codes that
    are not asked for, or that the target leaves out, are let be, and so are comments where parts of the robot are
    missing. A comment in an included file is in use if it is for one of the robots linted.

    ## Why is this bad?
    It will hide the next finding, which nobody has looked at.

    ## Example
    ```xml
    <robot name="arm">
      <!-- urdfkit: ignore J403 -->
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
    </robot>
    ```
    """

    code = "E019"
    name = "unused-suppression"
    severity = "info"

    def check(self, unused: Iterable[tuple[Suppression, Collection[str]]], model: Model) -> Iterator[Finding]:
        """Yield a finding for each suppression, with those of its codes that nothing was found for."""
        for suppression, codes in unused:
            what = f"there is no `{'`, `'.join(codes)}` here" if codes else "there is no finding here"
            yield self.at(model, suppression.position, f"{what} to ignore", help="take it away")
