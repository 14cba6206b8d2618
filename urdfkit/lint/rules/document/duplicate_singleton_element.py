"""E013 duplicate-singleton-element."""

from __future__ import annotations

from urdfkit.lint.edits import without_element
from urdfkit.lint.prefix import URDF_CHILDREN
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding, Severity
    from urdfkit.lint.model import Model


class DuplicateSingletonElement(RobotRule):
    """An element that may stand there once stands there twice.

    ## What it does
    Looks for a second ``<inertial>``, ``<mass>``, ``<inertia>``, ``<origin>``, ``<geometry>``, ``<axis>``,
    ``<limit>`` … in one element, and for a plugin's parameter that is given twice with different values although
    the plugin reads one. A second material, or parameter, is a warning: no reader refuses it.

    ## Why is this bad?
    Readers differ: urdfdom and Gazebo take the first, others the last, MuJoCo refuses the file ("repeated
    element").

    ## Example
    ```xml
    <robot name="cart">
      <link name="base">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
          <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/>
        </inertial>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
        </inertial>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: all but the first are taken away, which is the one that most readers use, but perhaps not the one you
    mean.
    """

    code = "E013"
    name = "duplicate-singleton-element"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each element that is one too many."""
        for part in model.parts:
            yield from self._look(model, part.element)
        if model.robot.gazebo:
            yield from self._plugins(model)

    def _look(self, model: Model, element: Element) -> Iterator[Finding]:
        allowed, children = URDF_CHILDREN[element.tag], element.children
        if len(children) > 1:
            first: dict[str, Element] = {}
            for child in children:
                kind = "shape" if element.tag == "geometry" and child.tag in allowed else child.tag
                if child.tag not in allowed or (element.tag == "link" and child.tag != "inertial"):
                    continue
                if kind in first:
                    severity: Severity | None = "warning" if kind == "material" else None
                    yield self._second(model, element.tag, child, first[kind], severity)
                else:
                    first[kind] = child
        for child in children:
            if child.tag in URDF_CHILDREN and child.tag in allowed and child.tag != "material":
                yield from self._look(model, child)

    def _plugins(self, model: Model) -> Iterator[Finding]:
        from urdfkit.lint.gazebo import plugins, specs

        for plugin, _, _ in plugins(model.robot):
            known = specs(plugin)
            first: dict[str, Element] = {}
            for child in plugin.element.children:
                parameters = [parameter for spec in known if (parameter := spec.parameter(child.tag)) is not None]
                if not parameters or any(parameter.repeats for parameter in parameters) or child.children:
                    continue
                before = first.setdefault(child.tag, child)
                if before.text != child.text:
                    yield self._second(model, "plugin", child, before, "warning")

    def _second(self, model: Model, parent: str, child: Element, first: Element, severity: Severity | None) -> Finding:
        where = model.shown(first.origin.position)
        return self.at(
            model,
            child,
            f"a second <{child.tag}> in one <{parent}>: readers differ in which they take",
            help=f"the first is at {where}" if first.tag == child.tag else f"<{first.tag}> is at {where}",
            fix=without_element(model, child, "unsafe", f"Take the second <{child.tag}> away"),
            severity=severity,
        )
