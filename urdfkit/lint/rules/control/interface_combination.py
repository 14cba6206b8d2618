"""C710 interface-combination-invalid."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number
from urdfkit.lint.facts.control.hardware_interfaces import meant_interface
from urdfkit.lint.facts.gazebo.plugins import runs_ros2_control
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_SIMULATED = ("position", "velocity", "effort")
"""Command interfaces of the simulators' hardware."""


class InterfaceCombination(RobotRule):
    """A joint of ``<ros2_control>`` declares an interface twice or misspells its name.

    ## What it does
    Checks the ``<command_interface>`` and ``<state_interface>`` elements of each joint for duplicate names, and for
    names that nearly match ``position``, ``velocity``, ``acceleration`` or ``effort``. Other names are reported as a
    note if the hardware runs in a simulator. Otherwise they are accepted, because hardware may define its own
    interfaces.

    ## Why is this bad?
    The controller manager stops, or the controller finds no interface to claim.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>
       <ros2_control name="arm" type="system">
         <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
         <joint name="elbow">
    -      <command_interface name="postion"/>
    +      <command_interface name="position"/>
         </joint>
       </ros2_control>
     </robot>
    ```
    """

    code = "C710"
    name = "interface-combination-invalid"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each duplicate or misspelt interface."""
        for block in model.robot.ros2_control:
            for joint in block.element.find_all("joint"):
                for kind in ("command_interface", "state_interface"):
                    seen: set[str] = set()
                    for element in joint.find_all(kind):
                        name = element.get("name") or ""
                        suggestion = meant_interface(name)
                        if name and name in seen:
                            owner = f" of joint `{joint.get('name')}`" if joint.get("name") else ""
                            message = f"duplicate {kind.replace('_', ' ')} `{name}`{owner}"
                            yield self.at(model, element, message, attribute="name", joint=joint.get("name"))
                        elif suggestion is not None:
                            message = f"unknown interface `{name}`" + Suggestion(suggestion, name)
                            yield self.at(model, element, message, attribute="name", joint=joint.get("name"))
                        elif kind == "command_interface" and name not in _SIMULATED and runs_ros2_control(model.robot):
                            message = f"the simulator has no command interface `{name}`"
                            yield self.at(
                                model, element, message, attribute="name", joint=joint.get("name"), severity="note"
                            )
                        seen.add(name)
                        yield from self._initial_value(model, element) if runs_ros2_control(model.robot) else ()

    def _initial_value(self, model: Model, interface: Element) -> Findings:
        for parameter in interface.find_all("param"):
            if (
                parameter.get("name") == "initial_value"
                and "$" not in parameter.text
                and number(parameter.text) is None
            ):
                yield self.at(model, parameter, f"initial_value `{parameter.text}` is not a number", severity="warning")
