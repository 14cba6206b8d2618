"""K982 navigation-settings-inconsistent."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class NavigationSettingsInconsistent(RobotRule):
    """Parameters of costmaps or planners contradict each other.

    ## What it does
    Checks the parameters of Nav2 and move_base in YAML for:

    - costmap layers in the wrong order, and costmap topics that the server does not publish or cannot read
    - a local costmap that does not move with the robot
    - a global frame that moves with the robot, or differs from the frame of the static map
    - an inflation radius below the inscribed radius of the footprint
    - footprints whose sides cross or that do not contain the origin, and a radius in addition to a footprint
    - a local costmap that is updated too rarely for the speed of the robot
    - parameters of teb_local_planner that belong to another type of footprint or have no effect
    - unknown planners and layers, sections of planners that are not loaded, and parameters of other planners
    - a controller speed of more than twice the limit of the velocity smoother
    - a linear speed that exceeds the velocity limit of a wheel joint
    - motion models and speeds that assume sideways motion of a robot whose drive excludes it, or exclude sideways
      motion that the drive allows
    - plugin names of different releases in one file, and plugins with the parameters of another plugin
    - a time step of the MPPI controller that is shorter than the period of its server

    ## Why is this bad?
    The robot drives into obstacles that are not inflated, leaves its local costmap, or uses the default parameters of
    the planner. In other cases, a server does not start, or waits for a topic forever.

    ## Example
    ```diff
     local_costmap:
       global_frame: odom
       robot_base_frame: base_link
       rolling_window: true
       plugins:
    +    - {name: obstacle_layer, type: "costmap_2d::ObstacleLayer"}
         - {name: inflation_layer, type: "costmap_2d::InflationLayer"}
    -    - {name: obstacle_layer, type: "costmap_2d::ObstacleLayer"}
    ```
    """

    code = "K982"
    name = "navigation-settings-inconsistent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each contradiction."""
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.gazebo.base_motion import contradictions
        from urdfkit.lint.facts.navigation.commanded_speeds import speeds_beyond_wheels, unreachable_speeds
        from urdfkit.lint.facts.navigation.costmaps import costmap_defects
        from urdfkit.lint.facts.navigation.navigation_plugins import plugin_defects

        found = [*costmap_defects(model), *plugin_defects(model), *unreachable_speeds(model), *contradictions(model)]
        reported = {id(node) for _, node, _ in found}
        found += [each for each in speeds_beyond_wheels(model) if id(each[1]) not in reported]
        for source, node, message in found:
            yield self.at_span(span_of(source, node), message)
