"""C718 gazebo-hardware-without-plugin."""

from urdfkit.lint.facts.gazebo.plugins import is_simulated, plugins, simulated_hardware
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_PLUGINS = {
    "gz_ros2_control/GazeboSimSystem": ("gz_ros2_control-system", "gz_ros2_control::GazeboSimROS2ControlPlugin"),
    "ign_ros2_control/IgnitionSystem": ("ign_ros2_control-system", "ign_ros2_control::IgnitionROS2ControlPlugin"),
    "gazebo_ros2_control/GazeboSystem": ("libgazebo_ros2_control.so", "gazebo_ros2_control"),
}
"""Hardware → file and name of the plugin that loads it (the READMEs of gz_ros2_control and gazebo_ros2_control)."""


_PLUGIN_OR_HARDWARE = r"<(?:gazebo|plugin|ros2_control|xacro:(?!if|unless|property|arg)\w)"
"""Matches elements that may add the plugin or the hardware."""


class HardwareWithoutPlugin(RobotRule):
    """The ``<hardware>`` of ``<ros2_control>`` runs in Gazebo, but no Gazebo plugin loads it.

    ## What it does
    Checks for robots whose ``<hardware>`` is that of gz_ros2_control, ign_ros2_control or gazebo_ros2_control and that
    include none of the corresponding plugins. Other hardware is a note if the robot has plugins or sensors for Gazebo.
    Nothing is reported if another file of the package names such a plugin.

    ## Why is this bad?
    The plugin runs the controller manager inside Gazebo. Without it, spawners wait for ``/controller_manager`` forever
    and the robot does not move.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <ros2_control name="arm" type="system">
        <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
      </ros2_control>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <ros2_control name="arm" type="system">
        <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
      </ros2_control>
      <gazebo>
        <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin"/>
      </gazebo>
    </robot>
    ```
    """

    code = "C718"
    name = "gazebo-hardware-without-plugin"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for the first Gazebo hardware that no plugin loads."""
        if model.is_incomplete or any(
            "ros2_control" in (plugin.filename or "") for plugin, _, _ in plugins(model.robot)
        ):
            return
        for block in model.robot.ros2_control:
            hardware = block.element.find("hardware")
            element = hardware.find("plugin") if hardware is not None else None
            if element is None or element.text not in _PLUGINS:
                if element is not None and model.target != "urdfkit" and is_simulated(model):  # see Z833
                    label = f" `{block.name}`" if block.name else ""
                    message = f"no Gazebo plugin runs ros2_control{label}: its controllers do not run in Gazebo"
                    if not _is_loaded_elsewhere(model):
                        yield self.at(model, block.element, message, severity="note")
                continue
            supported = simulated_hardware(model)
            if supported is not None and element.text.partition("/")[0] not in supported:
                continue  # The hardware belongs to another Gazebo generation: reported by C709.
            if not _is_loaded_elsewhere(model):
                file, name = _PLUGINS[element.text]
                message = f"missing Gazebo plugin for the hardware `{element.text}`"
                help = f'add <gazebo><plugin filename="{file}" name="{name}">…</plugin></gazebo>'
                yield self.at(model, element, message, help=help)
            return


def _is_loaded_elsewhere(model: Model) -> bool:
    """Whether another description of the package, or a conditional part of these files, names a plugin."""
    import re

    from urdfkit.lint.facts.conditions import is_conditional
    from urdfkit.lint.project.description_files import descriptions

    if any(is_conditional(source.text, _PLUGIN_OR_HARDWARE) for source in model.expanded.sources.values()):
        return True
    texts = descriptions(model.package) if model.package is not None else ()
    return any(re.search(r"<plugin\b[^>]*ros2_control", text) for _, text in texts)
