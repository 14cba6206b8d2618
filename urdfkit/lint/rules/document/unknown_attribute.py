"""E009 unknown-attribute."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.lint.fix_builders import nearest, new_name, without_attribute
from urdfkit.lint.model.xacro_prefix import URDF_ATTRIBUTES
from urdfkit.lint.rule import Findings, Model, RobotRule

_OF_OTHER_READERS = {"joint": frozenset(("dont_collapse",))}
"""Attributes that other programs read: Isaac Gym keeps such a fixed joint when it merges links."""
_ALLOWED = {tag: frozenset(names) | _OF_OTHER_READERS.get(tag, set()) for tag, names in URDF_ATTRIBUTES.items()}
_FOREIGN_NAMES = {
    ("limit", "min"): "lower",
    ("limit", "max"): "upper",
    ("cylinder", "height"): "length",
    ("parent", "name"): "link",
    ("child", "name"): "link",
    ("mesh", "file"): "filename",
    ("mesh", "uri"): "filename",
    ("mass", "mass"): "value",
    ("mimic", "name"): "joint",
}
"""Element and attribute in other formats, mostly SDFormat → attribute in URDF."""

_ALL = frozenset(name for names in URDF_ATTRIBUTES.values() for name in names)


class UnknownAttribute(RobotRule):
    """An element has an unknown attribute.

    ## What it does
    Checks the attributes of links, joints and their children. Attributes with a namespace prefix are accepted as
    extensions. An attribute that is neither misspelt nor an attribute of another URDF element is reported as a note,
    because it may be an extension.

    ## Why is this bad?
    Readers ignore the attribute silently: ``rpy`` does not rotate an axis, and a misspelt ``efort`` limits nothing.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="wheel"/>
       <joint name="axle" type="continuous">
         <parent link="base"/>
         <child link="wheel"/>
    -    <axis xyz="0 1 0" rpy="0 0 0"/>
    +    <axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix renames a misspelt attribute and removes any other, which may belong to another element.
    """

    code = "E009"
    name = "unknown-attribute"
    severity = "warning"
    fix = "unsafe"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unknown attribute."""
        for element in model.elements:
            allowed = URDF_ATTRIBUTES.get(element.tag)
            if allowed is not None and not element.attributes.keys() <= _ALLOWED[element.tag]:
                yield from self._check_attributes(model, element, allowed)

    def _check_attributes(self, model: Model, element: Element, allowed: tuple[str, ...]) -> Findings:
        for attribute in element.attributes:
            if attribute not in _ALLOWED[element.tag] and ":" not in attribute and attribute != "xmlns":
                suggestion = _FOREIGN_NAMES.get((element.tag, attribute)) or nearest(attribute, allowed)
                if suggestion is None or suggestion in element.attributes:
                    suggestion, fix = None, None
                    if attribute in _ALL:
                        fix = without_attribute(model, element, attribute, "unsafe", f"Remove `{attribute}`")
                else:
                    fix = new_name(model, element, attribute, suggestion, "unsafe")
                yield self.at(
                    model,
                    element,
                    f"unknown attribute `{attribute}` of <{element.tag}>",
                    attribute=attribute,
                    help=Suggestion(suggestion, before="")
                    if suggestion
                    else f"known attributes: {', '.join(allowed) or 'none'}",
                    fix=fix,
                    severity=None if suggestion or attribute in _ALL else "note",
                    kind="attribute",
                )
