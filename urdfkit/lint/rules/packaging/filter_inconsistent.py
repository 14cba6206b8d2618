"""K983 filter-inconsistent."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class FilterInconsistent(RobotRule):
    """Frames or inputs of a filter of robot_localization contradict each other or the robot.

    ## What it does
    Checks the parameters of ``ekf_node`` and ``ukf_node`` in YAML for:

    - two filters that publish the same transform or have different base frames
    - a base frame that is a child of another link
    - two inputs with the same topic, and values that the messages of an input do not contain
    - an absolute position from drifting odometry next to another absolute position
    - a filter in the map frame without an absolute position
    - an axis along which no input provides the position or the velocity; y counts if the base can move sideways
    - position and velocity of the same odometry, so that the filter uses its data twice
    - a rate that is too low for the ``transform_tolerance`` of costmaps, controller and behavior servers and collision
      monitors

    Also reports packages in which no node publishes the transform from the odometry frame, because all filters and
    drive controllers disable it.

    ## Why is this bad?
    The estimated pose jumps between two sources, or drifts without bound. In other cases, a link has two parents in the
    TF tree, or the tree is not connected.

    ## Example
    ```diff
     ekf_filter_node:
       ros__parameters:
         odom_frame: odom
         base_link_frame: base_footprint
         world_frame: odom
         imu0: imu/data
    -    imu0_config: [true, true, false, false, false, true, false,
    +    imu0_config: [false, false, false, false, false, true, false,
             false, false, false, false, true, false, false, false]
    ```
    """

    code = "K983"
    name = "filter-inconsistent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each contradiction."""
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.navigation.filter_inputs import estimate_defects
        from urdfkit.lint.facts.navigation.filters import filter_defects, filters

        every = filters(model)
        for source, node, message in (*filter_defects(model, every), *estimate_defects(model, every)):
            names = tuple(each.name for each in every if each.group.find("world_frame") is node)
            kind = "transform" if names else ""
            yield self.at_span(span_of(source, node), message, names=names, kind=kind)
