"""K978 joint-without-controller."""

import re

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, declared, offered, wanted
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_FEWEST = 2
"""Smallest number of other joints that a trajectory controller moves."""


class JointWithoutController(RobotRule):
    """One joint of an arm is missing from the list of its trajectory controller.

    ## What it does
    Compares the command interfaces of ``<ros2_control>`` with the ROS 2 controllers in YAML. Reports a joint with a
    command interface if no other file names this joint, and if the robot has no second joint of this kind. A joint is
    reported only if a ``JointTrajectoryController`` or a group controller moves at least two other joints of the same
    branch of the robot.

    ## Why is this bad?
    The joint keeps its position, and MoveIt plans that move it fail.

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         arm_controller:
           type: joint_trajectory_controller/JointTrajectoryController

     arm_controller:
       ros__parameters:
    -    joints: [shoulder, wrist]
    +    joints: [shoulder, elbow, wrist]
         command_interfaces: [position]
         state_interfaces: [position]
    ```
    """

    code = "K978"
    name = "joint-without-controller"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for a joint that no controller moves."""
        from urdfkit.lint.facts.control.yaml_tree import span_of, yamls

        sources = [source for source in yamls(model) if PARAMETERS in source.text] if model.robot.ros2_control else []
        hardware = offered(model) if sources else None
        if not hardware:
            return
        joints = model.robot.joint_by_name
        for source in sources:
            for controller in declared(source):
                named = controller.settings.find("joints") if controller.settings is not None else None
                moved = {each.joint for each in wanted(controller) if each.is_command}
                if named is None or len(moved) < _FEWEST or not moved <= joints.keys():
                    continue
                others = [
                    each.text
                    for each in model.related_files.values()
                    if each is source or PARAMETERS not in each.text or not _declares(each, controller.name)
                ]
                left = [name for name, has in hardware.items() if has[True] and not _is_named(name, others)]
                if len(left) != 1 or left[0] not in joints or joints[left[0]].mimic is not None:
                    continue
                if all(_are_in_line(name, left[0], model) for name in moved):
                    message = f"`joints` of controller `{controller.name}` lacks joint `{left[0]}`, "
                    message += "which has a command interface"
                    yield self.at_span(span_of(source, named), message, joint=left[0], help="add the joint")


def _declares(source: Source, name: str) -> bool:
    return any(one.name == name for one in declared(source))


def _is_named(name: str, texts: list[str]) -> bool:
    return any(re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", text) for text in texts)


def _are_in_line(first: str, second: str, model: Model) -> bool:
    """Return whether one of two joints moves the other one."""
    return first in _above(second, model) or second in _above(first, model)


def _above(name: str, model: Model) -> set[str]:
    """Return the joints between a joint and the root link."""
    parents = {joint.child: joint for joint in model.robot.joints}
    found: set[str] = set()
    joint = parents.get(model.robot.joint_by_name[name].parent)
    while joint is not None and joint.name not in found:
        found.add(joint.name)
        joint = parents.get(joint.parent)
    return found
