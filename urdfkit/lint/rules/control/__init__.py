"""Rules on transmissions and ros2_control."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.control.two_drivers import TwoDrivers

    return (TwoDrivers,)


def transmission_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on transmissions."""
    from urdfkit.lint.rules.control.hardware_interface_unknown import HardwareInterfaceUnknown
    from urdfkit.lint.rules.control.hardware_interface_unprefixed import HardwareInterfaceUnprefixed
    from urdfkit.lint.rules.control.old_transmission_syntax import OldTransmissionSyntax
    from urdfkit.lint.rules.control.transmission_interface_missing import TransmissionInterfaceMissing
    from urdfkit.lint.rules.control.transmission_joint_undefined import TransmissionJointUndefined

    return (
        TransmissionJointUndefined,
        TransmissionInterfaceMissing,
        HardwareInterfaceUnknown,
        HardwareInterfaceUnprefixed,
        OldTransmissionSyntax,
    )


def ros2_control_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on ``<ros2_control>``."""
    from urdfkit.lint.rules.control.interface_combination import InterfaceCombination
    from urdfkit.lint.rules.control.ros2_control_hardware import HardwareMismatch
    from urdfkit.lint.rules.control.ros2_control_in_gazebo import Ros2ControlInGazebo
    from urdfkit.lint.rules.control.ros2_control_joint_undefined import Ros2ControlJointUndefined

    return (
        Ros2ControlJointUndefined,
        Ros2ControlInGazebo,
        HardwareMismatch,
        InterfaceCombination,
    )


def targeted_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules that are asked for some targets only."""
    from urdfkit.lint.rules.control.transmission_in_ros2 import TransmissionInRos2

    return (TransmissionInRos2,)
