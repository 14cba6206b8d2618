"""Z832 plugin-value-unknown."""

from urdfkit.description.urdf.robot import Plugin
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_OUTPUTS = ("sensor_msgs/LaserScan", "sensor_msgs/PointCloud", "sensor_msgs/PointCloud2", "sensor_msgs/Range")
"""Values of <output_type> (gazebo_ros_pkgs, ros2 branch: gazebo_ros_ray_sensor.cpp)."""

_SIM_TYPES = ("gazebo_ros_control/DefaultRobotHWSim",)
"""Values of <robotSimType> that gazebo_ros_control provides; other packages may provide others."""


class PluginValueUnknown(RobotRule):
    """A Gazebo plugin has a parameter with an invalid value.

    ## What it does
    Checks the parameters of drives, joint controllers and joint state publishers: values that are not numbers, divisors
    that are negative or zero, vectors of the wrong length, and flags that are neither true nor false. Also checks the
    ``<output_type>`` of the ray sensor plugin of gazebo_ros, the form ``from:=to`` of each ``<remapping>``, the topic
    that remappings of sensors replace, and the spelling of ``<robotSimType>``.

    ## Why is this bad?
    The plugin ignores the value, keeps the default, or publishes nothing ("Invalid <output_type>"). A simulation
    with urdfkit ignores the plugin.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <gazebo reference="base">
         <sensor name="lidar" type="ray">
           <plugin name="lidar" filename="libgazebo_ros_ray_sensor.so">
    -        <ros><remapping>~/out=scan</remapping></ros>
    +        <ros><remapping>~/out:=scan</remapping></ros>
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
        """Yield a finding for each invalid value."""
        from urdfkit.description.plugins import match
        from urdfkit.description.plugins.controller_plugins import CONTROL
        from urdfkit.description.plugins.drives.table import DRIVES
        from urdfkit.description.plugins.parameter_values import invalid_values
        from urdfkit.lint.facts.gazebo.plugins import plugins

        for plugin, _, sensor in plugins(model.robot):
            spec = match(plugin)
            if spec is not None and sensor is None and spec in (*DRIVES, *CONTROL):
                for element, message in invalid_values(plugin, spec):
                    if not model.is_unresolved(element):
                        yield self.at(model, element, message, severity="warning")
            if (plugin.filename or "").startswith("libgazebo_ros"):
                yield from self._texts(plugin, model)

    def _texts(self, plugin: Plugin, model: Model) -> Findings:
        from urdfkit.lint.fix_builders import meant, nearest

        for child in plugin.element.walk():
            text = child.text.strip()
            if "$" in text or child.children:
                continue
            if child.tag == "output_type" and text not in _OUTPUTS:
                message = f"unknown output type `{text}`" + meant(text, _OUTPUTS)[1]
                yield self.at(model, child, message, help=f"use one of {', '.join(_OUTPUTS)}")
            elif child.tag == "robotSimType" and text not in _SIM_TYPES and nearest(text, _SIM_TYPES, cutoff=0.8):
                yield self.at(model, child, f"unknown robotSimType `{text}`" + meant(text, _SIM_TYPES)[1])
            elif child.tag == "remapping" and ":=" not in text:
                yield self.at(model, child, f"remapping `{text}` is not of the form `from:=to`")
            elif child.tag == "remapping" and plugin.filename in _WITH_ONE_TOPIC:
                old, _, new = text.partition(":=")
                old = old.strip()
                if old.rpartition("/")[2] not in _TOPICS and not old.startswith("__"):
                    message = f"this plugin has no topic `{old}`, so the remapping has no effect; write `~/out:=…`"
                    names = (new.strip().strip("/"),)
                    yield self.at(model, child, message, severity="warning", kind="remapping", names=names)


_TOPICS = ("out", "vel", "tf", "tf_static", "clock", "rosout", "parameter_events")
"""Topics of these plugins, and those of every node."""

_WITH_ONE_TOPIC = tuple(f"libgazebo_ros_{name}_sensor.so" for name in ("ray", "imu", "gps"))
"""Plugins of ROS 2 that publish on ``~/out``, and the GPS sensor on ``~/vel`` too (gazebo_plugins, 3.5)."""
