"""K967 controller-type-wrong-generation."""

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_TRAJECTORY = "joint_trajectory_controller/JointTrajectoryController"
_SINGLE_JOINT = {
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
    **_SINGLE_JOINT,
}
"""Controller type that exists only in ros_controllers (Noetic) → its replacement in ros2_controllers."""

_TO_ROS_1 = {
    "joint_state_broadcaster/JointStateBroadcaster": "joint_state_controller/JointStateController",
    "imu_sensor_broadcaster/IMUSensorBroadcaster": "imu_sensor_controller/ImuSensorController",
    "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster": (
        "force_torque_sensor_controller/ForceTorqueSensorController"
    ),
    _TRAJECTORY: "position_controllers/JointTrajectoryController",
    "forward_command_controller/ForwardCommandController": "position_controllers/JointGroupPositionController",
}
"""Controller type that exists only in ros2_controllers → its replacement in ros_controllers."""

_TYPE = r"(?m)(?:^|[{,])[ \t]*type[ \t]*:[ \t]*[\"']?(\w+/\w+)\b"


class ControllerOfOtherRos(RobotRule):
    """A ROS 2 package uses a ROS 1 controller type, or a ROS 1 package a ROS 2 type.

    ## What it does
    Checks the types of controllers in YAML. A file is for ROS 2 if it contains ``ros__parameters`` or if the
    package.xml of its package names an ament build tool, and for ROS 1 if the package.xml names catkin.

    ## Why is this bad?
    The controller does not start, because pluginlib does not find the class: "Loader for controller 'arm_controller'
    not found".

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         joint_states:
    -      type: joint_state_controller/JointStateController
    +      type: joint_state_broadcaster/JointStateBroadcaster
    ```
    """

    code = "K967"
    name = "controller-type-wrong-generation"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each controller type of the other ROS version."""
        from urdfkit.lint.facts.control.yaml_tree import yamls

        for source in yamls(model):
            if "type" not in source.text or "/" not in source.text:
                continue
            for name, span in _types(source):
                if name not in _TO_ROS_2 and name not in _TO_ROS_1:
                    continue
                ros = _ros_of(source, model)
                replacement = {1: _TO_ROS_1, 2: _TO_ROS_2}.get(ros, {}).get(name)
                if replacement is None:
                    continue
                message = f"`{name}` is a controller type of ROS {3 - ros}, but this file is for ROS {ros}"
                help = f"write `{replacement}`"
                if name in _SINGLE_JOINT and ros == 2:
                    help += " and list the joint in `joints`"
                yield self.at_span(span, message, help=help)


def _types(source: Source) -> Iterator[tuple[str, Span]]:
    """Yield the controller types with their spans; with ROS 2 parameters, only those of declared controllers."""
    from urdfkit.lint.facts.control.launch_package_paths import uncommented
    from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, declared
    from urdfkit.lint.facts.control.yaml_tree import span_of

    if PARAMETERS in source.text:
        yield from ((controller.kind.text, span_of(source, controller.kind)) for controller in declared(source))
    else:
        yield from ((match[1], source.span(*match.span(1))) for match in re.finditer(_TYPE, uncommented(source)))


def _ros_of(source: Source, model: Model) -> int:
    """Return the ROS version of a parameter file, 1 or 2; 0 if it is unknown."""
    from pathlib import Path

    from urdfkit.description.packages.related_files import package_of

    if "ros__parameters" in source.text:
        return 2
    package = package_of(Path(source.file))
    manifest = model.manifest(package) if package is not None else ""
    is_ament, is_catkin = "ament_" in manifest, ">catkin<" in re.sub(r"\s", "", manifest)
    return 0 if is_catkin == is_ament else 1 if is_catkin else 2
