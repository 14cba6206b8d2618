"""C718 gazebo-hardware-without-plugin."""

from __future__ import annotations

from urdfkit.lint.gazebo import plugins, simulated_hardware
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_PLUGINS = {
    "gz_ros2_control/GazeboSimSystem": ("gz_ros2_control-system", "gz_ros2_control::GazeboSimROS2ControlPlugin"),
    "ign_ros2_control/IgnitionSystem": ("ign_ros2_control-system", "ign_ros2_control::IgnitionROS2ControlPlugin"),
    "gazebo_ros2_control/GazeboSystem": ("libgazebo_ros2_control.so", "gazebo_ros2_control"),
}
"""Hardware → file and name of the plugin that loads it (the READMEs of gz_ros2_control and gazebo_ros2_control)."""


_PARTS = r"<(?:gazebo|plugin|ros2_control|xacro:(?!if|unless|property|arg)\w)"
"""What may bring the plugin, or the hardware."""


class HardwareWithoutPlugin(RobotRule):
    """The hardware of ``<ros2_control>`` is Gazebo's, and no plugin in ``<gazebo>`` loads it.

    ## What it does
    Looks for robots whose ``<hardware>`` is that of gz_ros2_control, ign_ros2_control or gazebo_ros2_control and that
    bring none of their plugins. Where other files of the package name one, nothing is said.

    ## Why is this bad?
    The plugin runs the controller manager inside Gazebo. Without it spawners wait for ``/controller_manager`` for ever,
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

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for the first hardware of Gazebo, where no plugin loads it."""
        if model.is_incomplete or any("ros2_control" in (one.filename or "") for one, _, _ in plugins(model.robot)):
            return
        for block in model.robot.ros2_control:
            hardware = block.element.find("hardware")
            element = hardware.find("plugin") if hardware is not None else None
            if element is None or element.text not in _PLUGINS:
                continue
            own = simulated_hardware(model)
            if own is not None and element.text.partition("/")[0] not in own:
                continue  # It is hardware of another Gazebo: that has to be changed first.
            if not _is_loaded_elsewhere(model):
                file, name = _PLUGINS[element.text]
                message = f"`{element.text}` is loaded by a plugin for Gazebo, and there is none"
                help = f'add <gazebo><plugin filename="{file}" name="{name}">…</plugin></gazebo>'
                yield self.at(model, element, message, help=help)
            return


def _is_loaded_elsewhere(model: Model) -> bool:
    """Whether another description of the package, or a part of these files that is left out, names a plugin."""
    import re

    from urdfkit.lint.around import is_conditional
    from urdfkit.lint.entries import descriptions

    if any(is_conditional(source.text, _PARTS) for source in model.expanded.sources.values()):
        return True
    texts = descriptions(model.package) if model.package is not None else ()
    return any(re.search(r"<plugin\b[^>]*ros2_control", text) for _, text in texts)
