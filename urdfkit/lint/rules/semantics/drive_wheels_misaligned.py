"""S907 drive-wheels-misaligned."""

from __future__ import annotations

from math import dist

from urdfkit.lint.rule import NOT_GAZEBO, RobotRule
from urdfkit.lint.wheels import Wheel, drives

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_NEAR = 0.01
"""[m]"""


class DriveWheelsMisaligned(RobotRule):
    """The two wheels of a drive are one, in one place, at two heights, or turn in opposite directions.

    ## What it does
    Compares the joints that a drive calls left and right, wheel by wheel: where they are, how high, and where their
    axes point.

    ## Why is this bad?
    A drive gives both wheels the same velocity to go straight ahead: where their axes point in opposite directions the
    robot turns on the spot instead. Wheels at two heights do not both touch the ground, and of two wheels in one place
    one has its sign wrong: ``reflect="1"`` twice.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_joint" type="continuous">
        <parent link="base"/>
        <child link="left"/>
        <origin xyz="0 0.15 0" rpy="-1.57079633 0 0"/>
        <axis xyz="0 0 1"/>
      </joint>
      <joint name="right_joint" type="continuous">
        <parent link="base"/>
        <child link="right"/>
        <origin xyz="0 -0.15 0" rpy="1.57079633 0 0"/>
        <axis xyz="0 0 1"/>
      </joint>
      <gazebo>
        <plugin name="gz::sim::systems::DiffDrive" filename="gz-sim-diff-drive-system">
          <left_joint>left_joint</left_joint>
          <right_joint>right_joint</right_joint>
          <wheel_separation>0.3</wheel_separation>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_joint" type="continuous">
        <parent link="base"/>
        <child link="left"/>
        <origin xyz="0 0.15 0" rpy="-1.57079633 0 0"/>
        <axis xyz="0 0 1"/>
      </joint>
      <joint name="right_joint" type="continuous">
        <parent link="base"/>
        <child link="right"/>
        <origin xyz="0 -0.15 0" rpy="-1.57079633 0 0"/>
        <axis xyz="0 0 1"/>
      </joint>
      <gazebo>
        <plugin name="gz::sim::systems::DiffDrive" filename="gz-sim-diff-drive-system">
          <left_joint>left_joint</left_joint>
          <right_joint>right_joint</right_joint>
          <wheel_separation>0.3</wheel_separation>
        </plugin>
      </gazebo>
    </robot>
    ```
    """

    code = "S907"
    name = "drive-wheels-misaligned"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each pair of wheels that is off, the worst that is wrong with it."""
        if not model.robot.gazebo or model.is_incomplete:
            return
        for drive in drives(model):
            for left, right in zip(drive.left, drive.right, strict=True):
                origins = (wheel.joint.element.find("origin") for wheel in (left, right))
                if any(one is not None and any(model.is_unresolved(one, a) for a in ("xyz", "rpy")) for one in origins):
                    continue
                if left.joint is right.joint:
                    if left.named != right.named:
                        continue  # One of the names is of no joint, and the nearest is the other wheel's.
                    message = f"the drive names `{left.joint.name}` for the left side and for the right"
                    yield self.at(model, right.element or drive.plugin.element, message, joint=right.joint.name)
                    continue
                wrong = _wrong(left, right)
                if wrong is not None:
                    yield self.at(model, right.joint.element, wrong, attribute="name", joint=right.joint.name)


def _wrong(left: Wheel, right: Wheel) -> str | None:
    """Return what is wrong with a pair of wheels; None where nothing is."""
    if not (left.joint.is_movable and right.joint.is_movable):
        return None
    both = f"`{left.joint.name}` and `{right.joint.name}`"
    apart = [dist(one, other) for one, other in zip(left.middles, right.middles, strict=False)]
    if max(apart) < _NEAR:
        return f"the drive's wheels {both} are in the same place"
    if sum(a * b for a, b in zip(left.axis, right.axis, strict=True)) < -0.9:
        return f"the axes of the drive's wheels {both} point in opposite directions: it turns where it should go ahead"
    higher = min((one[2] - other[2] for one, other in zip(left.middles, right.middles, strict=False)), key=abs)
    if abs(higher) > max(_NEAR, 0.05 * max(apart)) and left.radii == right.radii:
        return f"of the drive's wheels {both} one is {abs(higher):.3g} m higher than the other"
    return None
