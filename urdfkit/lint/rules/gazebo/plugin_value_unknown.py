"""Z832 plugin-value-unknown."""

from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_OUTPUTS = ("sensor_msgs/LaserScan", "sensor_msgs/PointCloud", "sensor_msgs/PointCloud2", "sensor_msgs/Range")
"""Values of <output_type> (gazebo_ros_pkgs, ros2 branch: gazebo_ros_ray_sensor.cpp)."""


class PluginValueUnknown(RobotRule):
    """A Gazebo plugin has an unknown output type or a malformed remapping.

    ## What it does
    Checks ``<output_type>`` of the ray sensor plugin of gazebo_ros, and that each ``<remapping>`` has the form
    ``from:=to``.

    ## Why is this bad?
    The plugin publishes nothing: "Invalid <output_type>", or keeps the default topic.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <sensor name="lidar" type="ray">
          <plugin name="lidar" filename="libgazebo_ros_ray_sensor.so">
            <ros><remapping>~/out=scan</remapping></ros>
            <output_type>sensor_msgs/LaserScan</output_type>
          </plugin>
        </sensor>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <sensor name="lidar" type="ray">
          <plugin name="lidar" filename="libgazebo_ros_ray_sensor.so">
            <ros><remapping>~/out:=scan</remapping></ros>
            <output_type>sensor_msgs/LaserScan</output_type>
          </plugin>
        </sensor>
      </gazebo>
    </robot>
    ```
    """

    code = "Z832"
    name = "plugin-value-unknown"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unknown value."""
        from urdfkit.lint.fix_builders import meant

        blocks = model.robot.gazebo
        plugins = [plugin for block in blocks for plugin in block.plugins]
        plugins += [plugin for block in blocks for sensor in block.sensors for plugin in sensor.plugins]
        for plugin in plugins:
            if not (plugin.filename or "").startswith("libgazebo_ros"):
                continue
            for child in plugin.element.walk():
                text = child.text.strip()
                if "$" in text or child.children:
                    continue
                if child.tag == "output_type" and text not in _OUTPUTS:
                    message = f"unknown output type `{text}`{meant(text, _OUTPUTS)[1]}"
                    yield self.at(model, child, message, help=f"use one of {', '.join(_OUTPUTS)}")
                elif child.tag == "remapping" and ":=" not in text:
                    yield self.at(model, child, f"remapping `{text}` is not of the form `from:=to`")
