"""E009 unknown-attribute."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_name, without_attribute
from urdfkit.lint.prefix import URDF_ATTRIBUTES
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_KEYS = {tag: frozenset(names) for tag, names in URDF_ATTRIBUTES.items()}
_CALLED = {
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
"""What is called so elsewhere, in SDFormat mostly, and how URDF calls it."""

_ALL = frozenset(name for names in URDF_ATTRIBUTES.values() for name in names)


class UnknownAttribute(RobotRule):
    """URDF has no such attribute on that element.

    ## What it does
    Looks at the attributes of links, joints and what they hold. Attributes with a prefix belong to somebody else;
    what is neither misspelt nor an attribute of another element may be somebody's extension, and is a note.

    ## Why is this bad?
    Readers skip it without a word: an axis is not turned by ``rpy``, and a misspelt ``efort`` limits nothing.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel"/>
      <joint name="axle" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
        <axis xyz="0 1 0" rpy="0 0 0"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel"/>
      <joint name="axle" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
        <axis xyz="0 1 0"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Unsafe: a misspelt attribute is renamed, any other taken away; it may have been meant for another element.
    """

    code = "E009"
    name = "unknown-attribute"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each attribute that has no meaning where it stands."""
        for element in model.elements:
            known = URDF_ATTRIBUTES.get(element.tag)
            if known is not None and not element.attributes.keys() <= _KEYS[element.tag]:
                yield from self._look(model, element, known)

    def _look(self, model: Model, element: Element, known: tuple[str, ...]) -> Iterator[Finding]:
        for attribute in element.attributes:
            if attribute not in known and ":" not in attribute and attribute != "xmlns":
                meant = _CALLED.get((element.tag, attribute)) or nearest(attribute, known)
                if meant is None or meant in element.attributes:
                    meant, fix = None, None
                    if attribute in _ALL:
                        fix = without_attribute(model, element, attribute, "unsafe", f"Take `{attribute}` away")
                else:
                    fix = new_name(model, element, attribute, meant, "unsafe", f"Call it `{meant}`")
                yield self.at(
                    model,
                    element,
                    f"`{attribute}` has no meaning on <{element.tag}>",
                    attribute=attribute,
                    help=f"did you mean `{meant}`?" if meant else f"it has {', '.join(known) or 'no attributes'}",
                    fix=fix,
                    severity=None if meant or attribute in _ALL else "info",
                )
