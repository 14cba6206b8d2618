"""L124 map-transform-published-twice."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class MapTransformPublishedTwice(RobotRule):
    """A launch file starts two nodes that publish the transform from the map frame to the odometry frame.

    ## What it does
    Finds amcl, gmapping, slam_toolbox, cartographer and the filters of robot_localization with ``world_frame`` map,
    also in included launch files. Compares the launch arguments in the conditions of these nodes. Computed conditions
    and files with namespaces are not checked.

    ## Why is this bad?
    The robot jumps on the map between two poses. Often a condition is inverted: one value of the argument then starts
    both nodes, and the other value starts none.

    ## Example
    ```diff
     <launch>
       <arg name="mapping" default="false"/>
       <node if="$(var mapping)" pkg="slam_toolbox" exec="sync_slam_toolbox_node" name="slam"/>
    -  <node if="$(var mapping)" pkg="nav2_amcl" exec="amcl" name="amcl"/>
    +  <node unless="$(var mapping)" pkg="nav2_amcl" exec="amcl" name="amcl"/>
     </launch>
    ```
    """

    code = "L124"
    name = "map-transform-published-twice"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each pair of publishers."""
        from urdfkit.lint.facts.nodes.map_transforms import published_together

        for source, place, names, message in published_together(model):
            yield self.at_span(source.span(*place), message, help="check the conditions of both nodes", names=names)
