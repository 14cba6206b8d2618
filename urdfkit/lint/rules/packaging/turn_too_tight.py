"""K986 turn-too-tight."""

from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class TurnTooTight(RobotRule):
    """Navigation plans turns that are tighter than the steering of the robot allows.

    ## What it does
    Computes the smallest turning radius from the wheelbase and the limits of the steering joints that a steering
    controller or ``tricycle_controller`` in YAML names. Reports planners with a smaller ``minimum_turning_radius``, and
    ``use_rotate_to_heading`` of the regulated pure pursuit controller. Deviations of up to 10 % are accepted.

    ## Why is this bad?
    The robot leaves the planned path in tight turns, and does not reach the goal.

    ## Example
    ```diff
     planner_server:
       ros__parameters:
    -    GridBased: {plugin: "nav2_smac_planner::SmacPlannerHybrid", minimum_turning_radius: 0.2}
    +    GridBased: {plugin: "nav2_smac_planner::SmacPlannerHybrid", minimum_turning_radius: 0.6}
    ```

    ## References
    In the robot of this example, the axles are 0.4 m apart, and the steering joints turn by 0.6 rad.
    """

    code = "K986"
    name = "turn-too-tight"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter that needs a tighter turn."""
        if model.is_incomplete:
            return
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.gazebo.steered_axles import tight_turns

        for source, node, message in tight_turns(model):
            yield self.at_span(span_of(source, node), message)
