"""K963 controller-interface-missing."""

from __future__ import annotations

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.model import Model

_WANTED = {
    "effort_controllers": "EffortJointInterface",
    "velocity_controllers": "VelocityJointInterface",
    "position_controllers": "PositionJointInterface",
    "diff_drive_controller": "VelocityJointInterface",
}
"""Package of a controller → the interface that its joints need (ros_controllers, Noetic)."""


class ControllerInterfaceMissing(RobotRule):
    """A controller of ROS 1 commands a joint by an interface that its transmission does not have.

    ## What it does
    Compares the type of controllers in YAML (``effort_controllers/…``, ``velocity_controllers/…``,
    ``position_controllers/…``, ``diff_drive_controller/…``) with the ``<hardwareInterface>`` of their joints'
    transmissions.

    ## Why is this bad?
    "Could not find resource 'elbow' in 'hardware_interface::EffortJointInterface'": the controller does not start.

    ## Example
    ```yaml
    arm_controller:
      type: position_controllers/JointPositionController
      joint: elbow
    ```

    ## Use instead
    ```yaml
    arm_controller:
      type: effort_controllers/JointPositionController
      joint: elbow
    ```

    ## References
    The robot beside the example has a transmission for ``elbow`` with an ``EffortJointInterface``.
    """

    code = "K963"
    name = "controller-interface-missing"
    severity = "warning"
    not_for = NOT_GAZEBO | {"ros2", "gz"}

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each controller that finds no such interface for a joint, at its type."""
        from urdfkit.lint.controllers import joints_of, typed
        from urdfkit.lint.interfaces import is_misspelt

        if model.robot.ros2_control:
            return
        has: dict[str, set[str]] = {}
        for transmission in model.robot.transmissions:
            for part in transmission.joints:
                names = (name.rpartition("/")[2] for name in part.hardware_interfaces)
                has.setdefault(part.name or "", set()).update(names)
        for source in model.around.values() if has else ():
            if not source.file.endswith((".yaml", ".yml")):
                continue
            for kind in typed(source):
                wanted = _WANTED.get(kind.name.partition("/")[0])
                lacking = [one for one in joints_of(source, kind) if has.get(one) and wanted not in has[one]]
                if wanted is None or not lacking or any("$" in name for name in has[lacking[0]]):
                    continue
                if any(is_misspelt(name) for name in has[lacking[0]]):
                    continue
                others = ", ".join(f"`{name}`" for name in sorted(has[lacking[0]]))
                yield Finding(
                    self.code,
                    self.name,
                    self.severity,
                    f"`{kind.name}` needs the {wanted} of `{lacking[0]}`, whose transmission has {others}",
                    source.span(kind.start, kind.start + len(kind.name)),
                    joint=lacking[0],
                    help="change one of the two",
                )
