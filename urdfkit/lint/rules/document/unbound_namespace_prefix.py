"""E002 unbound-namespace-prefix."""

import re

from urdfkit.lint.finding import Fix
from urdfkit.lint.model.tags import Document
from urdfkit.lint.model.xacro_prefix import declaration, declares_xacro, has_xacro_as_default
from urdfkit.lint.rule import Findings, Model, SourceRule

_PREFIXED = r"[<\s]([A-Za-z_][\w.-]*):[A-Za-z_][\w.-]*(?=[\s/>=])"
_NOT_IN_NAMES = frozenset("\"'=/>")


class UnboundNamespacePrefix(SourceRule):
    """A namespace prefix is used but not bound.

    ## What it does
    Checks for prefixes such as ``xacro:`` that no enclosing element binds with ``xmlns:…``. Every file, including
    included files, must bind the prefixes that it uses.

    ## Why is this bad?
    XML parsers stop with "unbound prefix" and do not report which declaration is missing.

    ## Example
    ```diff
    -<robot name="arm" xmlns="http://www.ros.org/wiki/xacro">
    +<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:property name="length" value="0.4"/>
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Safe for ``xacro:``, which has only one meaning. No fix is offered for other prefixes.
    """

    code = "E002"
    name = "unbound-namespace-prefix"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield one finding for each unbound prefix, at the root element.

        A default namespace that is xacro's own is reported even if no prefix is used yet.
        """
        text = document.source.text
        if "xmlns=" in text and has_xacro_as_default(document) and not declares_xacro(document):
            message = "xacro's namespace is the default namespace of this file, so the prefix `xacro:` is unbound"
            help = "write xmlns:xacro instead of xmlns"
            fix = Fix("safe", "Replace with `xmlns:xacro`", declaration(document))
            yield self.at(
                model, document.source.position(document.roots[0].start), message, attribute="xmlns", help=help, fix=fix
            )
            return
        if not any(f"xmlns:{prefix}" not in text for prefix in _before_colons(text)):
            return
        used = {prefix for prefix in re.findall(_PREFIXED, text) if f"xmlns:{prefix}" not in text} - {"xml", "xmlns"}
        if not used or not document.roots:
            return
        root = document.roots[0]
        is_expanded = not document.source.file.endswith(".urdf")
        for tag in document.walk():
            names = (tag.name, *tag.attributes) if ":" in text[tag.start : tag.end] else ()
            for prefix in [name.partition(":")[0] for name in names if ":" in name]:
                if prefix not in used:
                    continue
                used.discard(prefix)
                first = document.source.position(tag.start)
                edits = declaration(document) if prefix == "xacro" else ()
                binding = f'xmlns:{prefix}="{"http://www.ros.org/wiki/xacro" if prefix == "xacro" else "…"}"'
                yield self.at(
                    model,
                    document.source.position(root.start),
                    f"unbound prefix `{prefix}:`, first used on line {first.line}",
                    help=f"add {binding} to the root element of this file",
                    fix=Fix("safe", f"Bind the prefix `{prefix}:`", edits) if edits else None,
                    severity=None if prefix == "xacro" or is_expanded else "warning",
                )


def _before_colons(text: str) -> set[str]:
    """Return the words before colons, each from white space or ``<`` on: these may be prefixes."""
    words = {word.rpartition("<")[2] for piece in text.split(":")[:-1] for word in piece.rsplit(None, 1)[-1:]}
    return {word for word in words if word and _NOT_IN_NAMES.isdisjoint(word)} - {"xml", "xmlns"}
