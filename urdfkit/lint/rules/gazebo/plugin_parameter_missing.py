"""Z831 plugin-parameter-missing."""

from urdfkit.lint.facts.gazebo.plugins import is_foreign, plugins, spec_of, specs
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_REQUIRED = {
    ("imu", "ros1"): ("body",),
    ("p3d", "ros1"): ("body", "topic"),
    ("p3d", "ros2"): ("body",),
}
"""Kind and generation → required parameters (gazebo_plugins, gazebo_ros_imu.cpp and gazebo_ros_p3d.cpp)."""


class PluginParameterMissing(RobotRule):
    """A plugin lacks a required parameter.

    ## What it does
    Checks ``libgazebo_ros_imu.so`` of ROS 1 and ``libgazebo_ros_p3d.so`` for a missing link to measure, and
    ``libgazebo_ros_p3d.so`` of ROS 1 also for a missing topic.

    ## Why is this bad?
    The plugin logs a single message at start-up and publishes nothing.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo>
        <plugin name="truth" filename="libgazebo_ros_p3d.so">
          <topicName>truth</topicName>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo>
        <plugin name="truth" filename="libgazebo_ros_p3d.so">
          <bodyName>base</bodyName>
          <topicName>truth</topicName>
        </plugin>
      </gazebo>
    </robot>
    ```
    """

    code = "Z831"
    name = "plugin-parameter-missing"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each required parameter that is missing, unless it is misspelt."""
        if model.is_incomplete:
            return
        from urdfkit.description.plugins.unread_parameters import unread

        for plugin, _, sensor in plugins(model.robot):
            spec = spec_of(plugin, model.target)
            if spec is None or sensor is not None or is_foreign(plugin, model):
                continue
            misspelt = {other.meant for other in unread(plugin, spec)}
            for meaning in _REQUIRED.get((spec.kind, spec.generation), ()):
                tags = {variant.tag for other in specs(plugin) if (variant := other.by_meaning(meaning)) is not None}
                parameter = spec.by_meaning(meaning)
                if parameter is None or parameter.tag in misspelt:
                    continue
                if not any(child.tag in tags for child in plugin.element.children):
                    name = (plugin.filename or "").strip()
                    purpose = "the link to measure" if parameter.names == "link" else "the topic to publish"
                    message = f"`{name}` requires <{parameter.tag}>, {purpose}"
                    yield self.at(model, plugin.element, message, help=f"add <{parameter.tag}>…</{parameter.tag}>")
