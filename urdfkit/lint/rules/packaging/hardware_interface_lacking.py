"""K965 hardware-interface-lacking."""

from __future__ import annotations

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.ros2_controllers import (
    PARAMETERS,
    DeclaredController,
    Wanted,
    declared,
    offered,
    wanted,
)
from urdfkit.lint.facts.control.yaml_tree import Node, span_of, yamls
from urdfkit.lint.finding import Finding
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_BROADCASTERS = (
    "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
    "imu_sensor_broadcaster/IMUSensorBroadcaster",
    "range_sensor_broadcaster/RangeSensorBroadcaster",
)
"""Types of ros2_controllers that read the sensor named by ``sensor_name`` (Humble to Rolling)."""


class HardwareInterfaceLacking(RobotRule):
    """A ROS 2 controller uses an interface that the hardware of its joint does not provide.

    ## What it does
    Compares the interfaces that the controllers of ros2_controllers require with the ``<command_interface>`` and
    ``<state_interface>`` elements of their joints in ``<ros2_control>``. The type and the parameters of a controller in
    YAML determine the required interfaces. Also checks the ``sensor_name`` of broadcasters for misspelt sensor names.

    Joints of a controller with the same defect share one finding.

    Nothing is reported if arguments or another description of the package may select other hardware. Misspelt joints
    and interfaces in ``<ros2_control>`` are reported by other rules.

    ## Why is this bad?
    The controller manager does not start the controller: "Not acceptable command interfaces".

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         arm_controller:
           type: joint_trajectory_controller/JointTrajectoryController
     arm_controller:
       ros__parameters:
         joints: [elbow]
    -    command_interfaces: [velocity]
    +    command_interfaces: [position]
         state_interfaces: [position]
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.

    ## References
    In the robot of this example, the hardware has the command interface ``position`` for ``elbow``.
    """

    code = "K965"
    name = "hardware-interface-lacking"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO | {"ros1"}

    def check(self, model: Model) -> Findings:
        """Yield a finding for each interface that a controller requires and its joint lacks."""
        if not model.robot.ros2_control:
            return
        from urdfkit.lint.facts.control.hardware_interfaces import meant_joints

        sources = [source for source in yamls(model) if PARAMETERS in source.text]
        hardware = offered(model) if sources else None
        misspelt = meant_joints(model.robot) if hardware is not None else set()
        found: list[tuple[str, Finding]] = []
        for source in sources if hardware is not None else ():
            for controller in declared(source):
                missing = self._missing_interfaces(source, controller, hardware or {}, misspelt, model)
                found += [(controller.name, finding) for finding in missing]
                yield from self._unknown_sensor(source, controller, hardware or {})
        every = [need for source in sources for one in declared(source) for need in wanted(one)] if found else []
        yield from self._merged(found, {(need.joint, need.interface, need.is_command) for need in every}, model)

    def _merged(self, found: list[tuple[str, Finding]], wanted: set[tuple[str, str, bool]], model: Model) -> Findings:
        """Yield the findings; those of several controllers at the only interface that no controller uses."""
        parts = {
            part.get("name"): part for block in model.robot.ros2_control for part in block.element.find_all("joint")
        }
        unused: dict[object, list[tuple[str, Finding, Element]]] = {}
        for controller, finding in found:
            part = parts.get(finding.joint) if finding.kind.endswith("_interface") else None
            names = [(finding.joint or "", finding.kind == "command_interface")]
            others = [
                each
                for each in (part.find_all(finding.kind) if part is not None else ())
                if (names[0][0], each.get("name") or "", names[0][1]) not in wanted
            ]
            if len(others) == 1:
                unused.setdefault(others[0].origin.position, []).append((controller, finding, others[0]))
        merged: set[int] = set()
        for uses in unused.values():
            joint = model.robot.joint_by_name.get(uses[0][1].joint or "")
            # A joint that turns without limits is seldom commanded by its position.
            is_turning = joint is not None and joint.type == "continuous" and uses[0][2].get("name") == "position"
            if len({controller for controller, _, _ in uses}) > 1 or (
                is_turning and uses[0][1].kind.startswith("command")
            ):
                merged |= {id(finding) for _, finding, _ in uses}
                _, finding, element = uses[0]
                joints = tuple(each.joint for _, each, _ in uses if each.joint)
                help = "the controllers use another interface"
                yield self.at(
                    model, element, finding.message, attribute="name", joint=finding.joint, help=help, names=joints
                )
        yield from (finding for _, finding in found if id(finding) not in merged)

    def _unknown_sensor(
        self, source: Source, controller: DeclaredController, hardware: dict[str, dict[bool, list[str]]]
    ) -> Findings:
        sensor = controller.settings.find("sensor_name") if controller.settings is not None else None
        if sensor is None or not sensor.text or controller.kind.text not in _BROADCASTERS or sensor.text in hardware:
            return
        suggestion = nearest(sensor.text, hardware, cutoff=0.7)
        if suggestion is not None:
            message = f"unknown sensor `{sensor.text}` of controller `{controller.name}`" + Suggestion(
                suggestion, sensor.text
            )
            yield self.at_span(span_of(source, sensor), message)

    def _missing_interfaces(
        self,
        source: Source,
        controller: DeclaredController,
        hardware: dict[str, dict[bool, list[str]]],
        misspelt: set[str],
        model: Model,
    ) -> Findings:
        from urdfkit.lint.facts.control.controller_settings import INTERFACES
        from urdfkit.lint.facts.control.hardware_interfaces import meant_interface

        lacking: dict[tuple[object, ...], list[Wanted]] = {}
        reported: dict[tuple[int, int], tuple[object, ...]] = {}
        for requirement in wanted(controller):
            interfaces = hardware.get(requirement.joint)
            if interfaces is not None and requirement.interface in interfaces[requirement.is_command]:
                continue
            if interfaces is None:
                if requirement.joint not in model.robot.joint_by_name or not requirement.is_command:
                    continue
                if requirement.joint in misspelt:
                    continue
            elif requirement.interface in (meant_interface(name) for name in interfaces[requirement.is_command]):
                continue
            what: tuple[object, ...] = ()
            if interfaces is not None:
                what = (requirement.is_command, requirement.interface, *interfaces[requirement.is_command])
            if reported.setdefault((requirement.where.line, requirement.where.column), what) == what:
                lacking.setdefault(what, []).append(requirement)
        for requirements in lacking.values():
            first = requirements[0]
            joints = tuple(dict.fromkeys(each.joint for each in requirements))
            named = "joint" + "s" * (len(joints) > 1) + f" {', '.join(f'`{each}`' for each in joints[:4])}"
            named += " …" * (len(joints) > 4)
            interfaces = hardware.get(first.joint)
            side = "command_interface" if first.is_command else "state_interface"
            if interfaces is None:
                message = f"<ros2_control> lacks {named}, which controller `{controller.name}` commands"
                help = f"add the {named.partition(' ')[0]} with the interfaces to <ros2_control>"
            else:
                provided = ", ".join(f"`{name}`" for name in interfaces[first.is_command]) or "none"
                near = None
                if first.interface not in INTERFACES:
                    near = nearest(first.interface, interfaces[first.is_command], cutoff=0.8)
                message = (
                    f"controller `{controller.name}` {'commands' if first.is_command else 'reads'} the "
                    f"{first.interface} interface of {named}, whose hardware provides {provided}"
                    + Suggestion(near, first.interface)
                )
                help = f'add <{side} name="{first.interface}"/> to the hardware, or change the controller'
                help = help if near is None else f"write `{near}`"
            span, kind = span_of(source, first.where), "joint" if interfaces is None else side
            item = _follower(joints, first, controller, model) if interfaces is not None else None
            if item is not None and interfaces is not None and not interfaces[first.is_command]:
                span, help = span_of(source, item), f"remove `{joints[0]}`, which follows another joint"
            other = _entry_before(first.joint, controller, hardware, model) if interfaces is None else None
            found = self.at_span(
                span, message, joint=first.joint, help=help, kind=kind, names=(*joints[1:], controller.name)
            )
            yield Finding(**{**found.__dict__, "other": other, "is_other_wrong": other is not None})


def _follower(joints: tuple[str, ...], need: Wanted, controller: DeclaredController, model: Model) -> Node | None:
    """Return the item of a list of joints for the only joint without commands, if that mimics another joint."""
    listed = controller.settings.find("joints") if controller.settings is not None else None
    joint = model.robot.joint_by_name.get(joints[0])
    if listed is None or len(joints) > 1 or not need.is_command or joint is None or joint.mimic is None:
        return None
    return next((item for item in listed.items if item.text == joint.name), None) if len(listed.items) > 1 else None


def _entry_before(
    joint: str, controller: DeclaredController, hardware: dict[str, dict[bool, list[str]]], model: Model
) -> Span | None:
    """Return the entry in <ros2_control>, or its macro call, after which most likely the entry of a joint is missing.

    None unless most joints of the controller have entries.
    """
    names = list(dict.fromkeys(each.joint for each in wanted(controller) if each.is_command))
    written = [name for name in names if name in hardware]
    if joint not in names or 2 * len(written) <= len(names):
        return None
    before = [name for name in names[: names.index(joint)] if name in hardware] or written
    for block in model.robot.ros2_control:
        for part in block.element.find_all("joint"):
            if part.get("name") == before[-1]:
                calls = part.origin.expansions
                return model.span(calls[0].position if calls else part.origin.position)
    return None
