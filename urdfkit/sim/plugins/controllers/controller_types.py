"""Registry of the simulated controllers of ros_control and ros2_control by type name."""

from urdfkit.description.control import Settings
from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.sim.plugins.controllers.controller import Hardware, RosController
from urdfkit.sim.plugins.controllers.joints.forward_command import Forward, ForwardGroup
from urdfkit.sim.plugins.controllers.joints.gripper import Gripper
from urdfkit.sim.plugins.controllers.joints.joint_state_broadcaster import JointStatePublisher
from urdfkit.sim.plugins.controllers.joints.parallel_gripper import ParallelGripper
from urdfkit.sim.plugins.controllers.joints.pid_position import PidGroup, PidPosition, PidVelocity
from urdfkit.sim.plugins.controllers.mobile_base.diff_drive import DiffDriveController
from urdfkit.sim.plugins.controllers.mobile_base.four_wheel_steering import FourWheelSteeringController
from urdfkit.sim.plugins.controllers.mobile_base.mecanum import MecanumController
from urdfkit.sim.plugins.controllers.mobile_base.steering import SteeringController
from urdfkit.sim.plugins.controllers.trajectory.joint_trajectory import TrajectoryFollower

ROS_CONTROLLERS: tuple[type[RosController], ...] = (
    JointStatePublisher,
    Forward,
    ForwardGroup,
    PidPosition,
    PidVelocity,
    PidGroup,
    TrajectoryFollower,
    DiffDriveController,
    Gripper,
    ParallelGripper,
    SteeringController,
    FourWheelSteeringController,
    MecanumController,
)
"""All controller classes; a test fails if one is missing here."""

ELSEWHERE = (
    "admittance_controller/AdmittanceController",
    "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
    "force_torque_sensor_controller/ForceTorqueSensorController",
    "gpio_controllers/GpioCommandController",
    "gripper_controllers/GripperActionController",
    "imu_sensor_broadcaster/IMUSensorBroadcaster",
    "imu_sensor_controller/ImuSensorController",
    "pid_controller/PidController",
    "pos_vel_controllers/JointTrajectoryController",
    "pos_vel_acc_controllers/JointTrajectoryController",
    "range_sensor_broadcaster/RangeSensorBroadcaster",
    "steering_controllers_library/SteeringControllersLibrary",
    "tricycle_controller/TricycleController",
)
"""Controller types of ros2_controllers and ros_controllers that are not simulated."""


def load_ros_controller(name: str, settings: Settings, hardware: Hardware) -> RosController | None:
    """Return a configured controller; None for a type that is not simulated or belongs to an unknown package.

    Raises:
        DescriptionError: unknown type in a known package, or an invalid parameter, with its position.
    """
    kind = settings.text("type")
    names = [name for controller in ROS_CONTROLLERS for name in controller.types]
    for controller in ROS_CONTROLLERS:
        if kind in controller.types:
            return controller(name, settings, hardware)
    if kind in ELSEWHERE:
        return None
    package, packages = kind.partition("/")[0], {name.partition("/")[0] for name in names}
    if package not in packages and not did_you_mean(package, packages):
        return None  # third-party: Gazebo runs without it if its library is missing
    hint = did_you_mean(kind, (*names, *ELSEWHERE))
    raise DescriptionError(f"no controller type `{kind}`{hint}", position=settings.group("type").position)
