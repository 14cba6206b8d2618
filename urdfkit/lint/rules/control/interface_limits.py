"""C719 interface-limits-beyond-joint."""

from urdfkit.description.urdf.robot import Joint
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_DEGREES_RATIO = 20.0
"""Ratio of a value to the limit of a revolute joint above which the value must be in degrees."""

_LESS = 0.1
"""Smallest part of a limit by which the limit of a command interface stands out."""

_FEWEST = 4
"""Smallest number of limits of command interfaces that are those of their joints."""

_UNITS = {"position": ("m", "rad"), "velocity": ("m/s", "rad/s"), "effort": ("N", "N·m")}
"""Command interface → unit for a prismatic joint, and for any other."""


class InterfaceLimits(RobotRule):
    """The ``min`` or ``max`` of a command interface exceeds the limits of its joint.

    ## What it does
    Compares ``<param name="min">`` and ``<param name="max">`` of the command interfaces ``position``, ``velocity`` and
    ``effort`` with the ``<limit>`` of the joint, and with each other. A ``min`` that is not below its ``max``, and
    values that appear to be in degrees, are reported as warnings. Any other value beyond the limit of the joint is
    reported as a note, because the narrower limit still applies. An ``initial_value`` of the position outside the joint
    limits is reported as a warning. If exactly one position interface has a narrower limit than its joint, and all
    other interfaces have the limits of their joints, the narrower limit is reported as a note.

    ## Why is this bad?
    One of the two values is wrong. With ``min`` above ``max``, no command is accepted. The effect of limits that are
    wider than the joint limits depends on the hardware.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
         <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>
       </joint>
       <ros2_control name="arm" type="system">
         <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
         <joint name="elbow">
           <command_interface name="position">
    -        <param name="min">-90</param>
    -        <param name="max">90</param>
    +        <param name="min">-1.5</param>
    +        <param name="max">1.5</param>
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

    def check(self, model: Model) -> Findings:
        """Yield a finding for each command interface, at its first invalid limit."""
        yield from self._unlike_others(model)
        for block in model.robot.ros2_control:
            for part in block.element.find_all("joint"):
                joint = model.robot.joint_by_name.get(part.get("name") or "")
                if joint is None:
                    continue
                for interface in part.find_all("command_interface"):
                    yield from self._check_interface(model, interface, joint)
                for interface in part.find_all("state_interface"):
                    yield from self._check_start(model, interface, joint)

    def _unlike_others(self, model: Model) -> Findings:
        """Yield a finding for the only limit of positions that is less than that of its joint."""
        equal, less = 0, list[tuple[Element, Joint, str, float, float]]()
        for part in (part for block in model.robot.ros2_control for part in block.element.find_all("joint")):
            joint = model.robot.joint_by_name.get(part.get("name") or "")
            allowed = _limits(joint, "position") if joint is not None else None
            for interface in part.find_all("command_interface") if allowed is not None else ():
                for param in interface.find_all("param") if interface.get("name") == "position" else ():
                    value, which = number(param.text), param.get("name") or ""
                    if joint is None or allowed is None or value is None or which not in ("min", "max"):
                        continue
                    limit = allowed[which == "max"]
                    equal += abs(value - limit) <= 1e-3 * max(abs(limit), 1e-3)
                    if abs(value) < (1.0 - _LESS) * abs(limit) and value * limit > 0.0:
                        less.append((param, joint, which, value, limit))
        if len(less) == 1 and equal >= _FEWEST:
            param, joint, which, value, limit = less[0]
            unit = _UNITS["position"][joint.type != "prismatic"]
            message = f"position command of joint `{joint.name}`: {which} is {value:g} {unit}, but the joint limit is "
            message += f"{limit:g} {unit}; all other limits equal those of their joints"
            yield self.at(model, param, message, joint=joint.name, severity="note")

    def _check_start(self, model: Model, interface: Element, joint: Joint) -> Findings:
        allowed = _limits(joint, "position") if interface.get("name") == "position" else None
        if allowed is None:
            return
        for param in interface.find_all("param"):
            value = number(param.text) if param.get("name") == "initial_value" else None
            slack = 1e-3 * max(map(abs, (*allowed, 1.0)))
            if value is not None and not allowed[0] - slack <= value <= allowed[1] + slack:
                unit = _UNITS["position"][joint.type != "prismatic"]
                limits = f"{allowed[0]:g} … {allowed[1]:g} {unit}"
                message = f"initial position {value:g} {unit} of joint `{joint.name}` is beyond its limits {limits}"
                yield self.at(model, param, message, joint=joint.name, severity="warning")

    def _check_interface(self, model: Model, interface: Element, joint: Joint) -> Findings:
        params = {param.get("name"): param for param in interface.find_all("param")}
        values = {name: number(params[name].text) for name in ("min", "max") if name in params}
        low, high = values.get("min"), values.get("max")
        name = interface.get("name") or ""
        if low is not None and high is not None and (low > high or low == high != 0.0):
            relation = "greater than" if low > high else "equal to"
            message = f"{name} command of joint `{joint.name}`: min {low:g} is {relation} max {high:g}"
            wrong = "max" if high < 0.0 or low == 0.0 else "min"
            yield self.at(model, params[wrong], message, joint=joint.name)
            return
        allowed = _limits(joint, name)
        if allowed is None:
            return
        for which, value, limit in (("min", low, allowed[0]), ("max", high, allowed[1])):
            if value is None or not (value < limit if which == "min" else value > limit):
                continue
            if abs(value - limit) <= 1e-3 * max(abs(limit), 1e-3):
                continue
            unit = _UNITS[name][joint.type != "prismatic"]
            severity: Severity = "note"
            help = None
            if joint.type != "prismatic" and name == "position" and abs(value) > _DEGREES_RATIO * max(abs(limit), 0.1):
                severity, help = "warning", "write angles in radians"
            kind = f"{name} command"
            message = f"{kind} of joint `{joint.name}`: {which} {value:g} is beyond the joint limit {limit:g} {unit}"
            yield self.at(model, params[which], message, joint=joint.name, severity=severity, help=help, kind=kind)
            return


def _limits(joint: Joint, interface: str) -> tuple[float, float] | None:
    limit = joint.limit
    if limit is None:
        return None
    if interface == "position" and joint.type in ("revolute", "prismatic"):
        low, high = limit.lower or 0.0, limit.upper or 0.0
        return (low, high) if low < high else None
    bound = {"velocity": limit.velocity, "effort": limit.effort}.get(interface)
    return (-bound, bound) if bound is not None and bound > 0.0 else None
