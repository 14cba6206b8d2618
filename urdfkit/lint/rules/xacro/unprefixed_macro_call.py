"""X102 unprefixed-macro-call."""

import re

from urdfkit.lint.finding import Fix
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.model.xacro_prefix import FOREIGN, URDF_CHILDREN, URDF_ELEMENTS, Signature, prefixing
from urdfkit.lint.rule import Findings, Model, SourceRule

_TRANSPARENT = ("xacro:if", "xacro:unless", "if", "unless")


class UnprefixedMacroCall(SourceRule):
    """A macro call lacks the ``xacro:`` prefix.

    ## What it does
    Checks for elements that have the name of a macro (of any of the files) but no prefix, in places where URDF has no
    element of that name.

    ## Why is this bad?
    xacro copies the element to the robot, where parsers silently ignore it. The content of the macro, such as the
    wheels or the inertia, is missing, although check_urdf reports "Successfully Parsed".

    ## Example
    ```diff
     <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="frame" params="name">
         <link name="${name}_frame"/>
       </xacro:macro>
    -  <frame name="left"/>
    +  <xacro:frame name="left"/>
     </robot>
    ```

    ## Fix safety
    Safe: the element is not part of URDF, and a macro of that name exists.
    """

    code = "X102"
    name = "unprefixed-macro-call"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each call without the prefix."""
        sources = model.expanded.sources.values()
        used = set(re.findall(r"<([^\s/>]+)", document.source.text))
        if all(used.isdisjoint(_near_definitions(source.text)) for source in sources):
            return
        macros = model.signatures
        if used.isdisjoint(macros):
            return
        for tag in document.walk():
            if tag.name in macros and _is_call(tag, macros[tag.name]):
                message = f"call of macro `{tag.name}` lacks the `xacro:` prefix"
                help = f"write `<xacro:{tag.name}>`"
                fix = Fix("safe", f"Replace with `xacro:{tag.name}`", prefixing(document, tag))
                yield self.at(model, document.source.position(tag.start), message, help=help, fix=fix)


def _near_definitions(text: str) -> set[str]:
    """Return candidate names of macros: every piece between quotes after the word ``macro``."""
    heads = [piece.partition("<")[0].replace("'", '"') for piece in text.split("macro")[1:]]
    return {part.removeprefix("xacro:") for head in heads for part in head.split('"')} - {""}


def _is_call(tag: Tag, signatures: list[Signature]) -> bool:
    if tag.name in URDF_ELEMENTS and _is_urdf_element(tag):
        return False
    if tag.parent is None:
        return False
    if any(ancestor.name in FOREIGN for ancestor in tag.ancestors()):
        # Embedded formats may have elements of any name; only an exact match of the parameters is a call.
        arguments = frozenset(tag.attributes)
        return bool(arguments) and any(macro.required <= arguments <= macro.names for macro in signatures)
    return True


def _is_urdf_element(tag: Tag) -> bool:
    ancestor = tag.parent
    while ancestor is not None and ancestor.name in _TRANSPARENT:
        ancestor = ancestor.parent
    if ancestor is None:
        return False
    allowed = URDF_CHILDREN.get(ancestor.name)
    # The content of a macro or block may be inserted anywhere.
    return tag.name in (URDF_ELEMENTS if allowed is None else allowed)
