"""S901 wheel-separation-inconsistent."""

from __future__ import annotations

from urdfkit.lint.placement import unit
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule
from urdfkit.lint.wheels import drives, mismatch, track, written

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

TOLERANCE = 0.05

SKIDDING = 2.0
"""With several wheels on a side, which skid when it turns, the separation is tuned: up to twice is let be."""


class WheelSeparation(RobotRule):
    """The wheel separation a drive is told is not that of the wheels.

    ## What it does
    Compares the parameter with the distance of the joints, and of the wheels' shapes, across the robot, every joint
    at zero. A twentieth more or less is let be. Robots with several wheels on a side are left alone: as they slip
    when they turn, their separation is tuned.

    ## Why is this bad?
    The robot turns more or less than commanded, and its odometry is wrong by the same factor.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_joint" type="continuous">
        <parent link="base"/>
        <child link="left"/>
        <origin xyz="0 0.15 0"/>
        <axis xyz="0 1 0"/>
      </joint>
      <joint name="right_joint" type="continuous">
        <parent link="base"/>
        <child link="right"/>
        <origin xyz="0 -0.15 0"/>
        <axis xyz="0 1 0"/>
      </joint>
      <gazebo>
        <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
          <leftJoint>left_joint</leftJoint>
          <rightJoint>right_joint</rightJoint>
          <wheelSeparation>0.2</wheelSeparation>
          <wheelDiameter>0.1</wheelDiameter>
          <robotBaseFrame>base</robotBaseFrame>
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
        <origin xyz="0 0.15 0"/>
        <axis xyz="0 1 0"/>
      </joint>
      <joint name="right_joint" type="continuous">
        <parent link="base"/>
        <child link="right"/>
        <origin xyz="0 -0.15 0"/>
        <axis xyz="0 1 0"/>
      </joint>
      <gazebo>
        <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
          <leftJoint>left_joint</leftJoint>
          <rightJoint>right_joint</rightJoint>
          <wheelSeparation>0.3</wheelSeparation>
          <wheelDiameter>0.1</wheelDiameter>
          <robotBaseFrame>base</robotBaseFrame>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the parameter is set to the distance of the wheels, but it may be those that are misplaced.
    """

    code = "S901"
    name = "wheel-separation-inconsistent"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each drive whose separation is off."""
        if not model.robot.gazebo:
            return
        for drive in drives(model):
            value = written(model, drive, "wheel_separation")
            if value is None:
                continue
            separation = value[0]
            left, right = drive.left[0], drive.right[0]
            across = unit(left.axis) or (0.0, 1.0, 0.0)
            distances = [
                abs(sum((a - b) * c for a, b, c in zip(one, other, across, strict=True)))
                for wheel, its in zip(drive.left, drive.right, strict=True)
                for one, other in zip(wheel.middles, its.middles, strict=False)
            ]
            least, most = (1.0 - TOLERANCE, 1.0 + TOLERANCE) if len(drive.left) == 1 else (1.0 / SKIDDING, SKIDDING)
            if distances[0] < 0.01 or any(least * each <= separation <= most * each for each in distances):
                continue
            of_first = min(len(left.middles), len(right.middles))
            actual, what = track(left, right, distances[:of_first])
            yield mismatch(self, model, drive, value, actual=actual, beside=f"{what} are {{}} m apart")
