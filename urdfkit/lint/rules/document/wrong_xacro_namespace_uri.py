"""E004 wrong-xacro-namespace-uri."""

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Document
from urdfkit.lint.model.xacro_prefix import NAMESPACE
from urdfkit.lint.rule import Findings, Model, SourceRule


class WrongXacroNamespaceUri(SourceRule):
    """The prefix ``xacro:`` is not bound to the namespace of xacro.

    ## What it does
    Compares ``xmlns:xacro`` on the root element with the namespaces that xacro has used:
    ``http://www.ros.org/wiki/xacro`` (also without ``www.``) and ``http://wiki.ros.org/xacro``, each with ``http`` or
    ``https``.

    ## Why is this bad?
    xacro identifies its elements by their prefix and still expands the file, but warns of "inconsistent namespace
    redefinitions" when it includes a file with the correct namespace. Other XML tools do not recognize the elements.

    ## Example
    ```diff
    -<robot name="arm" xmlns:xacro="TheRobot">
    +<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:property name="length" value="0.4"/>
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Safe: the prefix has only one meaning.
    """

    code = "E004"
    name = "wrong-xacro-namespace-uri"
    severity = "warning"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding if the root element binds the prefix to another namespace."""
        text = document.source.text
        if text.count("xmlns:xacro") == text.count(f'xmlns:xacro="{NAMESPACE}"'):
            return
        root = document.root
        if root is None:
            return
        written = root.attributes.get("xmlns:xacro")
        if written is None or _is_xacro_namespace(written.value):
            return
        span = document.source.span(written.value_start, written.value_end)
        yield self.at(
            model,
            document.source.position(root.start),
            f"`{written.value}` is not xacro's namespace",
            attribute="xmlns:xacro",
            help=f'write xmlns:xacro="{NAMESPACE}"',
            fix=Fix("safe", "Replace with xacro's namespace", (Edit(span, NAMESPACE),)),
            # Output of xacro keeps the declaration, but does not use it.
            severity="note" if document.source.file.endswith(".urdf") and not _uses_xacro(document) else None,
        )


def _uses_xacro(document: Document) -> bool:
    return any(tag.name.startswith("xacro:") for tag in document.walk())


def _is_xacro_namespace(address: str) -> bool:
    """Whether an address is a namespace that xacro has used, ignoring the part after `#`."""
    bare = address.strip().partition("#")[0].rstrip("/")
    for prefix in ("https://", "http://", "www."):
        bare = bare.removeprefix(prefix)
    return bare in ("ros.org/wiki/xacro", "wiki.ros.org/xacro")
