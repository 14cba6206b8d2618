"""N302 invalid-name-characters."""

import re

from urdfkit.lint.rule import Findings, Model, RobotRule


class InvalidNameCharacters(RobotRule):
    """A name contains characters that some tools do not accept.

    ## What it does
    Checks the names of links and joints for spaces, quotes, ``<``, ``>``, ``&``, non-ASCII characters, and a leading
    slash.

    ## Why is this bad?
    check_urdf accepts such names, but TF rejects frame names with a leading slash, and topics, parameters and MJCF
    files generated from such names are invalid.

    ## Example
    ```diff
     <robot name="cart">
    -  <link name="left wheel"/>
    +  <link name="left_wheel"/>
     </robot>
    ```
    """

    code = "N302"
    name = "invalid-name-characters"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invalid name."""
        for part in model.parts:
            name = part.name
            if "$" in name or model.is_unresolved(part.element, "name") or ("\ufffd" in name and model.encoding_faults):
                continue
            invalid = re.search(r"^/|[^!-~]|[\"'`<>&]", name)
            if invalid is not None:
                character = {" ": "a space", "/": "a leading slash"}.get(invalid[0], f"`{invalid[0]}`")
                yield self.at(
                    model,
                    part.element,
                    f"name of {part.element.tag} `{name}` contains {character}",
                    attribute="name",
                    link=name if part.element.tag == "link" else None,
                    joint=name if part.element.tag == "joint" else None,
                    help="use only letters, digits, `_`, `-` and `.`",
                )
