"""K974 parameter-type-wrong."""

from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class ParameterTypeWrong(RobotRule):
    """A ROS 2 parameter does not have the type that its node declares, such as an integer for a floating-point number.

    ## What it does
    Compares the numbers in the parameters of ros2_controllers, Nav2 and robot_localization, and in the joint limits of
    MoveIt 2, with the types that the nodes declare. The types of the parameters of workspace nodes follow from the
    defaults in their Python or C++ code. For these nodes, parameters in launch files are compared too. Also checks
    lists of numbers in the parameters of all ROS 2 nodes: the elements of a list must have one type.

    ## Why is this bad?
    rclcpp does not convert integers to numbers with a decimal point. Therefore, the controller is not configured:
    "parameter 'constraints.goal_time' has invalid type". rcl rejects a file with a list that contains both types:
    "Sequence should be of same type".

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         base_controller:
           type: diff_drive_controller/DiffDriveController
     base_controller:
       ros__parameters:
    -    wheel_separation: 1
    +    wheel_separation: 1.0
    ```
    """

    code = "K974"
    name = "parameter-type-wrong"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each integer parameter and each list of two types."""
        from urdfkit.lint.facts.control.parameter_types import integers_for_doubles, mixed_lists
        from urdfkit.lint.facts.control.yaml_tree import span_of, yamls
        from urdfkit.lint.facts.launch.ros_version import ros_version
        from urdfkit.lint.facts.moveit.settings import integer_limits, moveit_yamls
        from urdfkit.lint.facts.navigation.defects import wrong_numbers
        from urdfkit.lint.facts.parameters.declared_types import wrong_types_of_own_nodes
        from urdfkit.lint.facts.parameters.node_parameters import wrong_numbers_of_nodes
        from urdfkit.lint.facts.parameters.own_parameters import wrong_types_in_launch, wrong_types_of_released_nodes
        from urdfkit.lint.facts.plugins.typed_groups import wrong_numbers_of_plugins

        for source, value, message, declaration in wrong_types_of_own_nodes(model):
            is_wrong = declaration is not None
            yield self.at_span(span_of(source, value), message, other=declaration, is_other_wrong=is_wrong)
        for source, place, message in (*wrong_types_in_launch(model), *wrong_types_of_released_nodes(model)):
            yield self.at_span(source.span(*place), message)
        for source in {each.file: each for each, _ in moveit_yamls(model)}.values():
            for value, name in integer_limits(source) if ros_version(source) == 2 else ():
                message = f"`{name}` is the integer {value.text}; write {value.text}.0"
                yield self.at_span(span_of(source, value), message)
        for source in yamls(model):
            of_controllers = set[tuple[int, int]]()
            for value, name, controller in integers_for_doubles(source):
                of_controllers.add((value.line, value.column))
                message = f"`{name}` of controller `{controller}` is the integer {value.text}; write {value.text}.0"
                yield self.at_span(span_of(source, value), message)
            wrong = {(value.line, value.column): (value, name, right) for value, name, right in wrong_numbers(source)}
            for value, name, right in (*wrong_numbers_of_nodes(source), *wrong_numbers_of_plugins(source)):
                if (value.line, value.column) not in of_controllers:
                    wrong.setdefault((value.line, value.column), (value, name, right))
            for value, name, right in wrong.values():
                kind = "integer" if right.endswith(".0") else "number with a decimal point"
                message = f"`{name}` is the {kind} {value.text}; write {right}"
                yield self.at_span(span_of(source, value), message)
            for key, item in mixed_lists(source):
                message = f"`{key.text}` has integers and numbers with a decimal point; write all with a decimal point"
                yield self.at_span(span_of(source, item), message)
