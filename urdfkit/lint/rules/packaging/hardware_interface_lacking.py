"""K965 hardware-interface-lacking."""

from __future__ import annotations

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.model import Model
    from urdfkit.lint.ros2_controllers import Controller

_BROADCASTERS = (
    "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
    "imu_sensor_broadcaster/IMUSensorBroadcaster",
    "range_sensor_broadcaster/RangeSensorBroadcaster",
)
"""The types of ros2_controllers that read the sensor of their ``sensor_name`` (Humble to Rolling)."""


class HardwareInterfaceLacking(RobotRule):
    """A controller of ROS 2 commands or reads an interface that the hardware of a joint does not have.

    ## What it does
    Compares what controllers of ros2_controllers want of their joints, by their type and their settings in YAML, with
    the ``<command_interface>`` and ``<state_interface>`` of these joints in ``<ros2_control>``; and the ``sensor_name``
    of broadcasters with its sensors, where it is nearly one of theirs. Where arguments, or
    another description of the package, may make it another hardware, and where the hardware misspells its joint or
    interface, which is a finding of its own, nothing is said.

    ## Why is this bad?
    "Not acceptable command interfaces": the controller manager refuses to start the controller.

    ## Example
    ```yaml
    controller_manager:
      ros__parameters:
        arm_controller:
          type: joint_trajectory_controller/JointTrajectoryController
    arm_controller:
      ros__parameters:
        joints: [elbow]
        command_interfaces: [velocity]
        state_interfaces: [position]
    ```

    ## Use instead
    ```yaml
    controller_manager:
      ros__parameters:
        arm_controller:
          type: joint_trajectory_controller/JointTrajectoryController
    arm_controller:
      ros__parameters:
        joints: [elbow]
        command_interfaces: [position]
        state_interfaces: [position]
    ```

    ## References
    The hardware beside the example has the command interface ``position`` for ``elbow``.
    """

    code = "K965"
    name = "hardware-interface-lacking"
    severity = "warning"
    not_for = NOT_GAZEBO | {"ros1"}

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each interface that a controller wants and a joint lacks, where it is written."""
        if not model.robot.ros2_control:
            return
        from urdfkit.lint.ros2_controllers import PARAMETERS, declared, offered
        from urdfkit.lint.yaml_tree import yamls

        sources = [source for source in yamls(model) if PARAMETERS in source.text]
        has = offered(model) if sources else None
        for source in sources if has is not None else ():
            for controller in declared(source):
                yield from self._lacking(source, controller, has or {}, model)
                yield from self._sensor(source, controller, has or {})

    def _sensor(
        self, source: Source, controller: Controller, has: dict[str, dict[bool, list[str]]]
    ) -> Iterator[Finding]:
        from urdfkit.lint.edits import nearest
        from urdfkit.lint.yaml_tree import span_of

        named = controller.settings.find("sensor_name") if controller.settings is not None else None
        if named is None or not named.text or controller.kind.text not in _BROADCASTERS or named.text in has:
            return
        near = nearest(named.text, has, likeness=0.7)
        if near is not None:
            message = f"`{controller.name}` reads `{named.text}`, which no <ros2_control> has; did you mean `{near}`?"
            yield Finding(self.code, self.name, self.severity, message, span_of(source, named))

    def _lacking(
        self, source: Source, controller: Controller, has: dict[str, dict[bool, list[str]]], model: Model
    ) -> Iterator[Finding]:
        from urdfkit.lint.interfaces import meant_interface, meant_joints
        from urdfkit.lint.ros2_controllers import wanted
        from urdfkit.lint.yaml_tree import span_of

        told: set[tuple[int, int]] = set()
        misspelt = meant_joints(model.robot)
        for one in wanted(controller):
            interfaces = has.get(one.joint)
            place = (one.where.line, one.where.column)
            if place in told or (interfaces is not None and one.interface in interfaces[one.is_command]):
                continue
            kind = "commands" if one.is_command else "reads"
            if interfaces is None:
                if one.joint not in model.robot.joint_by_name or not one.is_command:
                    continue
                if one.joint in misspelt:
                    continue
            elif one.interface in (meant_interface(name) for name in interfaces[one.is_command]):
                continue
            if interfaces is None:
                message = f"`{controller.name}` commands `{one.joint}`, which no <ros2_control> has"
                help = "add it there, with its interfaces"
            else:
                own = ", ".join(f"`{name}`" for name in interfaces[one.is_command]) or "none"
                tag = "command_interface" if one.is_command else "state_interface"
                message = f"`{controller.name}` {kind} the {one.interface} of `{one.joint}`, whose hardware has {own}"
                help = f'add <{tag} name="{one.interface}"/> there, or change the controller'
            told.add(place)
            span = span_of(source, one.where)
            yield Finding(self.code, self.name, self.severity, message, span, joint=one.joint, help=help)
