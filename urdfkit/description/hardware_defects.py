"""Hardware of a robot that a simulation does not run: the message, and the xacro arguments that select another."""

import re

from urdfkit.description.plugins import match
from urdfkit.description.plugins.drives.table import DRIVES
from urdfkit.description.urdf.robot import Robot, Ros2Control
from urdfkit.description.xacro.declared_arguments import declared_arguments
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import read_source

_FALSE = ("false", "False", "0")
_SIMULATION = re.compile(r"(^|_)(sim|simulation|gazebo|gz|ignition|ign|mock|fake)(_|$)")


def simulation_hint(robot: Robot) -> str:
    """Return the advice to pass the arguments that enable the simulated hardware; empty without any.

    All files of the robot are searched. It is empty, too, if the robot was loaded with such an argument.
    """
    defaults = declared_arguments([read_source(file) for file in robot.files if file.is_file()])
    enabling = [name for name, value in defaults.items() if value in _FALSE and _SIMULATION.search(name)]
    if not enabling or any(name in robot.arguments for name in enabling):
        return ""
    return f"pass {' or '.join(f'{name}:=true' for name in enabling)}"


_CONTROLLERS = ("ros2_control", "gazebo_ros_control", "joint_controller", "joint_position_controller")

GAZEBO_PLUGINS = {
    "gz_ros2_control/GazeboSimSystem": ("gz_ros2_control-system", "gz_ros2_control::GazeboSimROS2ControlPlugin"),
    "ign_ros2_control/IgnitionSystem": ("ign_ros2_control-system", "ign_ros2_control::IgnitionROS2ControlPlugin"),
    "gazebo_ros2_control/GazeboSystem": ("libgazebo_ros2_control.so", "gazebo_ros2_control"),
}
"""Hardware → file and name of the plugin that loads it (the READMEs of gz_ros2_control and gazebo_ros2_control)."""


MOCKS = ("mock_components/GenericSystem", "fake_components/GenericSystem")
"""Hardware plugins without a simulator, whose joints take the commanded values; simulated as ideal actuators."""


def mock_blocks(robot: Robot) -> tuple[Ros2Control, ...]:
    """Return the blocks with mock hardware of a robot that no Gazebo plugin drives; empty for every other robot.

    In ROS, ``ros2_control_node`` runs them without Gazebo, so that the description names no plugin.
    """
    specs = [match(plugin) for block in robot.gazebo for plugin in block.plugins]
    if any(spec is not None and (spec in DRIVES or spec.kind in _CONTROLLERS) for spec in specs):
        return ()
    plugins = [(block, hardware_plugin(block)) for block in robot.ros2_control]
    return tuple(block for block, plugin in plugins if plugin is not None and plugin.text.strip() in MOCKS)


def hardware_plugin(block: Ros2Control) -> Element | None:
    """Return the ``<plugin>`` in the ``<hardware>`` of a ``<ros2_control>``; None if it has none."""
    return next((each.find("plugin") for each in block.element.find_all("hardware")), None)


def not_run(block: Ros2Control, robot: Robot) -> tuple[str, str]:
    """Return the message about a ``<ros2_control>`` that no plugin runs, and what to pass or to add."""
    plugin = hardware_plugin(block)
    name = "" if plugin is None else plugin.text.strip()
    of = f" with the hardware `{name}`" if name else ""
    message = f"no plugin runs ros2_control `{block.name or ''}`{of}: its joints are not controlled"
    if hint := simulation_hint(robot):
        return message, hint
    if name in GAZEBO_PLUGINS:
        return message, f'add <gazebo><plugin filename="{GAZEBO_PLUGINS[name][0]}" name="{GAZEBO_PLUGINS[name][1]}"/>'
    meant = next(iter(GAZEBO_PLUGINS))
    return (
        message,
        f'to simulate it, write the hardware `{meant}` and add <plugin filename="{GAZEBO_PLUGINS[meant][0]}">',
    )
