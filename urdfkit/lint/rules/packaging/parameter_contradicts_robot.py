"""K993 parameter-contradicts-robot."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class ParameterContradictsRobot(RobotRule):
    """A parameter of a node contradicts the lengths, places or joints of the robot.

    ## What it does
    Checks the parameters in YAML that describe the robot to its own nodes. Reports:

    - a wheel radius, wheel diameter, track or wheelbase that no wheel or pair of wheels of the robot has, with a
      tolerance of 10 %
    - the length of a segment, such as ``thigh_length``, that differs by more than 2 % from the links with this name
    - a list of x or y coordinates that does not fit the list of names in the same section
    - a controller that takes commands by index, such as ``ForwardCommandController``, whose joints are in a different
      order from those in the parameters of a node, or whose order for one limb differs from that for the others

    Lengths in centimetres, millimetres or inches are accepted, and those of wheels that only measure. A file is not
    checked if another one has the same parameters with the values of this robot. A node may have further lists in
    another order if one of its lists has the order of the controller. The rule does not check wheels if another
    description in these packages has continuous joints.

    ## Why is this bad?
    The node computes odometry, speeds or joint positions for a different robot, or sends commands to the wrong joints.

    ## Example
    ```diff
     walker:
       ros__parameters:
    -    thigh_length: 0.21
    +    thigh_length: 0.12
    ```

    ## References
    In the robot of this example, the shank joint is 0.12 m from the origin of the thigh.
    """

    code = "K993"
    name = "parameter-contradicts-robot"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter that contradicts the robot."""
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.robot_parameters.lengths import wrong_lengths
        from urdfkit.lint.facts.robot_parameters.orders import wrong_orders
        from urdfkit.lint.facts.robot_parameters.places import wrong_places

        if model.is_damaged:
            return
        for source, node, message in (*wrong_lengths(model), *wrong_places(model), *wrong_orders(model)):
            yield self.at_span(span_of(source, node), message)
