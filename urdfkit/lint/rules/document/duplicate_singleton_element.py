"""E013 duplicate-singleton-element."""

from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Finding, Severity
from urdfkit.lint.fix_builders import without_element
from urdfkit.lint.model.xacro_prefix import URDF_CHILDREN
from urdfkit.lint.rule import Findings, Model, RobotRule


class DuplicateSingletonElement(RobotRule):
    """An element that may occur only once occurs twice.

    ## What it does
    Checks for a second ``<inertial>``, ``<mass>``, ``<inertia>``, ``<origin>``, ``<geometry>``, ``<axis>``, ``<limit>``
    … in the same element. A second material is reported as a note, because it changes only a colour. Also checks for a
    plugin parameter that occurs twice with different values although the plugin reads only one. This is reported as a
    warning, because no reader rejects the robot.

    ## Why is this bad?
    Readers differ: urdfdom and Gazebo use the first element, others the last, and MuJoCo rejects the file ("repeated
    element").

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
         <inertial>
           <mass value="1"/>
           <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    -      <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/>
         </inertial>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix removes all but the first element. Most readers use the first one, but it may not be the intended
    one.
    """

    code = "E013"
    name = "duplicate-singleton-element"
    fix = "unsafe"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each duplicate element."""
        for part in model.parts:
            yield from self._check_children(model, part.element)
        if model.robot.gazebo:
            yield from self._check_plugins(model)

    def _check_children(self, model: Model, element: Element) -> Findings:
        allowed, children = URDF_CHILDREN[element.tag], element.children
        if len(children) > 1:
            first_by_kind: dict[str, Element] = {}
            for child in children:
                kind = "shape" if element.tag == "geometry" and child.tag in allowed else child.tag
                if child.tag not in allowed or (element.tag == "link" and child.tag != "inertial"):
                    continue
                if kind in first_by_kind:
                    severity: Severity | None = "note" if kind == "material" else None
                    yield self._duplicate(model, element.tag, child, first_by_kind[kind], severity)
                else:
                    first_by_kind[kind] = child
        for child in children:
            if child.tag in URDF_CHILDREN and child.tag in allowed and child.tag != "material":
                yield from self._check_children(model, child)

    def _check_plugins(self, model: Model) -> Findings:
        from urdfkit.lint.facts.gazebo.plugins import plugins, specs

        for plugin, _, _ in plugins(model.robot):
            candidates = specs(plugin)
            first_by_tag: dict[str, Element] = {}
            for child in plugin.element.children:
                parameters = [parameter for spec in candidates if (parameter := spec.parameter(child.tag)) is not None]
                if not parameters or any(parameter.repeats for parameter in parameters) or child.children:
                    continue
                first = first_by_tag.setdefault(child.tag, child)
                if first.text != child.text:
                    yield self._duplicate(model, "plugin", child, first, "warning")

    def _duplicate(
        self, model: Model, parent: str, child: Element, first: Element, severity: Severity | None
    ) -> Finding:
        where = model.shown(first.origin.position)
        message = f"extra <{child.tag}> in <{parent}>: some readers use the first, others the last"
        help = (
            f"remove one of them; the first is at {where}"
            if first.tag == child.tag
            else f"remove it or the <{first.tag}> at {where}"
        )
        fix = without_element(model, child, "unsafe", f"Remove the extra <{child.tag}>")
        return self.at(model, child, message, help=help, fix=fix, severity=severity)
