"""Z834 odometry-published-twice."""

from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class OdometryPublishedTwice(RobotRule):
    """A Gazebo drive and a filter of robot_localization publish the same transform.

    ## What it does
    Checks drives that set ``publish_odom_tf`` or ``publishOdomTF`` to true. Reports them if a YAML file of the package
    or a related package configures a filter of robot_localization that publishes the transform from the odometry frame.

    ## Why is this bad?
    The drive and the filter publish different poses of the same frame, so the robot jumps between these poses on the
    map.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_joint" type="fixed">
         <parent link="base"/><child link="left"/><origin xyz="0 0.2 0"/>
       </joint>
       <joint name="right_joint" type="fixed">
         <parent link="base"/><child link="right"/><origin xyz="0 -0.2 0"/>
       </joint>
       <gazebo>
         <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
           <left_joint>left_joint</left_joint>
           <right_joint>right_joint</right_joint>
           <wheel_separation>0.4</wheel_separation>
    -      <publish_odom_tf>true</publish_odom_tf>
    +      <publish_odom_tf>false</publish_odom_tf>
         </plugin>
       </gazebo>
     </robot>
    ```
    """

    code = "Z834"
    name = "odometry-published-twice"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each drive whose transform a filter publishes too."""
        from urdfkit.description.plugins import values
        from urdfkit.lint.facts.gazebo.plugins import plugins, spec_of
        from urdfkit.lint.facts.navigation.odometry_transforms import filters

        found = filters(model)
        for plugin, _, _ in plugins(model.robot) if found else ():
            spec = spec_of(plugin, model.target)
            publishes = spec.by_meaning("publish_odometry_tf") if spec is not None else None
            frame = spec.by_meaning("odometry_frame") if spec is not None else None
            odom = next((text for text, _ in values(plugin, frame)), frame.default) if frame is not None else "odom"
            same = next((file for file, name in found if name == (odom or "").strip("/")), None)
            for text, element in values(plugin, publishes) if publishes is not None and same is not None else ():
                if text.lower() in ("true", "1") and same is not None:
                    message = f"<{element.tag}> is true, but the filter in {same.rpartition('/')[2]} publishes "
                    message += "the same transform"
                    help = f"set <{element.tag}> or `publish_tf` of the filter to false"
                    yield self.at(model, element, message, help=help)
