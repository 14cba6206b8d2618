"""L115 launch-argument-duplicate."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchArgumentDuplicate(RobotRule):
    """A launch file declares an argument twice.

    ## What it does
    Checks the arguments that a launch file declares at the same level without a condition. In ROS 2, only arguments
    with different defaults are reported.

    ## Why is this bad?
    roslaunch stops: "arg 'model' has already been declared". In ROS 2, the first default applies, and the second one
    has no effect.

    ## Example
    ```diff
     <launch>
       <arg name="model" default="cart"/>
    -  <arg name="model" default="rover"/>
     </launch>
    ```
    """

    code = "L115"
    name = "launch-argument-duplicate"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each declaration after the first one."""
        from urdfkit.lint.facts.launch.repetitions import repeated_arguments

        for one in repeated_arguments(model):
            effect = "roslaunch stops" if one.is_ros1 else "its default has no effect"
            message = f"launch argument `{one.name}` is already declared on line {one.first}; {effect}"
            yield self.at_span(one.span, message, severity="error" if one.is_ros1 else self.severity)
