"""E018 unknown-suppression."""

from __future__ import annotations

from urdfkit.lint.rule import Rule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.suppress import Suppression


class UnknownSuppression(Rule):
    """A comment suppresses a rule that does not exist, or cannot be read.

    ## What it does
    Checks the comments that begin with ``urdfkit:``. They are ``ignore CODE …`` (for its line and, where it stands
    alone, for the element after it) and ``ignore-file CODE …``; without codes they stand for every rule.

    ## Why is this bad?
    The finding it was meant for is reported all the same, or will be, once the code is taken for another rule.

    ## Example
    ```xml
    <robot name="arm">
      <!-- urdfkit: ignore J4O2 -->
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="shoulder" type="hinge"> <!-- urdfkit: ignore J402 our own reader knows it -->
        <parent link="base"/>
        <child link="arm"/>
      </joint>
    </robot>
    ```
    """

    code = "E018"
    name = "unknown-suppression"
    severity = "warning"

    def check(self, suppressions: Iterable[Suppression], codes: Iterable[str], model: Model) -> Iterator[Finding]:
        """Yield a finding for each suppression that says nothing we know."""
        from urdfkit.errors import did_you_mean

        known = tuple(codes)
        for suppression in suppressions:
            if suppression.verb not in ("ignore", "ignore-file"):
                message = f"`urdfkit: {suppression.verb}` is not known{did_you_mean(suppression.verb, _VERBS)}"
                yield self.at(model, suppression.position, message, help="write ignore or ignore-file, then codes")
            for code in suppression.codes:
                if code not in known:
                    message = f"there is no rule `{code}` to ignore{did_you_mean(code, known)}"
                    yield self.at(model, suppression.position, message)


_VERBS = ("ignore", "ignore-file")
