"""N304 prefix-missing."""

import re

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Attribute, Document, Tag
from urdfkit.lint.rule import Findings, Model, SourceRule

_PREFIXED = re.compile(r"(\$\{\s*(\w+)\s*\}_?)(\w+)")
"""Matches a name with the value of a parameter before it."""

_REFERENCES = {
    "parent": "link",
    "child": "link",
    "mimic": "joint",
    "gazebo": "reference",
    "joint": "name",
    "link": "name",
}
"""Tag → its attribute that defines or refers to a link or joint."""


class PrefixMissing(SourceRule):
    """A macro uses the name of a link or joint without the prefix of its definition.

    ## What it does
    Checks macros that put a parameter before the names of links and joints, such as ``${prefix}forearm``. Reports a use
    of the same name without this parameter. A name is accepted if the files of the robot also define it without a
    prefix.

    ## Why is this bad?
    The robot is correct as long as the prefix is empty. With a prefix, the name is undefined, or two robots share it.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="arm" params="prefix:=''">
         <link name="${prefix}base"/>
         <link name="${prefix}tool"/>
         <joint name="${prefix}flange" type="fixed">
    -      <parent link="base"/>
    +      <parent link="${prefix}base"/>
           <child link="${prefix}tool"/>
         </joint>
       </xacro:macro>
       <xacro:arm/>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the prefix, but a different link may be intended.
    """

    code = "N304"
    name = "prefix-missing"
    severity = "warning"
    fix = "unsafe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each name without its prefix."""
        source = document.source
        if "macro" not in source.text or "${" not in source.text:
            return
        for macro in document.walk():
            if macro.name not in ("xacro:macro", "macro") or "params" not in macro.attributes:
                continue
            parameters = set(re.findall(r"[A-Za-z_]\w*", macro.attributes["params"].value))
            names = [(tag, one) for tag in macro.walk() if (one := _name(tag)) is not None]
            prefixes = {}
            for _, written in names:
                match = _PREFIXED.fullmatch(written.value.strip())
                if match is not None and match[2] in parameters:
                    prefixes[match[3]] = match[1]
            for tag, written in names:
                prefix = prefixes.get(written.value)
                if prefix is None or _is_defined(written.value, macro, tag, model):
                    continue
                span = source.span(written.value_start, written.value_end)
                correct = f"{prefix}{written.value}"
                message = f"`{written.value}` lacks the prefix of `{correct}`"
                help = f"write `{correct}`"
                fix = Fix("unsafe", f"Replace with `{correct}`", (Edit(span, correct),))
                yield self.at(model, source.position(tag.start), message, attribute=written.name, help=help, fix=fix)


def _name(tag: Tag) -> Attribute | None:
    """Return the attribute of a tag, or of a macro call, that names a link or joint."""
    attribute = _REFERENCES.get(tag.name, "name" if tag.name.startswith("xacro:") else "")
    return tag.attributes.get(attribute) if attribute and tag.name != "xacro:macro" else None


def _is_defined(name: str, macro: Tag, tag: Tag, model: Model) -> bool:
    """Return whether another tag of the robot's files defines the name without a prefix."""
    if tag.name.startswith("xacro:"):
        return True  # Its name may be that of a macro's argument, or get the prefix in the macro.
    if tag.name in ("link", "joint") and not _is_reference(tag):
        return False
    pattern = re.compile(rf"<(?:link|joint|xacro:\w+)\s[^<>]*\bname\s*=\s*[\"']{re.escape(name)}[\"']")
    return any(pattern.search(source.text) for source in model.expanded.sources.values())


def _is_reference(tag: Tag) -> bool:
    return any(above.name in ("ros2_control", "transmission", "plugin") for above in tag.ancestors())
