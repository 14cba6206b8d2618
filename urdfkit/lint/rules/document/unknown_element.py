"""E008 unknown-element."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_tag
from urdfkit.lint.prefix import URDF_ATTRIBUTES, URDF_CHILDREN, misspelt_in_robot
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding, Fix
    from urdfkit.lint.model import Model

_BETTER = {"joint_properties": "dynamics"}
"""Names of elements that URDF once had, and what they are called today."""


class UnknownElement(RobotRule):
    """URDF has no such element there.

    ## What it does
    Looks at what is inside ``<link>``, ``<joint>``, ``<inertial>``, ``<visual>``, ``<collision>`` and ``<geometry>``.
    Elements with a prefix belong to somebody else. The root is ``<robot>``, which may hold extensions of any name:
    there an element is reported where its name is nearly that of a link, a joint or another that belongs there, and so
    it is in ``<transmission>`` and ``<ros2_control>``.

    ## Why is this bad?
    Readers skip it without a word: a typing error, or a macro call without prefix, takes wheels, damping or inertia
    away and check_urdf still says "Successfully Parsed".

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel"/>
      <joint name="axle" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
        <joint_properties damping="0.1"/>
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
        <dynamics damping="0.1"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Unsafe: the element is called what its name is nearest to, or what it is called today; calls of macros are left to
    you.
    """

    code = "E008"
    name = "unknown-element"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each element that has no meaning where it stands."""
        robot = model.robot.element
        if robot.tag != "robot":
            fix = new_tag(model, robot, "robot", "unsafe", "Call it <robot>")
            message = f"<{robot.tag}> is no robot description"
            yield self.at(model, robot, message, help="did you mean `robot`?", fix=fix, severity="error")
        for child in robot.children:
            if (meant := misspelt_in_robot(child)) is not None:
                fix = new_tag(model, child, meant, "unsafe", f"Call it <{meant}>")
                help = f"did you mean `{meant}`?"
                yield self.at(model, child, _message(robot, child), help=help, fix=fix, severity="error")
        yield from self._of_control(model)
        for link in model.robot.links:
            for parent, child in _unknown(link.element):
                hint, fix = _hint(parent, child), _renamed(model, parent, child)
                yield self.at(model, child, _message(parent, child), link=link.name, help=hint, fix=fix)
        for joint in model.robot.joints:
            for parent, child in _unknown(joint.element):
                hint, fix = _hint(parent, child), _renamed(model, parent, child)
                yield self.at(model, child, _message(parent, child), joint=joint.name, help=hint, fix=fix)

    def _of_control(self, model: Model) -> Iterator[Finding]:
        robot = model.robot
        for whole in (*(one.element for one in robot.transmissions), *(one.element for one in robot.ros2_control)):
            from urdfkit.lint.interfaces import misspelt_parts

            for parent, child, meant in misspelt_parts(whole, whole.tag):
                fix = new_tag(model, child, meant, "unsafe", f"Call it <{meant}>")
                yield self.at(model, child, _message(parent, child), help=f"did you mean `{meant}`?", fix=fix)


def _unknown(element: Element) -> Iterator[tuple[Element, Element]]:
    allowed = URDF_CHILDREN[element.tag]
    for child in element.children:
        if child.tag not in allowed:
            if ":" not in child.tag:
                yield element, child
        elif child.tag in URDF_CHILDREN and child.tag != "material":
            yield from _unknown(child)


def _message(parent: Element, child: Element) -> str:
    return f"<{child.tag}> has no meaning in <{parent.tag}>"


def _hint(parent: Element, child: Element) -> str | None:
    if child.tag in _BETTER:
        return f"it is called <{_BETTER[child.tag]}> today"
    near = nearest(child.tag, URDF_CHILDREN[parent.tag], likeness=0.7)
    if near or not child.attributes:
        return f"did you mean `{near}`?" if near else None
    return "a call of a macro needs the prefix `xacro:`, and a file that is run through xacro"


def _renamed(model: Model, parent: Element, child: Element) -> Fix | None:
    meant = _BETTER.get(child.tag) or nearest(child.tag, URDF_CHILDREN[parent.tag], likeness=0.75)
    if meant is None or (meant != "visual" and meant != "collision" and parent.find(meant) is not None):
        return None
    if not child.attributes.keys() <= set(URDF_ATTRIBUTES.get(meant, ())):
        return None  # A call of a macro, rather.
    return new_tag(model, child, meant, "unsafe", f"Call it <{meant}>")
