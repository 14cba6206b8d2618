"""gazebo_ros_control: the ROS 1 controllers, from ``<transmission>`` and the parameters that a launch file loads.

Source: gazebo_ros_pkgs noetic-devel, gazebo_ros_control/src/{gazebo_ros_control_plugin,default_robot_hw_sim}.cpp.
"""

from urdfkit.description.control import Configuration, Settings, find_configuration
from urdfkit.description.control.ros1_controllers import SIMULATED_INTERFACES, controllers
from urdfkit.description.urdf.queries import UNDRIVEN
from urdfkit.description.urdf.robot import Transmission
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.messages import BOOL
from urdfkit.notice import Notice
from urdfkit.sim.plugins.controllers.command_output import EffortOutput, Output, PositionOutput, VelocityOutput
from urdfkit.sim.plugins.controllers.control_loop import ControlLoop
from urdfkit.sim.plugins.controllers.control_loop_plugin import ControlLoopPlugin
from urdfkit.sim.plugins.controllers.controller import Hardware
from urdfkit.sim.plugins.controllers.controller_manager import serve
from urdfkit.sim.plugins.controllers.joint_handle import JointHandle
from urdfkit.sim.plugins.controllers.joint_limits import read_limits
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.pid import read_gains


class GazeboRosControl(ControlLoopPlugin):
    """Plugin that runs the controllers of the robot's namespace on the joints of its transmissions."""

    kind = "gazebo_ros_control"

    def configure(self, setup: Setup) -> None:
        """Read the joints and the controllers; start the controllers that a launch file starts, otherwise all.

        Raises:
            UrdfkitError: a transmission or a parameter of a controller is invalid, and robots that need a repair are
                refused; with its position.
        """
        read = self.parameters(setup)
        topics = self.topic_names(setup.model)
        robot = setup.kinematics.robot
        namespace = topics.resolve("").rstrip("/")
        found = find_configuration(robot, namespace, setup.parameter_files)
        settings = found.settings if found is not None else Settings("", self.plugin.element.origin.position)
        configured = controllers(settings)
        period = max(setup.dt, read.number("control_period", setup.dt))
        of_hardware = self._hardware_settings(setup, read, found, settings)
        hardware = Hardware(setup, topics.resolve, 1, period, {}, (), lambda: loop.wake())
        for transmission in robot.transmissions:
            try:
                output = _output(transmission, of_hardware, setup, period)
            except SimulationError as error:
                effect = f"transmission `{transmission.name}` is ignored"
                setup.repairs.leave_out(error, effect, "hardware", position=transmission.element.origin.position)
                hardware.left_out.update(dict.fromkeys(_names(transmission), f"transmission `{transmission.name}`"))
            else:
                hardware.outputs.setdefault(output.claim, output)
        hardware.joints = tuple(dict.fromkeys(name for name, _ in hardware.outputs))
        if not hardware.outputs:
            place = self.plugin.element.origin.position
            setup.note(f"{place}: the robot has no <transmission>, so its controllers have no joints")
        loop = self.loop = ControlLoop(namespace, configured, hardware)
        if found is None:
            defect = f"no controllers for {namespace or '/'}: no launch file or YAML configures any; see --controllers"
            setup.note(f"{self.plugin.element.origin.position}: {defect}")
        else:
            setup.note(Notice(f"controllers of {namespace or '/'}: {found.source}", "note"))
        if found is not None and found.started is not None:
            for name in found.started:
                loop.start(name)
        else:
            loop.start_all()
        serve(loop)
        if stop := read.text("emergency_stop_topic"):
            setup.bus.subscribe(topics.resolve(stop), BOOL, lambda message: loop.halt(bool(message.data)))

    def _hardware_settings(
        self, setup: Setup, read: Parameters, found: Configuration | None, settings: Settings
    ) -> Settings:
        """Return the parameters of gains and limits: in Kinetic the root namespace's, unless ``legacyModeNS`` is false.

        Source: gazebo_ros_pkgs kinetic-devel, gazebo_ros_control_plugin.cpp.
        """
        legacy = setup.distro.name == "kinetic" and read.text("legacy_namespace").lower() not in ("false", "0")
        if not legacy or found is None or found.root is None or not found.settings.children:
            return settings
        if settings.find("gazebo_ros_control/pid_gains") is not None and settings is not found.root:
            setup.note(
                f"{settings.group('gazebo_ros_control').place}: Kinetic reads gains at /gazebo_ros_control/pid_gains, "
                "not here, unless <legacyModeNS>false</legacyModeNS>"
            )
        return found.root


def _names(transmission: Transmission) -> list[str]:
    return [joint.name or "" for joint in transmission.joints]


def _output(transmission: Transmission, settings: Settings, setup: Setup, period: float) -> Output:
    """Return the command interface of a transmission.

    Raises:
        SimulationError: not exactly one joint, a joint that nothing can drive, or no interface that Gazebo supports;
            with its position.
    """
    name, place = transmission.name or "", transmission.element.origin.position
    by_name = setup.kinematics.robot.joint_by_name
    for part in transmission.joints if len(transmission.joints) == 1 else ():
        if (written := by_name.get(part.name or "")) is not None and written.type in UNDRIVEN:
            fault = f"joint `{written.name}` is {written.type}: no transmission can drive it"
            raise SimulationError(fault, position=part.element.origin.position, code="C701")
    if len(transmission.joints) != 1:
        raise SimulationError(
            f"transmission `{name}` has {len(transmission.joints)} joints; Gazebo simulates transmissions of one joint",
            position=place,
            code="C703",
        )
    (joint,) = transmission.joints
    interfaces = joint.hardware_interfaces
    if not interfaces:
        interfaces = tuple(kind for actuator in transmission.actuators for kind in actuator.hardware_interfaces)
        if not interfaces:
            message = f"transmission `{name}` lacks <hardwareInterface> in its <joint>, "
            message += "such as hardware_interface/EffortJointInterface"
            raise SimulationError(message, position=joint.element.origin.position, code="C702")
        setup.note(f"{place}: transmission `{name}`: <hardwareInterface> belongs in <joint>, not <actuator>")
    kind = interfaces[0].strip().removeprefix("hardware_interface/")
    place = (joint.element.find("hardwareInterface") or joint.element).origin.position
    if kind not in SIMULATED_INTERFACES:
        raise SimulationError(
            f"transmission `{name}`: Gazebo has no interface `{interfaces[0]}`"
            + did_you_mean(kind, SIMULATED_INTERFACES)
            + f" (it has {', '.join(SIMULATED_INTERFACES)})",
            position=place,
            code="C703",
        )
    own = setup.joint(joint.name or "", joint.element.origin.position, "C701")
    controlled = setup.kinematics.robot.joint_by_name[own]
    handle, limits = JointHandle(setup.kinematics, controlled), read_limits(controlled, settings, setup.note)
    handle.lower, handle.upper = limits.lower, limits.upper
    handle.limit, handle.fastest = limits.effort, limits.velocity
    kind = SIMULATED_INTERFACES[kind]
    if kind == "effort":
        return EffortOutput(handle, period, limits)
    gains = read_gains(settings, f"gazebo_ros_control/pid_gains/{own}", setup.note)
    return (PositionOutput if kind == "position" else VelocityOutput)(handle, period, limits, gains)
