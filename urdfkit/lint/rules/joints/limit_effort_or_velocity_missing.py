"""J404 limit-effort-or-velocity-missing."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_TURNING = {"effort": "[N·m]", "velocity": "[rad/s]"}


class LimitEffortOrVelocityMissing(RobotRule):
    """A ``<limit>`` lacks ``effort`` or ``velocity``.

    ## What it does
    Looks at the limits of joints of type ``revolute``, ``prismatic`` and ``continuous``.

    ## Why is this bad?
    urdfdom refuses the joint, and with it the robot: both are required wherever a limit is written.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="10"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="10" velocity="2"/>
      </joint>
    </robot>
    ```
    """

    code = "J404"
    name = "limit-effort-or-velocity-missing"
    not_for = frozenset(("mujoco",))

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each limit that lacks one of the two, or both."""
        for joint in model.robot.joints:
            limit = joint.limit
            if limit is None or joint.type not in ("revolute", "prismatic", "continuous"):
                continue
            missing = [name for name in ("effort", "velocity") if name not in limit.element.attributes]
            if missing:
                units = {"effort": "[N]", "velocity": "[m/s]"} if joint.type == "prismatic" else _TURNING
                wanted = " and ".join(f"{name} {units[name]}" for name in missing)
                yield self.at(
                    model,
                    limit.element,
                    f"joint `{joint.name}`: <limit> lacks {' and '.join(missing)}",
                    joint=joint.name,
                    help=f"add {wanted}",
                )
