"""E004 wrong-xacro-namespace-uri."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.prefix import NAMESPACE
from urdfkit.lint.rule import SourceRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document


class WrongXacroNamespaceUri(SourceRule):
    """The prefix ``xacro:`` is bound to something other than xacro's namespace.

    ## What it does
    Compares ``xmlns:xacro`` on the root element with the addresses that xacro has had:
    ``http://www.ros.org/wiki/xacro``, with or without ``www.``, ``http://wiki.ros.org/xacro``, and the same with
    ``https``.

    ## Why is this bad?
    xacro goes by the prefix and expands the file all the same, but warns of "inconsistent namespace redefinitions"
    when it includes a file that has the right one, and other tools that read XML do not take the elements for
    xacro's.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="TheRobot">
      <xacro:property name="length" value="0.4"/>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="length" value="0.4"/>
      <link name="base"/>
    </robot>
    ```

    ## Fix safety
    Safe: the prefix has one meaning.
    """

    code = "E004"
    name = "wrong-xacro-namespace-uri"
    severity = "warning"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield a finding where the root element binds the prefix to another address."""
        text = document.source.text
        if text.count("xmlns:xacro") == text.count(f'xmlns:xacro="{NAMESPACE}"'):
            return
        root = document.root
        if root is None:
            return
        written = root.attributes.get("xmlns:xacro")
        if written is None or _is_right(written.value):
            return
        span = document.source.span(written.value_start, written.value_end)
        yield self.at(
            model,
            document.source.position(root.start),
            f"`{written.value}` is not xacro's namespace",
            attribute="xmlns:xacro",
            help=f'write xmlns:xacro="{NAMESPACE}"',
            fix=Fix("safe", "Write xacro's namespace", (Edit(span, NAMESPACE),)),
            # What xacro made carries the declaration along, and nothing uses it any more.
            severity="info" if document.source.file.endswith(".urdf") and "<xacro:" not in text else None,
        )


def _is_right(address: str) -> bool:
    """Whether an address is one that xacro has had; what comes after `#` does not count."""
    bare = address.strip().partition("#")[0].rstrip("/")
    for beginning in ("https://", "http://", "www."):
        bare = bare.removeprefix(beginning)
    return bare in ("ros.org/wiki/xacro", "wiki.ros.org/xacro")
