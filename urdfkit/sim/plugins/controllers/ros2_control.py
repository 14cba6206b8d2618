"""gz_ros2_control and gazebo_ros2_control: the ROS 2 controllers, from ``<ros2_control>`` and ``<parameters>``.

Sources: gz_ros2_control, gz_ros2_control_plugin.cpp and gz_system.cpp; gazebo_ros2_control, gazebo_system.cpp.
"""

from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.control import Settings, node_settings, read_settings
from urdfkit.description.control.parameter_files import parameter_file
from urdfkit.description.control.ros2_controllers import configured_controllers, manager_files
from urdfkit.description.hardware_defects import MOCKS, mock_blocks, simulation_hint
from urdfkit.description.plugins.controller_plugins import GAZEBO_ROS2_CONTROL
from urdfkit.description.urdf.robot import Plugin, Robot
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Position
from urdfkit.errors import ResourceError, SimulationError, similar
from urdfkit.notice import Notice
from urdfkit.sim.plugins.controllers.command_output import (
    INTERFACES,
    EffortOutput,
    Output,
    PositionOutput,
    ProportionalOutput,
    VelocityOutput,
)
from urdfkit.sim.plugins.controllers.control_loop import ControlLoop
from urdfkit.sim.plugins.controllers.control_loop_plugin import ControlLoopPlugin
from urdfkit.sim.plugins.controllers.controller import Hardware
from urdfkit.sim.plugins.controllers.controller_manager import serve
from urdfkit.sim.plugins.controllers.joint_handle import JointHandle
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics

SIMULATED = ("gz_ros2_control/GazeboSimSystem", "ign_ros2_control/IgnitionSystem", "gazebo_ros2_control/GazeboSystem")
"""Hardware plugins of the simulators."""

UPDATE_RATE = 100.0
"""Default update rate of the controller manager [Hz]."""


class Ros2Control(ControlLoopPlugin):
    """Plugin that runs the controllers of the parameter files on the joints of the ``<ros2_control>`` blocks.

    Attributes:
        is_mock: no plugin of the description runs the blocks; see `mock_control`.
    """

    kind = "ros2_control"
    is_mock = False

    def configure(self, setup: Setup) -> None:
        """Read the joints and the controllers, and start the controllers.

        Raises:
            UrdfkitError: a file is missing, or a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        topics = Topics(self.plugin, GAZEBO_ROS2_CONTROL)
        namespace = topics.resolve("").rstrip("/")
        root = self._parameters(setup, read)
        boss = node_settings(root, namespace, read.text("controller_manager") or "controller_manager")
        rate = boss.number("update_rate", UPDATE_RATE)
        if rate <= 0:
            place = boss.group("update_rate").position
            raise SimulationError(f"`update_rate` is {rate:g} Hz", position=place, code="K971")
        period = max(setup.dt, 1.0 / rate)
        gain = read.number("position_gain", 0.1) if self.spec.generation == "gz" else None
        hardware = Hardware(setup, topics.resolve, 2, period, {}, (), lambda: loop.wake(), "<command_interface>")
        self.left_out = hardware.left_out
        hardware.joints = tuple(self._joints(setup, hardware, gain))
        configured = configured_controllers(root, namespace, boss)
        hold = self.spec.generation != "gz" or read.flag("hold_joints")
        loop = self.loop = ControlLoop(namespace, configured, hardware, hold=hold)
        if not configured and (setup.parameter_files or not self.is_mock):
            setup.note(f"{self.plugin.element.origin.position}: no controllers: `controller_manager` configures none")
        loop.start_all()
        serve(loop, read.text("controller_manager") or "controller_manager")

    def _parameters(self, setup: Setup, read: Parameters) -> Settings:
        position = read.place("configuration")
        if self.is_mock and not setup.parameter_files:
            return _mock_parameters(setup, self.plugin)
        found = Settings("", position)
        paths = setup.parameter_files or tuple(
            _path(text, setup, read.place("configuration", index))
            for index, text in enumerate(read.texts("configuration"))
        )
        for path in paths:
            more = read_settings(path, separator=".")
            found = found.merged(more) if found.children else more
        return found

    def _joints(self, setup: Setup, hardware: Hardware, gain: float | None) -> list[str]:
        """Fill the outputs of the hardware; return the joints of the simulator's blocks."""
        joints: list[str] = []
        robot = setup.kinematics.robot
        for block in mock_blocks(robot) if self.is_mock else robot.ros2_control:
            parts = block.element.find("hardware")
            plugin = parts.find("plugin") if parts is not None else None
            name = plugin.text.strip() if plugin is not None else ""
            if name not in (*SIMULATED, *MOCKS):
                place = (plugin or parts or block.element).origin.position
                near = next(iter(similar(name, SIMULATED, cutoff=0.85)), None)
                hint = f"; {hint}" if (hint := simulation_hint(robot)) else ""
                defect = f"hardware `{name}` is not the simulator's" + Suggestion(near)
                error = SimulationError(defect + hint if setup.repairs.strict else defect, position=place)
                effect = "its joints are not controlled" + hint
                setup.repairs.leave_out(error, effect, "hardware", "C717" if plugin is None else "C709")
                names = (element.get("name") or "" for element in block.element.find_all("joint"))
                hardware.left_out.update(dict.fromkeys(names, f"hardware `{name}`"))
                continue
            of_block = None if name in MOCKS else gain
            for element in block.element.find_all("joint"):
                written = robot.joint_by_name.get(element.get("name") or "")
                command = element.find("command_interface") if written and written.type == "fixed" else None
                try:
                    own = setup.joint(element.get("name") or "", (command or element).origin.position, "C707")
                except SimulationError as error:
                    setup.repairs.leave_out(error, "the joint is not controlled", "hardware")
                    continue
                joints.append(own)
                for output in self._outputs(element, own, setup, hardware.period, of_block):
                    hardware.outputs[output.claim] = output
        return joints

    def _outputs(self, element: Element, joint: str, setup: Setup, period: float, gain: float | None) -> list[Output]:
        handle = JointHandle(setup.kinematics, setup.kinematics.robot.joint_by_name[joint])
        found: list[Output] = []
        for interface in element.find_all("command_interface"):
            kind = interface.get("name") or ""
            if kind not in INTERFACES:
                error = SimulationError(
                    f"unknown command interface `{kind}` of joint `{joint}` (available: {', '.join(INTERFACES)})",
                    position=interface.origin.position,
                )
                setup.repairs.leave_out(error, "the interface is ignored", "hardware", "C710")
                self.left_out[joint] = f"interface `{kind}`"
            elif joint in setup.kinematics.mimic_names:
                at = interface.origin.position
                text = f"{at}: joint `{joint}` mimics another joint and accepts no commands"
                setup.note(Notice(text, position=at, cause="mimic"))
            elif kind == "effort":
                found.append(EffortOutput(handle, period))
            elif kind == "velocity":
                found.append(VelocityOutput(handle, period))
            else:
                found.append(
                    PositionOutput(handle, period) if gain is None else ProportionalOutput(handle, period, gain)
                )
        for interface in element.find_all("state_interface"):
            for parameter in interface.find_all("param"):
                if parameter.get("name") == "initial_value" and interface.get("name") == "position":
                    value = number(parameter.text)
                    if value is None:
                        error = SimulationError(
                            f"initial_value `{parameter.text}` of joint `{joint}` is not a number",
                            position=parameter.origin.position,
                        )
                        setup.repairs.leave_out(error, "the joint starts at zero", "hardware", "C710")
                    elif joint not in setup.kinematics.mimic_names:
                        self.initial_positions[joint] = value
        return sorted(found, key=lambda output: INTERFACES.index(output.interface))


def mock_control(robot: Robot) -> Ros2Control:
    """Return the controller manager of a robot with mock hardware, which no plugin of its description runs.

    Its parameter files are those of ``--controllers``, otherwise the file of the robot's packages that configures
    controllers, if there is only one.

    Args:
        robot: a robot with `mock_blocks`.
    """
    element = mock_blocks(robot)[0].element
    made = Ros2Control(Plugin(element.get("name"), None, element), GAZEBO_ROS2_CONTROL)
    made.is_mock = True
    return made


def _mock_parameters(setup: Setup, plugin: Plugin) -> Settings:
    position = plugin.element.origin.position
    robot = setup.kinematics.robot
    files = manager_files(Path(robot.files[0])) if robot.files else ()
    if len(files) == 1:
        setup.note(Notice(f"controllers of ros2_control `{plugin.name or ''}`: {shown_path(files[0])}", "note"))
        return read_settings(files[0], separator=".")
    if files:
        names = " or ".join(shown_path(file) for file in files)
        setup.note(f"{position}: no controllers: {len(files)} files configure some; pass {names} with --controllers")
    else:
        missing = "no YAML file in `config` of its package configures any; pass a file with --controllers"
        setup.note(f"{position}: no controllers: {missing}")
    return Settings("", position)


def _path(text: str, setup: Setup, position: Position) -> Path:
    """Return the path of the file that a ``<parameters>`` element names.

    Raises:
        SimulationError: file or package not found; with the position of the element and the nearest file.
    """
    robot = setup.kinematics.robot
    try:
        folder = robot.files[0].parent if robot.files else Path()
        return parameter_file(text, robot.packages, folder, in_any_case=True, position=position)
    except ResourceError as error:
        raise SimulationError(error.message, position=position, code="Z828") from None
