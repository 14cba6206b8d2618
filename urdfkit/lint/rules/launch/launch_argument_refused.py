"""L125 launch-argument-refused."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchArgumentRefused(RobotRule):
    """A launch argument has a value that is not one of its choices, or is neither true nor false.

    ## What it does
    Compares the ``choices`` of an argument with its default, with the value that an including launch file passes, and
    with the value in ``LaunchConfigurationEquals`` and ``EqualsSubstitution``. If the argument is used as a condition,
    also reports defaults and passed values that are neither true nor false. If an XML launch file compares an argument
    with several values, and its default is one of them, other passed values are reported too.

    ## Why is this bad?
    The launch stops with "provided value is not valid". A comparison with a value that is not one of the choices is
    never true.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch.actions import DeclareLaunchArgument


     def generate_launch_description():
    -    return LaunchDescription([DeclareLaunchArgument("mode", default_value="map", choices=["slam", "amcl"])])
    +    return LaunchDescription([DeclareLaunchArgument("mode", default_value="slam", choices=["slam", "amcl"])])
    ```
    """

    code = "L125"
    name = "launch-argument-refused"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each value that the launch refuses."""
        from urdfkit.lint.facts.parameters.launch_arguments import refused_values

        for span, message in refused_values(model):
            yield self.at_span(span, message)
