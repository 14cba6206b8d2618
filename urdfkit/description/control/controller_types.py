"""Controller types of ros_controllers (Noetic) and ros2_controllers (Rolling), and misspelt ones."""

from urdfkit.errors import similar

SIMULATED = (
    "ackermann_steering_controller/AckermannSteeringController",
    "bicycle_steering_controller/BicycleSteeringController",
    "diff_drive_controller/DiffDriveController",
    "effort_controllers/GripperActionController",
    "effort_controllers/JointEffortController",
    "effort_controllers/JointGroupEffortController",
    "effort_controllers/JointGroupPositionController",
    "effort_controllers/JointPositionController",
    "effort_controllers/JointTrajectoryController",
    "effort_controllers/JointVelocityController",
    "forward_command_controller/ForwardCommandController",
    "four_wheel_steering_controller/FourWheelSteeringController",
    "joint_state_broadcaster/JointStateBroadcaster",
    "joint_state_controller/JointStateController",
    "joint_trajectory_controller/JointTrajectoryController",
    "mecanum_drive_controller/MecanumDriveController",
    "parallel_gripper_action_controller/GripperActionController",
    "position_controllers/GripperActionController",
    "position_controllers/JointGroupPositionController",
    "position_controllers/JointPositionController",
    "position_controllers/JointTrajectoryController",
    "tricycle_steering_controller/TricycleSteeringController",
    "velocity_controllers/JointGroupVelocityController",
    "velocity_controllers/JointPositionController",
    "velocity_controllers/JointTrajectoryController",
    "velocity_controllers/JointVelocityController",
)
"""Types that urdfkit simulates."""

NOT_SIMULATED = (
    "admittance_controller/AdmittanceController",
    "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
    "force_torque_sensor_controller/ForceTorqueSensorController",
    "forward_command_controller/MultiInterfaceForwardCommandController",
    "gpio_controllers/GpioCommandController",
    "gripper_controllers/GripperActionController",
    "imu_sensor_broadcaster/IMUSensorBroadcaster",
    "imu_sensor_controller/ImuSensorController",
    "pid_controller/PidController",
    "pos_vel_acc_controllers/JointTrajectoryController",
    "pos_vel_controllers/JointTrajectoryController",
    "range_sensor_broadcaster/RangeSensorBroadcaster",
    "steering_controllers_library/SteeringControllersLibrary",
    "tricycle_controller/TricycleController",
)
"""Types that urdfkit does not simulate."""

TYPES = (*SIMULATED, *NOT_SIMULATED)

_MAX_LENGTH_DIFFERENCE = 2
"""Largest difference in length between a misspelt name and the correct name."""


def meant_type(name: str) -> str | None:
    """Return the type that a misspelt name stands for; None for a type, or for a name of another package."""
    package, _, kind = name.partition("/")
    of_package = {each.partition("/")[2]: each for each in TYPES if each.startswith(f"{package}/")}
    if name not in TYPES and (inner := similar(kind, of_package, cutoff=0.5)):
        return of_package[inner[0]]
    words = set(package.split("_"))
    longer = [each for each in TYPES if each.endswith(f"/{kind}") and words < set(each.partition("/")[0].split("_"))]
    if name not in TYPES and len(longer) == 1 and len(words) > 1:
        return longer[0]
    if name in TYPES or not (near := similar(name, TYPES, cutoff=0.9)):
        return None
    parts = zip(name.split("/"), near[0].split("/"), strict=False)
    is_near = all(abs(len(word) - len(other)) <= _MAX_LENGTH_DIFFERENCE for word, other in parts)
    return near[0] if is_near else None
