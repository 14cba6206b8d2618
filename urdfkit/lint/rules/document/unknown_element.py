"""E008 unknown-element."""

from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Fix, Severity
from urdfkit.lint.fix_builders import nearest, new_tag
from urdfkit.lint.model.xacro_prefix import URDF_ATTRIBUTES, URDF_CHILDREN, misspelt_in_robot
from urdfkit.lint.rule import Findings, Model, RobotRule

_CURRENT_NAMES = {"joint_properties": "dynamics"}
"""Obsolete names of URDF elements → current names."""


_IN_GAZEBO = frozenset(("sensor", "plugin", "selfCollide", "mu1", "mu2", "kp", "kd", "gravity", "turnGravityOff"))
"""Elements of ``<gazebo reference="…">`` that are written into links and joints by mistake."""


_OF_PINOCCHIO = ("link", "collision_checking")
"""Parent and tag of an element that Pinocchio's reader of URDF reads (capsules and convex hulls)."""


_PLACES = ("link", "visual", "collision", "geometry", "inertial", "joint", "material")


class UnknownElement(RobotRule):
    """An element is unknown in its parent.

    ## What it does
    Checks the children of ``<link>``, ``<joint>``, ``<inertial>``, ``<visual>``, ``<collision>`` and ``<geometry>``.
    Elements with a namespace prefix are accepted as extensions. If such an element replaces the shape in a
    ``<geometry>``, it is reported as a note. An element that resembles no URDF or SDF element is reported as a note,
    because another program probably reads it.

    The root element must be ``<robot>``. Because ``<robot>`` may contain extensions of any name, its children are
    reported only if their names nearly match ``link``, ``joint`` or another known element. The same applies to
    ``<transmission>`` and ``<ros2_control>``.

    ## Why is this bad?
    Readers ignore the element silently. A typing error, or a macro call without its prefix, removes wheels, damping or
    inertia, and check_urdf still prints "Successfully Parsed".

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="wheel"/>
       <joint name="axle" type="continuous">
         <parent link="base"/>
         <child link="wheel"/>
    -    <joint_properties damping="0.1"/>
    +    <dynamics damping="0.1"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix renames the element to the nearest known name. It renames an obsolete element to the name that
    replaced it. No fix is offered for macro calls.
    """

    code = "E008"
    name = "unknown-element"
    severity = "warning"
    fix = "unsafe"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unknown element."""
        robot = model.robot.element
        if robot.tag != "robot":
            fix = new_tag(model, robot, "robot", "unsafe")
            message = f"root element <{robot.tag}> is not a robot description"
            yield self.at(model, robot, message, help=Suggestion("robot", before=""), fix=fix, severity="error")
        for child in robot.children:
            if (tag := misspelt_in_robot(child)) is not None:
                fix = new_tag(model, child, tag, "unsafe")
                help = Suggestion(tag, before="")
                yield self.at(model, child, _message(robot, child), help=help, fix=fix, severity="error")
        yield from self._check_control(model)
        for link in model.robot.links:
            yield from self._check_content(model, link.element, link=link.name)
        for joint in model.robot.joints:
            yield from self._check_content(model, joint.element, joint=joint.name)

    def _check_content(
        self, model: Model, element: Element, *, link: str | None = None, joint: str | None = None
    ) -> Findings:
        for parent, child in _unknown(element):
            if ":" in child.tag and model.target == "drake":
                continue
            hint, fix, message = _hint(parent, child), _renamed(model, parent, child), _message(parent, child)
            is_extension = ":" in child.tag or (hint is None and parent.tag not in ("inertial", "geometry"))
            help = "ROS, Gazebo and MuJoCo ignore it" if is_extension else hint
            severity: Severity | None = "note" if is_extension else None
            yield self.at(model, child, message, link=link, joint=joint, help=help, fix=fix, severity=severity)

    def _check_control(self, model: Model) -> Findings:
        robot = model.robot
        elements = [block.element for block in robot.transmissions]
        for element in (*elements, *(block.element for block in robot.ros2_control)):
            from urdfkit.lint.facts.control.hardware_interfaces import misspelt_parts

            for parent, child, tag in misspelt_parts(element, element.tag):
                fix = new_tag(model, child, tag, "unsafe")
                yield self.at(model, child, _message(parent, child), help=Suggestion(tag, before=""), fix=fix)


def _unknown(element: Element) -> Iterator[tuple[Element, Element]]:
    allowed = URDF_CHILDREN[element.tag]
    for child in element.children:
        if child.tag not in allowed and (element.tag, child.tag) != _OF_PINOCCHIO:
            if ":" not in child.tag or (element.tag == "geometry" and len(element.children) == 1):
                yield element, child
        elif child.tag in URDF_CHILDREN and child.tag != "material":
            yield from _unknown(child)


def _message(parent: Element, child: Element) -> str:
    return f"unknown element <{child.tag}> in <{parent.tag}>"


def _hint(parent: Element, child: Element) -> str | None:
    """Return how to correct an unknown element; None if it resembles no element of URDF or SDF."""
    if child.tag in _CURRENT_NAMES:
        return f"rename it to <{_CURRENT_NAMES[child.tag]}>"
    if child.tag in URDF_CHILDREN["robot"] - {"link", "joint", "material", "sensor"}:
        is_block = child.tag == "gazebo" and parent.tag in ("link", "joint")
        block = f', and write <gazebo reference="{parent.get("name") or ""}">' if is_block else ""
        return f"move it out of the <{parent.tag}>, into <robot>{block}"
    if child.tag in _IN_GAZEBO:
        name = parent.get("name") if parent.tag in ("link", "joint") else None
        return f'move it to <gazebo reference="{name or "…"}">'
    if child.tag == "pose":
        return "it is an element of SDF; URDF has <origin>"
    places = [place for place in _PLACES if child.tag in URDF_CHILDREN[place]]
    if places and child.tag != "type":
        return f"move it to {' or '.join(f'<{place}>' for place in places)}"
    near = nearest(child.tag, URDF_CHILDREN[parent.tag], cutoff=0.7)
    if near is None and child.attributes and parent.tag == "inertial":
        return "to call a macro, add the prefix `xacro:` and process the file with xacro"
    return Suggestion(near, before="") if near else None


def _renamed(model: Model, parent: Element, child: Element) -> Fix | None:
    tag = _CURRENT_NAMES.get(child.tag) or nearest(child.tag, URDF_CHILDREN[parent.tag], cutoff=0.75)
    if tag is None or (tag != "visual" and tag != "collision" and parent.find(tag) is not None):
        return None
    if not child.attributes.keys() <= set(URDF_ATTRIBUTES.get(tag, ())):
        return None  # Probably a macro call.
    return new_tag(model, child, tag, "unsafe")
