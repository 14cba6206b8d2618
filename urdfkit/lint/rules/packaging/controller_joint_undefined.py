"""K959 controller-joint-undefined."""

from __future__ import annotations

import re

from urdfkit.lint.around import names_around
from urdfkit.lint.finding import Finding
from urdfkit.lint.hidden import doubted
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.model import Model


class ControllerJointUndefined(RobotRule):
    """A controller is for a joint that the robot does not have.

    ## What it does
    Compares the joints of controllers, in the YAML of the robot's package and of those beside it that depend on it,
    with the joints of the robot. Where other descriptions there, other arguments or other conditions could make a
    joint of the name, nothing is said.

    ## Why is this bad?
    The controller does not start: there is no such joint to command.

    ## Example
    ```yaml
    controller_manager:
      ros__parameters:
        arm_controller:
          type: joint_trajectory_controller/JointTrajectoryController
    arm_controller:
      ros__parameters:
        joints: [elbo]
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
    ```
    """

    code = "K959"
    name = "controller-joint-undefined"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint of a controller that no description around can have."""
        from urdfkit.lint.controllers import joints
        from urdfkit.lint.edits import nearest

        known = model.robot.joint_by_name
        if not known:
            return
        others: list[str] | None = None
        for source in model.around.values():
            if not source.file.endswith((".yaml", ".yml")):
                continue
            for named in joints(source):
                if named.name.rpartition("/")[2] in known:  # a controller that others are chained to stands before it
                    continue
                others = names_around(model, "joint") if others is None else others
                if any(re.fullmatch(pattern, named.name) for pattern in others):
                    continue
                near = nearest(named.name, known)
                found = Finding(
                    self.code,
                    self.name,
                    self.severity,
                    f"a controller is for `{named.name}`, which is no joint of `{model.robot.name}`"
                    f"{f'; did you mean `{near}`?' if near else ''}",
                    source.span(named.start, named.start + len(named.name)),
                    joint=named.name,
                )
                yield from doubted(model, named.name, near, found)
