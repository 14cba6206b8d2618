"""K976 controller-joint-foreign."""

from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class ControllerJointForeign(RobotRule):
    """A controller has gains or tolerances for a joint that it does not control.

    ## What it does
    Compares the groups in ``constraints`` and ``gains`` of trajectory controllers with their ``joints``. Names that
    resemble a joint of the controller are reported as misspelt by K962.

    ## Why is this bad?
    The values have no effect, and the intended joint has the default gains or tolerances.

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         arm_controller:
           type: joint_trajectory_controller/JointTrajectoryController
     arm_controller:
       ros__parameters:
         joints: [elbow]
         command_interfaces: [position]
         state_interfaces: [position]
         constraints:
    -      finger: {goal: 0.01}
    +      elbow: {goal: 0.01}
    ```
    """

    code = "K976"
    name = "controller-joint-foreign"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each group of another joint."""
        from urdfkit.lint.facts.control.controller_settings import misspelt_names, settings
        from urdfkit.lint.facts.control.yaml_tree import span_of, yamls
        from urdfkit.lint.fix_builders import meant

        for source in yamls(model):
            if "constraints" not in source.text and "gains" not in source.text:
                continue
            misspelt = {(node.line, node.column) for node, _, _ in misspelt_names(source)}
            for one in settings(source):
                listed = one.group.find("joints")
                names = listed.texts() if listed is not None and one.kind.endswith("TrajectoryController") else []
                # A joint that no robot has is reported where it is listed.
                is_complete = set(names) <= model.robot.joint_by_name.keys()
                for key, value in one.group.entries if names and is_complete else ():
                    for inner, each in value.entries if key.text in ("constraints", "gains") else ():
                        is_joint = each.kind == "group" and inner.text not in names
                        if is_joint and "$" not in inner.text and (inner.line, inner.column) not in misspelt:
                            message = f"`{key.text}` has `{inner.text}`, which controller `{one.name}` does not control"
                            hint = meant(inner.text, names)[1]
                            yield self.at_span(span_of(source, inner), message + hint, names=(inner.text,))
