"""N302 invalid-name-characters."""

from __future__ import annotations

import re

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class InvalidNameCharacters(RobotRule):
    """A name has characters that not every tool takes.

    ## What it does
    Looks at the names of links and joints for blanks, quotes, letters beyond ASCII and a slash in front.

    ## Why is this bad?
    check_urdf accepts them. TF refuses frames that begin with a slash, and topics, parameters and MJCF made from
    such names do not work.

    ## Example
    ```xml
    <robot name="cart">
      <link name="left wheel"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="left_wheel"/>
    </robot>
    ```
    """

    code = "N302"
    name = "invalid-name-characters"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each name with such a character."""
        for part in model.parts:
            name = part.name
            if "$" in name or model.is_unresolved(part.element, "name") or ("\ufffd" in name and model.misread):
                continue
            wrong = re.search(r"^/|[^!-~]|[\"'`<>&]", name)
            if wrong is not None:
                what = {" ": "a blank", "/": "a slash in front"}.get(wrong[0], f"`{wrong[0]}`")
                yield self.at(
                    model,
                    part.element,
                    f"the name `{name}` of a {part.element.tag} has {what} in it",
                    attribute="name",
                    link=name if part.element.tag == "link" else None,
                    joint=name if part.element.tag == "joint" else None,
                    help="letters, digits, `_`, `-` and `.` work everywhere",
                )
