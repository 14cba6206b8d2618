"""K975 controllers-share-interface."""

from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class ControllersShareInterface(RobotRule):
    """A launch file spawns two controllers that command the same interface of a joint.

    ## What it does
    Compares the command interfaces of the ros2_controllers that a launch file spawns without a condition; in ROS 1,
    compares the joints of the controllers. Controllers that are spawned inactive are not checked.

    ## Why is this bad?
    The controller manager activates only the first controller. The spawner of the other controller fails with "Resource
    conflict for controller".

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         arm_controller:
           type: forward_command_controller/ForwardCommandController
         hand_controller:
           type: forward_command_controller/ForwardCommandController
     arm_controller:
       ros__parameters:
         joints: [elbow]
         interface_name: position
     hand_controller:
       ros__parameters:
    -    joints: [elbow]
    +    joints: [finger]
         interface_name: position
    ```

    ## References
    A launch file next to this example spawns both controllers.
    """

    code = "K975"
    name = "controllers-share-interface"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each interface that an earlier controller claims."""
        from urdfkit.lint.facts.control.spawned_together import shared_interfaces
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.twins import mirrored

        seen = set()
        for source, claim, other in shared_interfaces(model):
            span = span_of(source, claim.where)
            if (source.file, span.line, span.column) not in seen:
                seen.add((source.file, span.line, span.column))
                message = f"`{other}` is spawned earlier and also commands `{claim.interface}` of joint `{claim.joint}`"
                yield self.at_span(span, message, names=mirrored(claim.joint))
