"""Z831 plugin-parameter-missing."""

from urdfkit.description.plugins.parameter_values import FLAGS, unpaired_wheels
from urdfkit.description.urdf.robot import Plugin
from urdfkit.lint.facts.gazebo.plugins import is_foreign, plugins, spec_of, specs
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_REQUIRED = {
    ("imu", "ros1"): ("body",),
    ("p3d", "ros1"): ("body", "topic"),
    ("p3d", "ros2"): ("body",),
    ("joint_controller", "gz"): ("joints",),
    ("joint_position_controller", "gz"): ("joints",),
    ("mecanum_drive", "gz"): ("front_left_joint", "front_right_joint", "back_left_joint", "back_right_joint"),
    ("ackermann_steering", "gz"): ("left_steering_joint", "right_steering_joint", "left_joint", "right_joint"),
}
"""Kind and generation → required parameters (gazebo_plugins, gazebo_ros_imu.cpp and gazebo_ros_p3d.cpp; gz-sim)."""

_PURPOSES = {"link": "the link to measure", "joint": "the joints to move"}


class PluginParameterMissing(RobotRule):
    """A plugin lacks a required parameter.

    ## What it does
    Checks that ``libgazebo_ros_imu.so`` of ROS 1 and ``libgazebo_ros_p3d.so`` name the link that they measure, and that
    ``libgazebo_ros_p3d.so`` of ROS 1 also names a topic. Checks the drives and joint controllers of Gazebo Sim for
    missing joints, and differential drives for unequal numbers of left and right wheels.

    ## Why is this bad?
    The plugin logs a single message when the simulator starts, and does nothing afterwards.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <gazebo>
         <plugin name="truth" filename="libgazebo_ros_p3d.so">
    +      <bodyName>base</bodyName>
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
            if spec.kind == "diff_drive" and (fault := unpaired_wheels(plugin, spec)) is not None:
                yield self.at(model, *fault)
            misspelt = {other.meant for other in unread(plugin, spec)}
            missing: dict[str, list[str]] = {}
            for meaning in _REQUIRED.get((spec.kind, spec.generation), ()):
                tags = {variant.tag for other in specs(plugin) if (variant := other.by_meaning(meaning)) is not None}
                parameter = spec.by_meaning(meaning)
                if spec.kind == "ackermann_steering" and "steering" not in meaning and _only_steers(plugin):
                    continue
                if parameter is None or parameter.tag in misspelt:
                    continue
                if not any(child.tag in tags and child.text for child in plugin.element.children):
                    missing.setdefault(parameter.names or "", []).append(f"<{parameter.tag}>")
            for names, written in missing.items():
                tag, purpose = " and ".join(written), _PURPOSES.get(names, "the topic to publish")
                message = f"`{(plugin.filename or '').strip()}` requires {tag}, {purpose}"
                help = f"add {' and '.join(f'{each}…</{each[1:]}' for each in written)}"
                yield self.at(model, plugin.element, message, help=help)


def _only_steers(plugin: Plugin) -> bool:
    element = plugin.element.find("steering_only")
    return element is not None and FLAGS.get(element.text.lower(), False)
