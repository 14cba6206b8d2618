"""M112 moveit-controller-contradiction."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.rule import Findings, Model, RobotRule


class MoveitControllerContradiction(RobotRule):
    """A MoveIt controller and the ROS controller that it commands differ in name, type or joints.

    ## What it does
    Compares the ``type`` and the ``joints`` of MoveIt's controllers with the controllers of the same name in the YAML
    files of these packages. Reports a name without a ROS controller if exactly one other controller has the same
    joints. Also reports a controller that no launch file spawns, although launch files spawn other controllers.

    ## Why is this bad?
    MoveIt waits for an action that the controller does not offer, or the controller rejects the trajectory: "Joints on
    incoming trajectory don't match the controller joints".

    ## Example
    ```diff
     moveit_controller_manager: moveit_simple_controller_manager/MoveItSimpleControllerManager
     moveit_simple_controller_manager:
       controller_names: [arm_controller]
       arm_controller:
    -    type: GripperCommand
    -    action_ns: gripper_cmd
    +    type: FollowJointTrajectory
    +    action_ns: follow_joint_trajectory
         joints: [elbow]
    ```

    ## References
    In the package of this example, config/controllers.yaml gives ``arm_controller`` the type
    joint_trajectory_controller/JointTrajectoryController.
    """

    code = "M112"
    name = "moveit-controller-contradiction"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each type and joint that differs."""
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.moveit.controllers import (
            contradictions,
            meant_controller,
            partial_lists,
            started_controllers,
            unspawned,
        )
        from urdfkit.lint.facts.moveit.settings import entries, moveit_yamls

        started = started_controllers(model)
        names: set[str] = set()
        for source, _ in moveit_yamls(model):
            for entry in entries(source):
                name = entry.name.last_name
                names.update([name] if entry.kind == "controller" else ())
                if entry.kind == "controller" and name not in started:
                    taken = {each.name.last_name for each in entries(source)}
                    meant = meant_controller(entry, started, taken)
                    if meant is not None:
                        message = f"no controller is called `{name}`" + Suggestion(meant, name)
                        yield self.at_span(span_of(source, entry.name), message)
                elif entry.kind == "controller":
                    for node, message in contradictions(entry, started.get(name, []), model):
                        yield self.at_span(span_of(source, node), message, names=(node.text, name))
                    for node, message, joints in partial_lists(entry, started.get(name, [])):
                        yield self.at_span(span_of(source, node), message, kind="partial", names=tuple(joints))
        for span, message, name in unspawned(names, started, model):
            yield self.at_span(span, message, kind="unspawned", names=(name,))
