"""X102 unprefixed-macro-call."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Fix
from urdfkit.lint.prefix import FOREIGN, URDF_CHILDREN, URDF_ELEMENTS, prefixing
from urdfkit.lint.rule import SourceRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.prefix import Signature
    from urdfkit.lint.syntax import Document, Tag

_TRANSPARENT = ("xacro:if", "xacro:unless", "if", "unless")


class UnprefixedMacroCall(SourceRule):
    """An element has the name of a macro, but not the ``xacro:`` prefix that calls it.

    ## What it does
    Looks for elements whose name is that of a macro defined in any of the files, at places where URDF has no element
    of that name.

    ## Why is this bad?
    xacro copies the element into the robot, where every reader skips it without a word: the wheels, or the inertia,
    are just not there. check_urdf still says "Successfully Parsed".

    ## Example
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name">
        <link name="${name}_frame"/>
      </xacro:macro>
      <frame name="left"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name">
        <link name="${name}_frame"/>
      </xacro:macro>
      <xacro:frame name="left"/>
    </robot>
    ```

    ## Fix safety
    Safe: the element is no URDF, and a macro of that name is there to be called.
    """

    code = "X102"
    name = "unprefixed-macro-call"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield a finding for each call without its prefix."""
        sources = model.expanded.sources.values()
        if not any(f"<{name}" in document.source.text for source in sources for name in _near_definitions(source.text)):
            return
        macros = model.signatures
        if not macros:
            return
        names = "|".join(re.escape(name) for name in macros)
        if not re.search(rf"<(?:{names})[\s/>]", document.source.text):
            return
        for tag in document.walk():
            if tag.name in macros and _is_call(tag, macros[tag.name]):
                yield self.at(
                    model,
                    document.source.position(tag.start),
                    f"`<{tag.name}>` is copied, not expanded: a call of the macro `{tag.name}` is `<xacro:{tag.name}>`",
                    fix=Fix("safe", f"Write `xacro:{tag.name}`", prefixing(document, tag)),
                )


def _near_definitions(text: str) -> set[str]:
    """Return what may be a macro's name: all that quotes cut off behind the word."""
    heads = [piece.partition("<")[0].replace("'", '"') for piece in text.split("macro")[1:]]
    return {part.removeprefix("xacro:") for head in heads for part in head.split('"')} - {""}


def _is_call(tag: Tag, signatures: list[Signature]) -> bool:
    if tag.name in URDF_ELEMENTS and _is_urdf_there(tag):
        return False
    if tag.parent is None:
        return False
    if any(above.name in FOREIGN for above in tag.ancestors()):
        # Other formats have elements of any name there; only one that fits the macro exactly is a call.
        given = frozenset(tag.attributes)
        return bool(given) and any(macro.required <= given <= macro.known for macro in signatures)
    return True


def _is_urdf_there(tag: Tag) -> bool:
    above = tag.parent
    while above is not None and above.name in _TRANSPARENT:
        above = above.parent
    if above is None:
        return False
    allowed = URDF_CHILDREN.get(above.name)
    # The content of a macro, or of a block given to one, may land anywhere.
    return tag.name in (URDF_ELEMENTS if allowed is None else allowed)
