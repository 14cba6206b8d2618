"""Z808 plugin-name-case."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginNameCase(RobotRule):
    """The class name of a Gazebo Sim system has the wrong case.

    ## What it does
    Compares plugin names that begin with ``gz::``, ``ignition::`` or the namespace of gz_ros2_control or
    ign_ros2_control with the known classes, ignoring case.

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
            expected = classes.get(name.lower())
            if expected is None and "::systems::" in name.lower() and "::systems::" not in name:
                start = name.lower().index("::systems::")
                expected = f"{name[:start]}::systems::{name[start + 11 :]}"
            if expected is not None and expected != name:
                message = f"unknown class `{name}`" + Suggestion(expected, name)
                fix = new_value(model, plugin.element, "name", expected, "safe")
                yield self.at(model, plugin.element, message, attribute="name", fix=fix)
