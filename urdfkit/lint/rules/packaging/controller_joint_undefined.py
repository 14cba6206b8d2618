"""K959 controller-joint-undefined."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.model.masked_names import is_typo, unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class ControllerJointUndefined(RobotRule):
    """A controller uses a joint that does not exist in the robot.

    ## What it does
    Checks the YAML files of the robot's package and of neighbouring packages that depend on it. Compares the joints of
    controllers, and the joints with gains of gazebo_ros_control, with the joints of the robot. Nothing is reported if
    the joint may exist in another description in these packages, or with other arguments or conditions. If most joints
    of a file do not exist in the robot, the file is assumed to belong to another robot, and its joints are reported
    only if they are misspelt. A misspelt joint is reported as an error.

    ## Why is this bad?
    The controller does not start, because it cannot claim the joint.

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         arm_controller:
           type: joint_trajectory_controller/JointTrajectoryController
     arm_controller:
       ros__parameters:
    -    joints: [elbo]
    +    joints: [elbow]
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K959"
    name = "controller-joint-undefined"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each controller joint that no description in these packages can define.

        For urdfkit, an undefined joint of a controller that a Gazebo plugin of the robot loads is at least a note; for
        other targets, only if no description can define it.
        """
        from urdfkit.description.control.parameter_defects import JOINT_NAMES
        from urdfkit.lint.facts.control.loaded_controllers import loaded_controllers

        places = set()
        for finding in self._undefined(model):
            places.add((finding.span.file, finding.span.line, finding.joint))
            yield finding
        joints = model.robot.joint_by_name
        for name, settings, _ in loaded_controllers(model) if joints and not model.is_incomplete else ():
            named = [settings.find(each) for each in JOINT_NAMES]
            for entry in [one for each in named if each is not None for one in (each.items or (each,))]:
                place = entry.position
                if not entry.value or entry.value in joints or (place.file, place.line, entry.value) in places:
                    continue
                if model.target == "urdfkit" or not model.neighbouring_descriptions.define("joint", entry.value):
                    message = f"controller `{name}` names the undefined joint `{entry.value}`"
                    yield self.at(model, place, message, joint=entry.value, severity="note")

    def _undefined(self, model: Model) -> Findings:
        from urdfkit.lint.facts.control.controller_joints import joints
        from urdfkit.lint.facts.control.yaml_tree import yamls_of_robot
        from urdfkit.lint.fix_builders import nearest

        joints_by_name = model.robot.joint_by_name
        if not joints_by_name:
            return
        for source in yamls_of_robot(model):
            references = list(joints(source))
            # A chained controller writes the name of the other controller before that of the joint.
            undefined = [each for each in references if each.name.rpartition("/")[2] not in joints_by_name]
            is_of_another_robot = 4 * len(undefined) > 3 * len(references)
            for reference in undefined:
                if model.neighbouring_descriptions.define("joint", reference.name):
                    continue
                suggestion = nearest(reference.name, joints_by_name)
                is_misspelt = suggestion is not None and is_typo(reference.name, suggestion)
                if not is_misspelt and (is_of_another_robot or model.neighbouring_descriptions.unresolved_package):
                    continue
                finding = self.at_span(
                    source.span(reference.start, reference.end),
                    f"controller joint `{reference.name}` does not exist in robot `{model.robot.name}`"
                    + Suggestion(suggestion, reference.name),
                    severity="error" if is_misspelt else self.severity,
                    joint=reference.name,
                )
                yield from unless_masked(model, reference.name, suggestion, finding)
