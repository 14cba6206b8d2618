"""C709 ros2-control-plugin-vs-distro."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_text
from urdfkit.lint.gazebo import plugins, simulated_hardware
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule
from urdfkit.lint.target import WITHOUT_CLASSIC

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

HARDWARE = {
    "gazebo_ros2_control": "gazebo_ros2_control/GazeboSystem",
    "gz_ros2_control": "gz_ros2_control/GazeboSimSystem",
    "ign_ros2_control": "ign_ros2_control/IgnitionSystem",
}
"""Package of the plugin → its hardware (the plugin descriptions of gazebo_ros2_control and gz_ros2_control)."""

MOCKS = ("mock_components/GenericSystem", "fake_components/GenericSystem")
"""The hardware that stands in for any, under its name since Iron and before."""


class HardwareMismatch(RobotRule):
    """The hardware of ``<ros2_control>`` is not that of the robot's Gazebo plugin.

    ## What it does
    Each plugin that runs the controller manager in Gazebo has hardware of its own: gazebo_ros2_control has
    ``gazebo_ros2_control/GazeboSystem``, gz_ros2_control ``gz_ros2_control/GazeboSimSystem`` and ign_ros2_control
    ``ign_ros2_control/IgnitionSystem``. Names that are nearly one of them, or nearly ``mock_components/GenericSystem``,
    are reported too; other hardware passes. From Jazzy on (``--target ros2-jazzy``) there is no Gazebo classic, and so
    no ``gazebo_ros2_control/GazeboSystem``; nor is there for ``--target gz``, and ``classic`` has only that one.

    ## Why is this bad?
    pluginlib finds no such class: the controller manager stops.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <ros2_control name="arm" type="system">
        <hardware><plugin>gz_ros2_control/GazeboSystem</plugin></hardware>
      </ros2_control>
      <gazebo>
        <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin"/>
      </gazebo>
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

    ## Fix safety
    Unsafe: the hardware of that plugin is taken.
    """

    code = "C709"
    name = "ros2-control-plugin-vs-distro"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each hardware that the robot's Gazebo plugin does not have."""
        if not model.robot.ros2_control:
            return
        files = {(plugin.filename or "").strip() for plugin, _, _ in plugins(model.robot)}
        hosts = {known for known in HARDWARE if any(known in file for file in files)}
        for block in model.robot.ros2_control:
            hardware = block.element.find("hardware")
            element = hardware.find("plugin") if hardware is not None else None
            text = element.text if element is not None else ""
            if element is None or not text or "$" in text:
                continue
            package = text.partition("/")[0]
            if text in MOCKS:
                continue
            if text == HARDWARE["gazebo_ros2_control"] and model.release in WITHOUT_CLASSIC:
                right, message = HARDWARE["gz_ros2_control"], f"`{text}` does not exist for {model.release}"
            elif text in HARDWARE.values():
                if not hosts and (own := simulated_hardware(model)) is not None and package not in own:
                    hosts = {own[0]}
                # In Humble gz_ros2_control has the hardware of both names.
                if len(hosts) != 1 or package in hosts or {package, *hosts} == {"gz_ros2_control", "ign_ros2_control"}:
                    continue
                right = HARDWARE[next(iter(hosts))]
                message = f"`{text}` is not the hardware of {next(iter(hosts))}"
            else:
                near = HARDWARE.get(package) or nearest(text, (*HARDWARE.values(), *MOCKS), likeness=0.9)
                if near is None:
                    continue
                right, message = near, f"there is no hardware `{text}`"
            yield self.at(
                model,
                element,
                message,
                help=f"it is `{right}`",
                fix=new_text(model, element, right, "unsafe", f"Write `{right}`"),
            )
