"""Z817 sensor-type-deprecated."""

from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_REPLACEMENTS = {"ray": "gpu_lidar", "gpu_ray": "gpu_lidar", "depth": "depth_camera", "openni_kinect": "rgbd_camera"}


class SensorTypeDeprecated(RobotRule):
    """A sensor has a type that Gazebo Sim does not support.

    ## What it does
    Checks for sensors of type ``ray``, ``gpu_ray``, ``depth`` and ``openni_kinect`` with ``--target gz``, or if all
    plugins of the robot are for Gazebo Sim.

    ## Why is this bad?
    Gazebo Sim reports "Sensor type not supported yet" and publishes nothing.

    ## Example
    ```diff
     <robot name="cart">
       <link name="laser"/>
       <gazebo reference="laser">
    -    <sensor name="laser" type="ray"/>
    +    <sensor name="laser" type="gpu_lidar"/>
       </gazebo>
       <gazebo>
         <plugin name="gz::sim::systems::JointStatePublisher" filename="gz-sim-joint-state-publisher-system"/>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Safe: the new type reads the same elements.
    """

    code = "Z817"
    name = "sensor-type-deprecated"
    severity = "warning"
    fix = "safe"
    not_for = NOT_GAZEBO | {"classic", "ros1"}

    def check(self, model: Model) -> Findings:
        """Yield a finding for each sensor of an unsupported type."""
        from urdfkit.lint.facts.gazebo.plugins import generations, plugins

        found = [each for plugin, _, _ in plugins(model.robot) if (each := generations(plugin))]
        if model.target != "gz" and not (found and all(each == {"gz"} for each in found)):
            return
        for block in model.robot.gazebo:
            for sensor in block.sensors:
                new = _REPLACEMENTS.get((sensor.type or "").strip())
                if new is not None:
                    message = f"Gazebo Sim does not support sensors of type `{sensor.type}`"
                    fix = new_value(model, sensor.element, "type", new, "safe")
                    yield self.at(model, sensor.element, message, attribute="type", help=f'write type="{new}"', fix=fix)
