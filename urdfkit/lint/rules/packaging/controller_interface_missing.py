"""K963 controller-interface-missing."""

from collections.abc import Iterable

from urdfkit.description.xml.source import Position
from urdfkit.lint.facts.control.yaml_tree import Node
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_REQUIRED_INTERFACES = {
    "effort_controllers": "EffortJointInterface",
    "velocity_controllers": "VelocityJointInterface",
    "position_controllers": "PositionJointInterface",
    "diff_drive_controller": "VelocityJointInterface",
}
"""Package of a controller → interface that it requires of its joints (ros_controllers, Noetic)."""

_OF_WHEELS = ("diff_drive_controller", "ackermann_steering_controller", "four_wheel_steering_controller")
"""Packages whose controllers have no variant for another interface, so that the transmission is wrong."""


_FEW = 1
"""Number of joints with transmissions above which a robot has the transmissions of its joints in its own files."""


class ControllerInterfaceMissing(RobotRule):
    """A ROS 1 controller requires an interface that the transmission of its joint does not provide.

    ## What it does
    Compares the types of controllers in YAML (``effort_controllers/…``, ``velocity_controllers/…``,
    ``position_controllers/…`` and ``diff_drive_controller/…``) with the ``<hardwareInterface>`` elements in the
    transmissions of their joints. A joint without a transmission is reported as a note if no joint of the controller
    has a transmission.

    ## Why is this bad?
    The controller does not start: "Could not find resource 'elbow' in 'hardware_interface::EffortJointInterface'".

    ## Example
    ```diff
     arm_controller:
    -  type: position_controllers/JointPositionController
    +  type: effort_controllers/JointPositionController
       joint: elbow
    ```

    ## References
    In the robot of this example, the transmission of ``elbow`` has an ``EffortJointInterface``.
    """

    code = "K963"
    name = "controller-interface-missing"
    severity = "warning"
    not_for = NOT_GAZEBO | {"ros2", "gz"}

    def check(self, model: Model) -> Findings:
        """Yield a finding at the type of each controller whose joint lacks the required interface."""
        from urdfkit.lint.facts.control.controller_joints import joints_of, typed
        from urdfkit.lint.facts.control.controller_settings import settings
        from urdfkit.lint.facts.control.hardware_interfaces import has_gazebo_ros_control, is_misspelt
        from urdfkit.lint.facts.root_cause import call_of

        if model.robot.ros2_control:
            return
        provided: dict[str, set[str]] = {}
        for transmission in model.robot.transmissions:
            for joint in transmission.joints:
                if "$" in (joint.name or ""):
                    return
                names = (name.rpartition("/")[2] for name in joint.hardware_interfaces)
                provided.setdefault(joint.name or "", set()).update(names)
        is_run = has_gazebo_ros_control(model.robot)
        for source in model.related_files.values() if provided else ():
            if not source.file.endswith((".yaml", ".yml")):
                continue
            for controller_type in typed(source):
                required = _REQUIRED_INTERFACES.get(controller_type.name.partition("/")[0])
                missing = [
                    joint
                    for joint in joints_of(source, controller_type)
                    if provided.get(joint) and required not in provided[joint]
                ]
                unprovided = [joint for joint in joints_of(source, controller_type) if not provided.get(joint)]
                unprovided = [joint for joint in unprovided if joint in model.robot.joint_by_name]
                if required is not None and unprovided and not missing and is_run:
                    needed = f"`{controller_type.name}` requires the {required} of joint `{unprovided[0]}`"
                    message = f"{needed}, which has no transmission"
                    span = source.span(controller_type.start, controller_type.end)
                    # Another file may contain the transmissions if the controller has none.
                    has_others = len(unprovided) < len(joints_of(source, controller_type)) or len(provided) > _FEW
                    severity = self.severity if has_others else "note"
                    found = self.at_span(span, message, severity=severity, joint=unprovided[0], kind="none")
                    there = model.span(_place(unprovided[0], joints_of(source, controller_type), model))
                    yield Finding(**{**found.__dict__, "other": there, "is_other_wrong": has_others})
                if required is None or not missing or any("$" in name for name in provided[missing[0]]):
                    continue
                if any(is_misspelt(name) for name in provided[missing[0]]):
                    continue
                line = source.span(controller_type.start, controller_type.start).line
                kinds = [(one.name, one.group.find("type"), one.group) for one in settings(source)]
                others = ", ".join(f"`{name}`" for name in sorted(provided[missing[0]]))
                call = None
                parts = [(each.name, each.element) for one in model.robot.transmissions for each in one.joints]
                inner = [part.find("hardwareInterface") for name, part in parts if name in missing]
                written = {each.origin.position for each in inner if each is not None}
                own = next((group for _, kind, group in kinds if kind is not None and kind.line == line), None)
                is_consistent = (
                    len(missing) == 1 and own is not None and _has_gains_of_its_type(controller_type.name, own)
                )
                if controller_type.name.partition("/")[0] in _OF_WHEELS or is_consistent:
                    right = [element for name, element in parts if name not in missing]
                    elements = [element for name, element in parts if name == missing[0]]
                    call = next((place for each in elements if (place := call_of(each, right)) is not None), None)
                    if call is None and is_consistent and len(written) == 1:
                        call = next(iter(written))
                yield self.at_span(
                    source.span(controller_type.start, controller_type.end),
                    f"`{controller_type.name}` requires the {required} of joint `{missing[0]}`, "
                    f"whose transmission provides {others}",
                    joint=missing[0],
                    help="change the controller type or the <hardwareInterface>",
                    names=tuple(name for name, kind, _ in kinds if kind is not None and kind.line == line),
                    other=model.span(call or next(iter(written))) if call or len(written) == 1 else None,
                    is_other_wrong=call is not None,
                    cause="" if call is None else f"joint {missing[0]}",
                )


def _place(name: str, joints: Iterable[str], model: Model) -> Position:
    """Return the place for the transmission of a joint: after that of another joint if those are below all joints."""
    from urdfkit.lint.facts.root_cause import call_of

    joint, listed = model.robot.joint_by_name[name].element, list(joints)
    before = listed[: listed.index(name)][::-1]
    parts = {each.name: each.element for one in model.robot.transmissions for each in one.joints}
    near = next((each for each in (*before, *listed) if each in parts and each in model.robot.joint_by_name), None)
    if near is None:
        return joint.origin.position
    element = parts[near]
    place = call_of(element, [part for each, part in parts.items() if each != near]) or element.origin.position
    own, at = model.robot.joint_by_name[near].element.origin.position, joint.origin.position
    is_below = own.file == at.file == place.file and max(own.line, at.line) < place.line
    return place if is_below and not joint.origin.expansions[:-1] else at


def _has_gains_of_its_type(kind: str, group: Node) -> bool:
    """Return whether a trajectory controller has ``gains`` exactly if its type needs them: the type is right."""
    space, _, name = kind.partition("/")
    needs_gains = space in ("effort_controllers", "velocity_controllers")
    return name == "JointTrajectoryController" and (group.find("gains") is not None) is needs_gains
