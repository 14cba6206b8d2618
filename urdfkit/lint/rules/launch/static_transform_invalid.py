"""L118 static-transform-invalid."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class StaticTransformInvalid(RobotRule):
    """A launch file starts ``static_transform_publisher`` with wrong arguments.

    ## What it does
    Checks the arguments of ``static_transform_publisher`` (tf and tf2_ros) for:

    - a wrong number or order of arguments, and unknown or missing options
    - angles in degrees, and quaternions that are not normalized
    - a frame that is its own parent, a misspelt parent frame, and a child frame that a joint of the robot already
      places
    - a fixed frame, such as ``map``, below the root of the robot

    ## Why is this bad?
    The node exits, or the transform is missing or wrong. With two parents, a frame jumps between two places.

    ## Example
    ```diff
     <launch>
    -  <node name="map_to_odom" pkg="tf2_ros" type="static_transform_publisher" args="0 0 0 0 0 0 map odom 100"/>
    +  <node name="map_to_odom" pkg="tf2_ros" type="static_transform_publisher" args="0 0 0 0 0 0 map odom"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "L118"
    name = "static-transform-invalid"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each wrong argument."""
        from urdfkit.lint.facts.nodes.static_transforms import static_transform_defects

        for source, word, message in static_transform_defects(model):
            yield self.at_span(source.span(word.start, word.end), message)
