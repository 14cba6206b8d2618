"""Z808 plugin-name-case."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.hardware_defects import GAZEBO_PLUGINS, hardware_plugin
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_LATER, _FORMER = (
    GAZEBO_PLUGINS[each] for each in ("gz_ros2_control/GazeboSimSystem", "ign_ros2_control/IgnitionSystem")
)


class PluginNameCase(RobotRule):
    """The class name of a Gazebo Sim system has the wrong case, or belongs to another library.

    ## What it does
    Compares plugin names that begin with ``gz::``, ``ignition::`` or the namespace of gz_ros2_control or
    ign_ros2_control with the known classes, ignoring case. Also reports the class of gz_ros2_control with the library
    of ign_ros2_control.

    ## Why is this bad?
    Gazebo Sim looks up a plugin by the name of its C++ class. It finds no class ``gz::sim::Systems::DiffDrive`` and
    does not load the plugin.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <gazebo>
    -    <plugin name="gz::sim::Systems::OdometryPublisher" filename="gz-sim-odometry-publisher-system"/>
    +    <plugin name="gz::sim::systems::OdometryPublisher" filename="gz-sim-odometry-publisher-system"/>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Safe: the fix changes only the case of the name.
    """

    code = "Z808"
    name = "plugin-name-case"
    fix = "safe"
    not_for = NOT_GAZEBO | {"classic", "ros1"}

    def check(self, model: Model) -> Findings:
        """Yield a finding for each class in the wrong case."""
        from urdfkit.description.plugins import ALL_SPECS

        classes = {name.lower(): name for spec in ALL_SPECS for name in spec.class_names}
        for plugin, _, _ in plugins(model.robot):
            name = (plugin.name or "").strip()
            if not name.lower().startswith(("gz::", "ignition::", "gz_ros2_control::", "ign_ros2_control::")):
                continue
            library = (plugin.filename or "").strip()
            if name == _LATER[1] and library.removeprefix("lib").removesuffix(".so") == _FORMER[0]:
                hardware = [each.text.strip() for block in model.robot.ros2_control if (each := hardware_plugin(block))]
                is_later = any(each.startswith("gz_ros2_control/") for each in hardware)
                hint = Suggestion(_LATER[0], library) if is_later else Suggestion(_FORMER[1], name)
                message = f"library `{library}` has no class `{name}`" + hint
                yield self.at(model, plugin.element, message, attribute="filename" if is_later else "name")
            expected = classes.get(name.lower())
            if expected is None and "::systems::" in name.lower() and "::systems::" not in name:
                start = name.lower().index("::systems::")
                expected = f"{name[:start]}::systems::{name[start + 11 :]}"
            if expected is not None and expected != name:
                message = f"unknown class `{name}`" + Suggestion(expected, name)
                fix = new_value(model, plugin.element, "name", expected, "safe")
                yield self.at(model, plugin.element, message, attribute="name", fix=fix)
