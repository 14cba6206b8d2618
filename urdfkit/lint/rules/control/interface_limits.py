"""C719 interface-limits-beyond-joint."""

from __future__ import annotations

from urdfkit.description.numbers import number
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.description.robot import Joint
    from urdfkit.lint.finding import Finding, Severity
    from urdfkit.lint.model import Model

_DEGREES = 20.0
"""How many times a limit of a turning joint is exceeded where degrees must have been meant."""


class InterfaceLimits(RobotRule):
    """The ``min`` and ``max`` of a command interface are beyond the limits of its joint.

    ## What it does
    Compares ``<param name="min">`` and ``<param name="max">`` of the command interfaces ``position``, ``velocity`` and
    ``effort`` with the ``<limit>`` of the joint, and with each other. Limits of the joint that are narrower hold all
    the same: that is a note. A warning are a ``min`` above its ``max``, and numbers that must be degrees.

    ## Why is this bad?
    One of the two is not what is meant. With ``min`` above ``max`` no command is allowed; what hardware makes of limits
    that are too wide is up to it.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>
      </joint>
      <ros2_control name="arm" type="system">
        <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
        <joint name="elbow">
          <command_interface name="position">
            <param name="min">-90</param>
            <param name="max">90</param>
          </command_interface>
        </joint>
      </ros2_control>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>
      </joint>
      <ros2_control name="arm" type="system">
        <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
        <joint name="elbow">
          <command_interface name="position">
            <param name="min">-1.5</param>
            <param name="max">1.5</param>
          </command_interface>
        </joint>
      </ros2_control>
    </robot>
    ```
    """

    code = "C719"
    name = "interface-limits-beyond-joint"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each command interface, at the first of its limits that is beyond."""
        for block in model.robot.ros2_control:
            for part in block.element.find_all("joint"):
                joint = model.robot.joint_by_name.get(part.get("name") or "")
                for interface in part.find_all("command_interface") if joint is not None else ():
                    yield from self._of_interface(model, interface, joint)

    def _of_interface(self, model: Model, interface: Element, joint: Joint | None) -> Iterator[Finding]:
        params = {param.get("name"): param for param in interface.find_all("param")}
        written = {name: number(params[name].text) for name in ("min", "max") if name in params}
        low, high = written.get("min"), written.get("max")
        name = interface.get("name") or ""
        if joint is None:
            return
        if low is not None and high is not None and low > high:
            message = f"the {name} command of `{joint.name}` has the min {low:g} above the max {high:g}"
            yield self.at(model, params["min"], message, joint=joint.name)
            return
        allowed = _limits(joint, name)
        if allowed is None:
            return
        for which, value, limit in (("min", low, allowed[0]), ("max", high, allowed[1])):
            if value is None or not (value < limit if which == "min" else value > limit):
                continue
            if abs(value - limit) <= 1e-3 * max(abs(limit), 1e-3):
                continue
            severity: Severity = "info"
            help = None
            if joint.type != "prismatic" and name == "position" and abs(value) > _DEGREES * max(abs(limit), 0.1):
                severity, help = "warning", "angles are in rad"
            message = f"the {which} {value:g} of the {name} command of `{joint.name}` is beyond its limit {limit:g}"
            yield self.at(model, params[which], message, joint=joint.name, severity=severity, help=help)
            return


def _limits(joint: Joint, interface: str) -> tuple[float, float] | None:
    limit = joint.limit
    if limit is None:
        return None
    if interface == "position" and joint.type in ("revolute", "prismatic"):
        low, high = limit.lower or 0.0, limit.upper or 0.0
        return (low, high) if low < high else None
    one = {"velocity": limit.velocity, "effort": limit.effort}.get(interface)
    return (-one, one) if one is not None and one > 0.0 else None
