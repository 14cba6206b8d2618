"""Registry of the simulated controllers of ros_control and ros2_control by type name."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.control import Settings
from urdfkit.description.control.controller_types import NOT_SIMULATED, meant_type
from urdfkit.errors import DescriptionError
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


def load_ros_controller(name: str, settings: Settings, hardware: Hardware) -> RosController | None:
    """Return a configured controller; None for a type that is not simulated.

    Raises:
        DescriptionError: unknown type, or an invalid parameter, with its position.
    """
    kind = settings.text("type")
    for controller in ROS_CONTROLLERS:
        if kind in controller.types:
            return controller(name, settings, hardware)
    if kind in NOT_SIMULATED or (meant := meant_type(kind)) is None:
        return None  # Without the library of another package, Gazebo runs without the controller, too.
    place = settings.group("type").position
    raise DescriptionError(f"unknown controller type `{kind}`" + Suggestion(meant), position=place, code="K962")
