"""K967 controller-type-wrong-generation."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source, Span
    from urdfkit.lint.model import Model

_TRAJECTORY = "joint_trajectory_controller/JointTrajectoryController"
_SINGLE = {
    f"{name.lower()}_controllers/Joint{name}Controller": f"{name.lower()}_controllers/JointGroup{name}Controller"
    for name in ("Position", "Velocity", "Effort")
}
_TO_ROS_2 = {
    "joint_state_controller/JointStateController": "joint_state_broadcaster/JointStateBroadcaster",
    "imu_sensor_controller/ImuSensorController": "imu_sensor_broadcaster/IMUSensorBroadcaster",
    "force_torque_sensor_controller/ForceTorqueSensorController": (
        "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster"
    ),
    **dict.fromkeys(
        (
            *(f"{kind}_controllers/JointTrajectoryController" for kind in ("position", "velocity", "effort")),
            "pos_vel_controllers/JointTrajectoryController",
            "pos_vel_acc_controllers/JointTrajectoryController",
            "effort_controllers/JointPositionController",
            "effort_controllers/JointVelocityController",
            "velocity_controllers/JointPositionController",
        ),
        _TRAJECTORY,
    ),
    **_SINGLE,
}
"""Types of ros_controllers (Noetic) that ros2_controllers lacks → what takes their place."""

_TO_ROS_1 = {
    "joint_state_broadcaster/JointStateBroadcaster": "joint_state_controller/JointStateController",
    "imu_sensor_broadcaster/IMUSensorBroadcaster": "imu_sensor_controller/ImuSensorController",
    "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster": (
        "force_torque_sensor_controller/ForceTorqueSensorController"
    ),
    _TRAJECTORY: "position_controllers/JointTrajectoryController",
    "forward_command_controller/ForwardCommandController": "position_controllers/JointGroupPositionController",
}
"""Types of ros2_controllers that ros_controllers lacks → what takes their place."""

_TYPE = r"(?m)(?:^|[{,])[ \t]*type[ \t]*:[ \t]*[\"']?(\w+/\w+)\b"


class ControllerOfOtherRos(RobotRule):
    """A controller has a type of ROS 1 in a package for ROS 2, or the other way round.

    ## What it does
    Looks at the types of controllers in YAML. That it is for ROS 2 is told by ``ros__parameters`` in the file, or by
    the build tool in the package.xml of the package it is in; that it is for ROS 1, by catkin.

    ## Why is this bad?
    "Loader for controller 'arm_controller' not found": pluginlib knows no such class; the controller does not start.

    ## Example
    ```yaml
    controller_manager:
      ros__parameters:
        joint_states:
          type: joint_state_controller/JointStateController
    ```

    ## Use instead
    ```yaml
    controller_manager:
      ros__parameters:
        joint_states:
          type: joint_state_broadcaster/JointStateBroadcaster
    ```
    """

    code = "K967"
    name = "controller-type-wrong-generation"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each type of the other ROS, with the one that takes its place."""
        from urdfkit.lint.yaml_tree import yamls

        for source in yamls(model):
            if "type" not in source.text or "/" not in source.text:
                continue
            for name, span in _types(source):
                if name not in _TO_ROS_2 and name not in _TO_ROS_1:
                    continue
                ros = _ros_of(source, model)
                right = {1: _TO_ROS_1, 2: _TO_ROS_2}.get(ros, {}).get(name)
                if right is None:
                    continue
                message = f"`{name}` is a controller of ROS {3 - ros}; that of ROS {ros} is `{right}`"
                help = "it takes `joints`, a list" if name in _SINGLE and ros == 2 else None
                yield Finding(self.code, self.name, self.severity, message, span, help=help)


def _types(source: Source) -> Iterator[tuple[str, Span]]:
    """Yield the types of controllers with their places; where there are parameters of ROS 2, those among them."""
    from urdfkit.lint.launch import uncommented
    from urdfkit.lint.ros2_controllers import PARAMETERS, declared
    from urdfkit.lint.yaml_tree import span_of

    if PARAMETERS in source.text:
        yield from ((one.kind.text, span_of(source, one.kind)) for one in declared(source))
    else:
        yield from ((at[1], source.span(*at.span(1))) for at in re.finditer(_TYPE, uncommented(source)))


def _ros_of(source: Source, model: Model) -> int:
    """Return which ROS settings are for; 0 where that is not told."""
    from pathlib import Path

    from urdfkit.description.surroundings import package_of

    if "ros__parameters" in source.text:
        return 2
    package = package_of(Path(source.file))
    manifest = model.manifest(package) if package is not None else ""
    is_2, is_1 = "ament_" in manifest, ">catkin<" in re.sub(r"\s", "", manifest)
    return 0 if is_1 == is_2 else 1 if is_1 else 2
