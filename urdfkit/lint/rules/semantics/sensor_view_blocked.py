"""S915 sensor-view-blocked."""

from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class SensorViewBlocked(RobotRule):
    """The robot blocks the view of a camera or lidar.

    ## What it does
    Checks for Gazebo cameras and lidars that are inside a box, cylinder or sphere of another link, or whose view ends
    at such a shape within a metre. Also checks for lidars that see the robot in at least a quarter of their view, but
    would not see the robot after a rotation by 180°. Only links that are fixed to the link of the sensor are compared.
    Shapes with a diagonal of up to 0.25 m are ignored, because they are usually housings of the sensor.

    ## Why is this bad?
    The image is dark, or the scan has the same distance everywhere. Usually a sign or the height of the origin is
    wrong, or a sensor at the rear does not face backwards.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"><visual><geometry><box size="0.4 0.3 0.2"/></geometry></visual></link>
       <link name="lidar"/>
       <joint name="lidar_joint" type="fixed">
    -    <parent link="base"/><child link="lidar"/><origin xyz="0.1 0 0.05"/>
    +    <parent link="base"/><child link="lidar"/><origin xyz="0.1 0 0.15"/>
       </joint>
       <gazebo reference="lidar">
         <sensor name="lidar" type="ray"/>
       </gazebo>
     </robot>
    ```
    """

    code = "S915"
    name = "sensor-view-blocked"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each sensor with a blocked view, at the joint that places it."""
        from urdfkit.lint.facts.gazebo.blocked_sensors import blocked_sensors

        parents = {joint.child: joint for joint in model.robot.joints}
        for block, sensor, message, attribute in blocked_sensors(model):
            joint = parents.get(block.reference)
            origin = joint.element.find("origin") if joint is not None else None
            pose = sensor.element.find("pose")
            is_placed = pose is not None and any(word.strip("+-0.") for word in (pose.text or "").split())
            if joint is None or origin is None or is_placed:
                yield self.at(model, pose or sensor.element, message, link=block.reference)
                continue
            help = f"check the origin of joint `{joint.name}`"
            yield self.at(
                model, origin, message, attribute=attribute, link=block.reference, joint=joint.name, help=help
            )
