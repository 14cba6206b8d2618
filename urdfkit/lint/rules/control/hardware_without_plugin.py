"""C718 gazebo-hardware-without-plugin."""

from urdfkit.description.hardware_defects import GAZEBO_PLUGINS, hardware_plugin, mock_blocks, not_run
from urdfkit.lint.facts.gazebo.plugins import is_simulated, plugins, simulated_hardware
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_PLUGIN_OR_HARDWARE = r"<(?:gazebo|plugin|ros2_control|xacro:(?!if|unless|property|arg)\w)"
"""Matches elements that may add the plugin or the hardware."""


class HardwareWithoutPlugin(RobotRule):
    """The ``<hardware>`` of ``<ros2_control>`` runs in Gazebo, but no Gazebo plugin loads it.

    ## What it does
    Checks for robots that use the ``<hardware>`` of gz_ros2_control, ign_ros2_control or gazebo_ros2_control without
    the corresponding plugin. Other hardware is reported as a note if the robot has plugins or sensors for Gazebo.
    Nothing is reported if another file of the package names such a plugin. With ``--target urdfkit``, hardware that no
    plugin of the robot loads is reported as a warning. `urdfkit sim` prints the same warning. Mock hardware is
    accepted, because ``urdfkit sim`` treats it as an ideal actuator.

    ## Why is this bad?
    The plugin runs the controller manager inside Gazebo. Without it, spawners wait for ``/controller_manager`` forever
    and the robot does not move.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <ros2_control name="arm" type="system">
         <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
       </ros2_control>
    +  <gazebo>
    +    <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin"/>
    +  </gazebo>
     </robot>
    ```
    """

    code = "C718"
    name = "gazebo-hardware-without-plugin"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each hardware that no plugin loads."""
        if model.is_incomplete or any(
            "ros2_control" in (plugin.filename or "") for plugin, _, _ in plugins(model.robot)
        ):
            return
        is_loaded = model.target != "urdfkit" and _is_loaded_elsewhere(model)
        for block in model.robot.ros2_control:
            element = hardware_plugin(block)
            if element is None or is_loaded:
                continue  # A missing <plugin> is reported by C717.
            supported = simulated_hardware(model)
            name = element.text.strip()
            if model.target == "urdfkit":
                if block in mock_blocks(model.robot):
                    continue  # An ideal actuator.
                message, help = not_run(block, model.robot)
                yield self.at(model, element, message, help=help)
            elif name not in GAZEBO_PLUGINS:
                if is_simulated(model):
                    label = f" `{block.name}`" if block.name else ""
                    message = f"no Gazebo plugin runs ros2_control{label}: its controllers do not run in Gazebo"
                    yield self.at(model, element, message, severity="note")
            elif supported is None or name.partition("/")[0] in supported:  # Other hardware is reported by C709.
                file, plugin = GAZEBO_PLUGINS[name]
                message = f"missing Gazebo plugin for the hardware `{name}`"
                help = f'add <gazebo><plugin filename="{file}" name="{plugin}">…</plugin></gazebo>'
                yield self.at(model, element, message, help=help)


def _is_loaded_elsewhere(model: Model) -> bool:
    """Whether another description of the package, or a conditional part of these files, names a plugin."""
    import re

    from urdfkit.lint.facts.conditions import is_conditional
    from urdfkit.lint.project.description_files import descriptions

    if any(is_conditional(source.text, _PLUGIN_OR_HARDWARE) for source in model.expanded.sources.values()):
        return True
    texts = descriptions(model.package) if model.package is not None else ()
    return any(re.search(r"<plugin\b[^>]*ros2_control", text) for _, text in texts)
